#include "display/openxr_session.h"

#include "render/view.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace onestroke {

namespace {

constexpr auto view_kind = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr Duration longest_leave = Duration::from_seconds(2);

/// One size for both eyes: the larger.
VkExtent2D find_view_size(const OpenXrInstance& instance) {
  constexpr const char* doing = "the headset does not show a pair of views: use another";
  std::array<XrViewConfigurationView, max_views> views;
  views.fill(typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
  std::uint32_t count = 0;
  check(xrEnumerateViewConfigurationViews(instance.handle(), instance.headset(), view_kind, max_views, &count,
                                          views.data()),
        doing);
  return {std::max(views[0].recommendedImageRectWidth, views[1].recommendedImageRectWidth),
          std::max(views[0].recommendedImageRectHeight, views[1].recommendedImageRectHeight)};
}

XrSession create(const OpenXrInstance& instance, const Device& device) {
  auto graphics = typed<XrGraphicsBindingVulkan2KHR>(XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR);
  graphics.instance = *device.instance();
  graphics.physicalDevice = *device.physical();
  graphics.device = *device.vk();
  graphics.queueFamilyIndex = device.queue_family();
  auto info = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
  info.next = &graphics;
  info.systemId = instance.headset();
  XrSession session = XR_NULL_HANDLE;
  check(xrCreateSession(instance.handle(), &info, &session),
        "the OpenXR runtime gives no session: end the other program that uses the headset, or restart its service");
  return session;
}

}  // namespace

OpenXrSession::OpenXrSession(const OpenXrInstance& instance, const Device& device, XrEnvironmentBlendMode blend_mode)
    : instance_(instance),
      view_size_(find_view_size(instance)),
      blend_mode_(blend_mode),
      session_(create(instance, device)),
      refresh_rate_(instance, *session_) {}

void OpenXrSession::take_events() {
  XrEventDataBuffer event;
  while (instance_.next_event(event)) {
    if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) loss_pending_ = true;
    if (event.type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING)
      space_changes_.push_back(reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(event));
    if (event.type == XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB)
      refresh_rate_.changed(reinterpret_cast<const XrEventDataDisplayRefreshRateChangedFB&>(event));
    if (event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) continue;
    const auto& changed = *reinterpret_cast<const XrEventDataSessionStateChanged*>(&event);
    // There may be word of a session that was let go.
    if (changed.session == *session_) go_to(changed.state);
  }
}

void OpenXrSession::go_to(XrSessionState state) {
  switch (state) {
    case XR_SESSION_STATE_READY: {
      auto info = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
      info.primaryViewConfigurationType = view_kind;
      check(xrBeginSession(*session_, &info), "the OpenXR runtime does not let the session begin");
      running_ = true;
      break;
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      frame_begun_ = false;
      check(xrEndSession(*session_), "the OpenXR runtime does not let the session end");
      break;
    case XR_SESSION_STATE_EXITING:
      over_ = true;
      break;
    case XR_SESSION_STATE_LOSS_PENDING:
      loss_pending_ = true;
      break;
    default:
      // IDLE waits for the headset to be put on; SYNCHRONIZED, VISIBLE and FOCUSED differ in what begin_frame() says.
      break;
  }
}

XrFrameState OpenXrSession::begin_frame() {
  auto frame = typed<XrFrameState>(XR_TYPE_FRAME_STATE);
  check(xrWaitFrame(*session_, nullptr, &frame), "the OpenXR runtime wants no frame");
  check(xrBeginFrame(*session_, nullptr), "the OpenXR runtime lets no frame begin");
  frame_begun_ = true;
  count_missed(frame);
  display_time_ = frame.predictedDisplayTime;
  ++count_.frames;
  begun_ = Time::now();
  return frame;
}

// The first period is a guess of the runtime's, with no frame before it to count from. Later ones become longer where a
// runtime gives up on a program that is late; where it does not tell the screen's own, that is the shortest.
void OpenXrSession::count_missed(const XrFrameState& frame) {
  if (count_.frames < 2 || frame.predictedDisplayPeriod <= 0) return;
  shortest_period_ = std::min(shortest_period_, frame.predictedDisplayPeriod);
  const XrDuration since = frame.predictedDisplayTime - display_time_;
  count_.missed += std::max<std::int64_t>(0, (since + period() / 2) / period() - 1);
}

void OpenXrSession::end_frame(std::span<const XrCompositionLayerBaseHeader* const> layers) {
  auto info = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
  info.displayTime = display_time_;
  info.environmentBlendMode = blend_mode_;
  info.layerCount = static_cast<std::uint32_t>(layers.size());
  info.layers = layers.data();
  frame_begun_ = false;
  if (!layers.empty() && (Time::now() - begun_).ns > period()) ++count_.slow;
  check(xrEndFrame(*session_, &info), "the OpenXR runtime does not show a frame");
  if (!layers.empty()) ++count_.seen;
}

void OpenXrSession::leave() {
  if (!running_) return;
  if (frame_begun_) end_frame({});
  check(xrRequestExitSession(*session_), "the OpenXR runtime does not let the session end");
  for (const Time until = Time::now() + longest_leave; !over_ && Time::now() < until; take_events()) {
    // A runtime may want frames until it stops the session.
    if (running_) {
      begin_frame();
      end_frame({});
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
}

}  // namespace onestroke

// The fake runtime's session: its states and its frames.
#include "fake_runtime.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <ctime>

namespace fake_runtime {
namespace {

constexpr XrDuration period = 8'000'000, first_period = 16'000'000;
constexpr int eye_width = 128, eye_height = 96;
constexpr int frames_of_a_spell = 10, polls_until_worn = 20;
constexpr float half_eye_distance = 0.0315F, quarter_turn = 0.785398F;

struct Session {
  bool made = false, ready = false, running = false, stopping = false, leaving = false;
  bool waited = false, begun = false, should_render = false;
  int polls_until_ready = 0;
  XrTime display_time = 0;
};
Session session;

/// What goes on from session to session.
struct Play {
  int frames = 0, unseen_until = 0, late_until = 0;
  XrTime next_frame = 0;
};
Play play;

// Any address will do for a handle.
std::array<int, 3> handles;
XrSession session_handle() {
  return reinterpret_cast<XrSession>(&handles[0]);
}

/// On the runtime's clock.
XrTime now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec + clock_zero;
}

void sleep_until(XrTime time) {
  const XrTime wait = time - now();
  const timespec t{.tv_sec = 0, .tv_nsec = wait};
  if (wait > 0) nanosleep(&t, nullptr);
}

void go_to(XrSessionState state) {
  session.ready = state == XR_SESSION_STATE_READY;
  session.stopping = state == XR_SESSION_STATE_STOPPING;
  XrEventDataBuffer event{};
  const XrEventDataSessionStateChanged changed{.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED,
                                               .next = nullptr,
                                               .session = session_handle(),
                                               .state = state,
                                               .time = now()};
  std::memcpy(&event, &changed, sizeof changed);
  push_event(event);
}

XrResult create_session(XrInstance, const XrSessionCreateInfo* info, XrSession* made) {
  if (session.made) return violation("a second session", XR_ERROR_LIMIT_REACHED);
  if (!requirements_asked())
    return violation("a session before Vulkan's requirements were asked for",
                     XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
  use_graphics(static_cast<const XrGraphicsBindingVulkan2KHR*>(info->next));
  session = {.made = true};
  *made = session_handle();
  go_to(XR_SESSION_STATE_IDLE);
  go_to(XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XrResult destroy_session(XrSession) {
  if (session.begun && !instance_lost()) violation("a session destroyed with a frame begun", XR_SUCCESS);
  session = {};
  use_graphics(nullptr);
  return XR_SUCCESS;
}

XrResult begin_session(XrSession, const XrSessionBeginInfo*) {
  if (!session.ready) return violation("a session begun that is not ready", XR_ERROR_SESSION_NOT_READY);
  session.running = true;
  for (const auto state : {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED})
    go_to(state);
  return XR_SUCCESS;
}

XrResult end_session(XrSession) {
  if (!session.stopping) return violation("a session ended that is not stopping", XR_ERROR_SESSION_NOT_STOPPING);
  if (session.begun) violation("a session ended with a frame begun", XR_SUCCESS);
  session.running = session.waited = session.begun = false;
  go_to(XR_SESSION_STATE_IDLE);
  if (session.leaving)
    go_to(XR_SESSION_STATE_EXITING);
  else
    session.polls_until_ready = polls_until_worn;
  return XR_SUCCESS;
}

XrResult request_exit(XrSession) {
  if (!session.running) return violation("an end asked of a session not running", XR_ERROR_SESSION_NOT_RUNNING);
  session.leaving = true;
  go_to(XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

void lose_soon(bool instance) {
  if (!instance) return go_to(XR_SESSION_STATE_LOSS_PENDING);
  XrEventDataBuffer event{};
  const XrEventDataInstanceLossPending loss{
      .type = XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, .next = nullptr, .lossTime = now() + 10 * period};
  std::memcpy(&event, &loss, sizeof loss);
  push_event(event);
  stay_away();
}

/// What the script has for this frame, short of errors.
void follow_script() {
  if (due("exit", play.frames)) {
    session.leaving = true;
    go_to(XR_SESSION_STATE_STOPPING);
  }
  if (due("put_down", play.frames)) go_to(XR_SESSION_STATE_STOPPING);
  if (due("unseen", play.frames)) play.unseen_until = play.frames + frames_of_a_spell;
  if (due("late", play.frames)) play.late_until = play.frames + frames_of_a_spell;
  if (due("session_loss", play.frames)) lose_soon(false);
  if (due("instance_loss", play.frames)) lose_soon(true);
}

XrResult wait_frame(XrSession, const XrFrameWaitInfo*, XrFrameState* frame) {
  if (instance_lost()) return XR_ERROR_INSTANCE_LOST;
  if (!session.running) return violation("a frame waited for with no session running", XR_ERROR_SESSION_NOT_RUNNING);
  if (session.waited) return violation("a frame waited for before the last was begun", XR_ERROR_CALL_ORDER_INVALID);
  if (due("wait_error", play.frames)) return XR_ERROR_RUNTIME_FAILURE;
  if (due("lost", play.frames)) {
    lose_instance();
    return XR_ERROR_INSTANCE_LOST;
  }
  sleep_until(play.next_frame);
  play.next_frame = now() + period;
  const bool first = session.display_time == 0;
  follow_script();
  session.should_render = play.frames >= play.unseen_until;
  const bool late = first || play.frames < play.late_until;
  session.display_time = late ? std::max(session.display_time + 1, now() - period) : play.next_frame + period;
  session.waited = true;
  ++play.frames;
  frame->predictedDisplayTime = session.display_time;
  frame->predictedDisplayPeriod = first ? first_period : period;
  frame->shouldRender = session.should_render;
  return XR_SUCCESS;
}

XrResult begin_frame(XrSession, const XrFrameBeginInfo*) {
  if (instance_lost()) return XR_ERROR_INSTANCE_LOST;
  if (!session.waited) return violation("a frame begun that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  if (session.begun) violation("a frame begun before the last was ended", XR_FRAME_DISCARDED);
  session.waited = false;
  session.begun = true;
  return XR_SUCCESS;
}

bool sound(const XrCompositionLayerProjectionView& view) {
  const XrQuaternionf& q = view.pose.orientation;
  const bool unit = std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3F;
  return unit && view.fov.angleLeft < view.fov.angleRight && view.fov.angleDown < view.fov.angleUp &&
         can_show(view.subImage);
}

bool sound(const XrCompositionLayerBaseHeader& header) {
  if (header.type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) return false;
  const auto& layer = reinterpret_cast<const XrCompositionLayerProjection&>(header);
  return layer.space != XR_NULL_HANDLE && layer.viewCount == 2 && sound(layer.views[0]) && sound(layer.views[1]);
}

XrResult end_frame(XrSession, const XrFrameEndInfo* info) {
  if (instance_lost()) return XR_ERROR_INSTANCE_LOST;
  if (!session.begun) return violation("a frame ended that was not begun", XR_ERROR_CALL_ORDER_INVALID);
  session.begun = false;
  if (info->displayTime != session.display_time)
    return violation("a frame ended for another time than its own", XR_ERROR_TIME_INVALID);
  if (info->environmentBlendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE)
    return violation("a blend mode that is not there", XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
  if (info->layerCount > 0 && !session.should_render) violation("layers for a frame not to be rendered", XR_SUCCESS);
  for (std::uint32_t i = 0; i < info->layerCount; ++i)
    if (!sound(*info->layers[i])) return violation("a layer that cannot be shown", XR_ERROR_LAYER_INVALID);
  return XR_SUCCESS;
}

XrResult enumerate_spaces(XrSession, std::uint32_t capacity, std::uint32_t* count, XrReferenceSpaceType* kinds) {
  return give(std::array{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL}, capacity, count, kinds);
}

XrResult create_space(XrSession, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  *space = reinterpret_cast<XrSpace>(&handles[info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW ? 1 : 2]);
  return XR_SUCCESS;
}

XrResult destroy_space(XrSpace) {
  return XR_SUCCESS;
}

XrResult locate_space(XrSpace, XrSpace, XrTime time, XrSpaceLocation* location) {
  if (instance_lost()) return XR_ERROR_INSTANCE_LOST;
  if (time <= 0) return violation("a space located at no time", XR_ERROR_TIME_INVALID);
  location->locationFlags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
                            XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  location->pose = {.orientation = {0, 0, 0, 1}, .position = {0, 0, 0}};
  return XR_SUCCESS;
}

XrResult locate_views(XrSession, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                      std::uint32_t* count, XrView* views) {
  if (instance_lost()) return XR_ERROR_INSTANCE_LOST;
  if (info->displayTime != session.display_time) violation("eyes located at another time than the frame's", XR_SUCCESS);
  state->viewStateFlags = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT |
                          XR_VIEW_STATE_ORIENTATION_TRACKED_BIT | XR_VIEW_STATE_POSITION_TRACKED_BIT;
  std::array<XrView, 2> eyes{};
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    eyes.at(i).type = XR_TYPE_VIEW;
    eyes.at(i).pose.orientation.w = 1;
    eyes.at(i).pose.position.x = i == 0 ? -half_eye_distance : half_eye_distance;
    eyes.at(i).fov = {-quarter_turn, quarter_turn, quarter_turn, -quarter_turn};
  }
  return give(eyes, capacity, count, views);
}

XrResult view_configuration_views(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t capacity,
                                  std::uint32_t* count, XrViewConfigurationView* views) {
  std::array<XrViewConfigurationView, 2> both{};
  both.fill({.type = XR_TYPE_VIEW_CONFIGURATION_VIEW,
             .next = nullptr,
             .recommendedImageRectWidth = eye_width,
             .maxImageRectWidth = eye_width,
             .recommendedImageRectHeight = eye_height,
             .maxImageRectHeight = eye_height,
             .recommendedSwapchainSampleCount = 1,
             .maxSwapchainSampleCount = 1});
  return give(both, capacity, count, views);
}

XrResult blend_modes(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t capacity, std::uint32_t* count,
                     XrEnvironmentBlendMode* modes) {
  return give(std::array{XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, capacity, count, modes);
}

}  // namespace

void reset_session() {
  session = {};
  play = {};
}

void poll_session() {
  if (session.polls_until_ready > 0 && --session.polls_until_ready == 0) go_to(XR_SESSION_STATE_READY);
}

PFN_xrVoidFunction session_function(std::string_view name) {
  static const std::array functions{named("xrCreateSession", create_session),
                                    named("xrDestroySession", destroy_session),
                                    named("xrBeginSession", begin_session),
                                    named("xrEndSession", end_session),
                                    named("xrRequestExitSession", request_exit),
                                    named("xrWaitFrame", wait_frame),
                                    named("xrBeginFrame", begin_frame),
                                    named("xrEndFrame", end_frame),
                                    named("xrEnumerateReferenceSpaces", enumerate_spaces),
                                    named("xrCreateReferenceSpace", create_space),
                                    named("xrDestroySpace", destroy_space),
                                    named("xrLocateSpace", locate_space),
                                    named("xrLocateViews", locate_views),
                                    named("xrEnumerateViewConfigurationViews", view_configuration_views),
                                    named("xrEnumerateEnvironmentBlendModes", blend_modes)};
  return find(functions, name);
}

}  // namespace fake_runtime

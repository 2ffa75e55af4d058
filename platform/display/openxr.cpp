#include "display/openxr.h"

#include "core/inline_vector.h"
#include "display/openxr_actions.h"
#include "display/openxr_blend.h"
#include "display/openxr_clock.h"
#include "display/openxr_hands.h"
#include "display/openxr_head.h"
#include "display/openxr_mirror.h"
#include "display/openxr_passthrough.h"
#include "display/openxr_session.h"
#include "display/openxr_spaces.h"
#include "display/openxr_swapchain.h"
#include "display/openxr_vulkan.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

namespace onestroke {

namespace {

// How often a headset that shows nothing is looked at again.
constexpr std::chrono::milliseconds pause(10);
// How often a runtime that went away is looked for.
constexpr Duration between_tries = Duration::from_seconds(1);

/// All that is made anew with another Gpu.
struct Seat {
  std::shared_ptr<Device> device;
  OpenXrSession session;
  OpenXrSpaces spaces;
  OpenXrActions actions;
  OpenXrHands hands;
  OpenXrSwapchain swapchain;
  std::optional<OpenXrPassthrough> passthrough;

  Seat(const OpenXrInstance& instance, std::shared_ptr<Device> gpu, World world, bool mirrored)
      : device(std::move(gpu)),
        session(instance, *device, blend_mode_for(world)),
        spaces(session.handle()),
        actions(instance, session.handle()),
        hands(instance, session.handle()),
        swapchain(*device, session.handle(), session.view_size(),
                  {.copied = mirrored, .depth = instance.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME)}) {
    if (world == World::passthrough) passthrough.emplace(instance, session.handle());
  }
  Seat(const Seat&) = delete;
  ~Seat() { device->wait_idle(); }
};

}  // namespace

struct OpenXrDisplay::Impl {
  // None while the runtime is away.
  std::optional<OpenXrInstance> instance;
  std::optional<OpenXrClock> clock;
  OpenXrVulkan vulkan;
  std::string runtime, headset;
  std::unique_ptr<OpenXrMirror> mirror;  // null for none
  // None before attach(), and from a loss to the next attach().
  std::optional<Seat> seat;
  OpenXrHead head;
  OpenXrSession::Count count;
  Time last = Time::now(), next_try;
  std::string failure;
  bool closed = false, lost = false, recentre = false;
  InlineVector<Key, 16> keys;

  // What was asked for, then what was chosen, also where the runtime comes again.
  World world;

  explicit Impl(const OpenXrOptions& options) : world(options.world) {
    connect();
    if (options.mirror) mirror = open_mirror(options.title);
    if (mirror) vulkan.want_windows();
  }

  void connect() {
    instance.emplace();
    clock.emplace(*instance);
    vulkan.use(*instance);
    runtime = instance->runtime_name();
    headset = instance->headset_name();
    world = choose_world(world_offers(*instance), world);
  }

  /// What to draw and for when. Leaves `should_render` false where there is nobody to see it.
  void begin(FrameInfo& frame) {
    if (!seat || !seat->session.running()) {
      std::this_thread::sleep_for(pause);
      last = std::max(last, Time::now());
      if (!instance) try_again();
      return;
    }
    const XrFrameState state = seat->session.begin_frame();
    for (const auto& change : seat->session.take_space_changes())
      if (!seat->spaces.move(change)) head.forget();
    if (std::exchange(recentre, false)) {
      const Pose T_new_old = seat->spaces.recentre();
      head.move(T_new_old, seat->spaces.place());
    }
    // A runtime's first guess may lie before what was said last.
    last = std::max(last, clock->to_ours(state.predictedDisplayTime));
    const bool located = state.shouldRender && seat->spaces.locate(state.predictedDisplayTime);
    if (seat->spaces.take_moved()) head.use(seat->spaces.place());
    if (!located) return;
    frame.target = seat->swapchain.acquire();
    if (!frame.target) return;
    put_views(frame);
    frame.should_render = true;
  }

  void put_views(FrameInfo& frame) const {
    frame.located = Time::now();
    for (std::size_t i = 0; i < max_views; ++i) {
      frame.views.at(i) = seat->spaces.view(i);
      frame.views.at(i).viewport = {0, 0, frame.target->width, frame.target->height};
    }
  }

  bool move_views(FrameInfo& frame) noexcept {
    try {
      if (!seat || !seat->spaces.locate(seat->session.display_time())) return false;
      put_views(frame);
      return true;
    } catch (const std::exception&) {
      // The frame needs its image yet; end() finds out what happened.
      return false;
    }
  }

  void poll() {
    keys.clear();
    const auto press = [this](Key key) { keys.push_back(key); };
    if (mirror) std::ranges::for_each(mirror->poll(), press);
    if (!seat) return;
    seat->session.take_events();
    if (!seat->session.running()) return;
    seat->actions.poll(press);
    const Time now = Time::now();
    seat->hands.poll(seat->spaces.place().space, clock->to_runtime(now), now, press);
  }

  void end(const FrameInfo& frame) {
    if (!seat || !seat->session.frame_begun()) return;
    if (frame.should_render)
      show(*frame.target);
    else
      seat->session.end_frame({});
    if (mirror) mirror->show();
  }

  void show(const RenderTarget& drawn) {
    if (mirror) mirror->copy(drawn);
    seat->swapchain.release();
    std::array<XrCompositionLayerProjectionView, max_views> views;
    std::array<XrCompositionLayerDepthInfoKHR, max_views> depths;
    for (std::uint32_t i = 0; i < max_views; ++i) {
      views.at(i) = typed<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
      views.at(i).pose = seat->spaces.eye(i).pose;
      views.at(i).fov = seat->spaces.eye(i).fov;
      views.at(i).subImage = seat->swapchain.part_for(i);
      if (const auto depth = seat->swapchain.depth_for(i)) {
        depths.at(i) = *depth;
        views.at(i).next = &depths.at(i);
      }
    }
    InlineVector<const XrCompositionLayerBaseHeader*, 2> layers;
    XrCompositionLayerPassthroughFB beneath;
    if (seat->passthrough) {
      beneath = seat->passthrough->layer();
      layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&beneath));
    }
    auto layer = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
    if (world != World::camera) layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    layer.space = seat->spaces.place().space;
    layer.viewCount = max_views;
    layer.views = views.data();
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer));
    seat->session.end_frame({layers.begin(), layers.size()});
  }

  /// Runs what may throw in the loop. A runtime that goes is waited for; any other error ends the show.
  template <typename Work>
  void guard(Work&& work) noexcept {
    if (closed) return;
    try {
      work();
      if (seat && seat->session.loss_pending()) wait_for_runtime();
    } catch (const OpenXrError& error) {
      if (error.lost())
        wait_for_runtime();
      else
        fail(error);
    } catch (const std::exception& error) {
      fail(error);
    }
  }

  void fail(const std::exception& error) {
    failure = "the headset cannot go on: restart the OpenXR runtime " + runtime + " (" + error.what() + ")";
    closed = true;
  }

  void wait_for_runtime() {
    std::fprintf(stderr, "onestroke: the OpenXR runtime %s went away; the show goes on when it is back\n",
                 runtime.c_str());
    let_go();
    clock.reset();
    instance.reset();
    lost = true;
    next_try = Time::now() + between_tries;
  }

  void try_again() {
    if (Time::now() < next_try) return;
    next_try = Time::now() + between_tries;
    try {
      connect();
    } catch (const Error&) {
      clock.reset();
      instance.reset();
    }
  }

  void let_go() {
    head.detach();
    if (mirror) mirror->let_go();
    if (seat) count += seat->session.count();
    seat.reset();
  }
};

OpenXrDisplay::OpenXrDisplay(const OpenXrOptions& options) : impl_(std::make_unique<Impl>(options)) {}
OpenXrDisplay::~OpenXrDisplay() = default;

GpuNeeds OpenXrDisplay::needs() const {
  return {.instance_extensions = impl_->mirror ? impl_->mirror->instance_extensions() : std::vector<std::string>(),
          .hooks = &impl_->vulkan};
}

void OpenXrDisplay::attach(Gpu& gpu) {
  impl_->let_go();
  impl_->seat.emplace(impl_->instance.value(), gpu.device(), impl_->world, impl_->mirror != nullptr);
  impl_->head.attach(impl_->clock.value(), impl_->seat->session.handle(), impl_->seat->spaces.place());
  const VkExtent2D eye = impl_->seat->session.view_size();
  if (impl_->mirror) impl_->mirror->attach(gpu.device(), impl_->vulkan.shows_windows(), eye);
  impl_->lost = false;
}

void OpenXrDisplay::begin(FrameInfo& frame) {
  frame.should_render = false;
  frame.target = nullptr;
  frame.view_count = max_views;
  impl_->guard([&] { impl_->begin(frame); });
  frame.time = impl_->last;
}

bool OpenXrDisplay::move_views(FrameInfo& frame) {
  return impl_->move_views(frame);
}

void OpenXrDisplay::end(const FrameInfo& frame) {
  impl_->guard([&] { impl_->end(frame); });
}

std::span<const Key> OpenXrDisplay::poll() {
  impl_->guard([this] { impl_->poll(); });
  return {impl_->keys.begin(), impl_->keys.size()};
}

bool OpenXrDisplay::closed() const {
  return impl_->closed || (impl_->seat && impl_->seat->session.over());
}

bool OpenXrDisplay::shows_world() const {
  return impl_->world != World::camera;
}

std::optional<Pose> OpenXrDisplay::head_at(Time time) const {
  return impl_->head.at(time);
}

bool OpenXrDisplay::recentre() {
  impl_->recentre = impl_->seat.has_value();
  return impl_->recentre;
}

std::string OpenXrDisplay::headset() const {
  return impl_->headset;
}

bool OpenXrDisplay::gpu_lost() const {
  return impl_->lost && impl_->instance && !impl_->closed;
}

void OpenXrDisplay::finish() {
  impl_->guard([this] {
    if (impl_->seat) impl_->seat->session.leave();
  });
  impl_->let_go();
  impl_->closed = true;
  if (!impl_->failure.empty()) throw Error(impl_->failure);
}

std::vector<std::string> OpenXrDisplay::report() const {
  const OpenXrSession::Count& count = impl_->count;
  return {"showed " + std::to_string(count.seen) + " of " + std::to_string(count.frames) + " frames in the headset " +
          impl_->headset + " of " + impl_->runtime + ", " + std::to_string(count.missed) + " missed, " +
          std::to_string(count.slow) + " of its own took longer than a display period"};
}

}  // namespace onestroke

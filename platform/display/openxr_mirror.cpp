#include "display/openxr_mirror.h"

#include "core/error.h"
#include "display/desktop_window.h"
#include "display/swapchain.h"
#include "render/resources.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

namespace onestroke {

namespace {

constexpr Duration between_pictures = Duration::from_seconds(1.0 / 30);
constexpr int most_height_at_first = 720;
// A window that is being dragged to another size gets images of that size when it has kept it for so long. What was
// shown before is done with by then, which nothing tells.
constexpr Duration settled_after = Duration::from_ms(200);

/// The largest part in the middle of an image that has the shape of another.
vk::ImageBlit2 fill(const RenderTarget& from, const RenderTarget& to) {
  const double scale = std::max(double{1} * to.width / from.width, double{1} * to.height / from.height);
  const auto width = std::min(from.width, static_cast<int>(std::lround(to.width / scale)));
  const auto height = std::min(from.height, static_cast<int>(std::lround(to.height / scale)));
  const int x = (from.width - width) / 2, y = (from.height - height) / 2;
  const vk::ImageSubresourceLayers first{.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1};
  return {.srcSubresource = first,
          .srcOffsets = {{vk::Offset3D{x, y, 0}, vk::Offset3D{x + std::max(width, 1), y + std::max(height, 1), 1}}},
          .dstSubresource = first,
          .dstOffsets = {{vk::Offset3D{0, 0, 0}, vk::Offset3D{to.width, to.height, 1}}}};
}

void record(const vk::raii::CommandBuffer& commands, const RenderTarget& from, const RenderTarget& to) {
  using Stage = vk::PipelineStageFlagBits2;
  using Reach = vk::AccessFlagBits2;
  using Layout = vk::ImageLayout;
  constexpr Access drawn{Stage::eAllCommands, Reach::eColorAttachmentWrite},
      read{Stage::eAllTransfer, Reach::eTransferRead}, nothing_yet{Stage::eAllTransfer, {}},
      written{Stage::eAllTransfer, Reach::eTransferWrite}, after{Stage::eAllCommands, {}};
  const auto layout = static_cast<Layout>(from.final_layout);
  commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  image_barrier(commands, from.image, {layout, Layout::eTransferSrcOptimal}, drawn, read);
  // Submission waits for the window's image at the stage of transfers.
  image_barrier(commands, to.image, {Layout::eUndefined, Layout::eTransferDstOptimal}, nothing_yet, written);
  const vk::ImageBlit2 region = fill(from, to);
  commands.blitImage2({.srcImage = from.image,
                       .srcImageLayout = Layout::eTransferSrcOptimal,
                       .dstImage = to.image,
                       .dstImageLayout = Layout::eTransferDstOptimal,
                       .regionCount = 1,
                       .pRegions = &region,
                       .filter = vk::Filter::eLinear});
  image_barrier(commands, from.image, {Layout::eTransferSrcOptimal, layout}, {Stage::eAllTransfer, {}}, after);
  image_barrier(commands, to.image, {Layout::eTransferDstOptimal, static_cast<Layout>(to.final_layout)}, written,
                after);
  commands.end();
}

/// All that is made anew with another device.
struct Screen {
  std::shared_ptr<Device> device;
  vk::raii::SurfaceKHR surface;
  Swapchain swapchain;
  vk::raii::CommandPool pool;
  vk::raii::CommandBuffer commands;
  vk::raii::Fence copied;
  DesktopWindow::Size size{};
  const RenderTarget* taken = nullptr;  // for the next picture
  bool copying = false, stale = true;
  Time changed{};  // when the size last did

  Screen(std::shared_ptr<Device> gpu, vk::raii::SurfaceKHR&& shown_on)
      : device(std::move(gpu)),
        surface(std::move(shown_on)),
        swapchain(*device, *surface, {.pace = SwapchainPace::at_once, .copied_to = true}),
        pool(device->vk().createCommandPool(
            {.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = device->queue_family()})),
        commands(
            std::move(device->vk().allocateCommandBuffers({.commandPool = *pool, .commandBufferCount = 1}).front())),
        copied(device->vk().createFence({})) {}
  Screen(const Screen&) = delete;
  ~Screen() { device->wait_idle(); }

  void outdate() {
    stale = true;
    changed = Time::now();
  }

  void follow(DesktopWindow::Size now) {
    if (now == size) return;
    size = now;
    outdate();
  }

  void rebuild_if_settled() {
    const bool area = size.width > 0 && size.height > 0;
    if (taken || copying || !area || Time::now() - changed < settled_after) return;
    stale = !swapchain.rebuild(size.width, size.height);
  }

  void take() {
    Swapchain::Status status{};
    taken = swapchain.acquire(status);
    if (!taken && status == Swapchain::Status::stale) outdate();
  }

  /// False where the window has no image for it now.
  bool copy(const RenderTarget& drawn) {
    if (!taken) return false;
    const RenderTarget& target = *std::exchange(taken, nullptr);
    pool.reset();
    record(commands, drawn, target);
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *commands};
    const vk::SemaphoreSubmitInfo wait{.semaphore = target.ready,
                                       .stageMask = vk::PipelineStageFlagBits2::eAllTransfer};
    const vk::SemaphoreSubmitInfo signal{.semaphore = target.done,
                                         .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    device->submit({.waitSemaphoreInfoCount = 1,
                    .pWaitSemaphoreInfos = &wait,
                    .commandBufferInfoCount = 1,
                    .pCommandBufferInfos = &buffer,
                    .signalSemaphoreInfoCount = 1,
                    .pSignalSemaphoreInfos = &signal},
                   *copied);
    return copying = true;
  }

  /// Shows what was copied, if it is ready, and takes the image for the next. Some drivers ask the desktop for an
  /// answer in both, which is why copy(), for which a frame of the headset's waits, does neither.
  void show(DesktopWindow::Size window) {
    if (copying) present_if_copied();
    follow(window);
    if (stale) rebuild_if_settled();
    if (!stale && !copying && !taken) take();
  }

  void present_if_copied() {
    // A driver that draws on the processor would wait for the copy.
    if (copied.getStatus() != vk::Result::eSuccess) return;
    device->vk().resetFences(*copied);
    copying = false;
    // Where no more can be shown, no more can be taken either.
    swapchain.present();
  }
};

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

void say_without(const char* why) {
  std::fprintf(stderr, "onestroke: no mirror window beside the headset: %s; --no-mirror does without\n", why);
}

}  // namespace

struct OpenXrMirror::Impl {
  DesktopWindow window;
  std::optional<Screen> screen;
  Time next{};
  bool shown = false, over = false;

  explicit Impl(const std::string& title)
      : window({.title = title, .width = most_height_at_first, .height = most_height_at_first, .hidden = true}) {}

  void open(std::shared_ptr<Device> device, VkExtent2D eye) {
    vk::raii::SurfaceKHR surface = window.make_surface(device->instance());
    if (!device->physical().getSurfaceSupportKHR(device->queue_family(), *surface))
      throw Error("the headset's GPU \"" + device->name() + "\" cannot show on this desktop");
    if (!shown) {
      const int height = std::min(static_cast<int>(eye.height), most_height_at_first);
      window.resize(height * static_cast<int>(eye.width) / static_cast<int>(eye.height), height);
      window.show();
      shown = true;
    }
    screen.emplace(std::move(device), std::move(surface));
  }

  void end() {
    over = true;
    if (shown) window.hide();
  }

  void fail(const std::exception& error) {
    say_without(error.what());
    end();
  }

  template <typename Work>
  void guard(Work&& work) noexcept {
    if (over || !screen || window.minimised()) return;
    try {
      work();
    } catch (const vk::DeviceLostError&) {
      // The headset's own frame will find out, and another device be attached.
    } catch (const std::exception& error) {
      fail(error);
    }
  }
};

OpenXrMirror::OpenXrMirror(const std::string& title) : impl_(std::make_unique<Impl>(title)) {}
OpenXrMirror::~OpenXrMirror() = default;

std::vector<std::string> OpenXrMirror::instance_extensions() const {
  return impl_->window.instance_extensions();
}

void OpenXrMirror::attach(std::shared_ptr<Device> device, bool can_present, VkExtent2D eye) {
  let_go();
  if (impl_->over) return;
  try {
    if (!can_present)
      throw Error("the headset's GPU \"" + device->name() + "\" lacks " VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    impl_->open(std::move(device), eye);
  } catch (const std::exception& error) {
    impl_->fail(error);
  }
}

void OpenXrMirror::let_go() {
  impl_->screen.reset();
}

void OpenXrMirror::copy(const RenderTarget& drawn) noexcept {
  impl_->guard([&] {
    const Time now = Time::now();
    if (now < impl_->next || !impl_->screen->copy(drawn)) return;
    // Kept to the beat, so that of 60 frames a second every other is shown and not every third.
    impl_->next = impl_->next + between_pictures;
    if (impl_->next <= now) impl_->next = now + between_pictures;
  });
}

void OpenXrMirror::show() noexcept {
  impl_->guard([this] { impl_->screen->show(impl_->window.size()); });
}

std::span<const Key> OpenXrMirror::poll() {
  const std::span<const Key> keys = impl_->window.poll();
  if (impl_->window.close_asked() && !impl_->over) impl_->end();
  return keys;
}

std::unique_ptr<OpenXrMirror> open_mirror(const std::string& title) {
  if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return nullptr;
  try {
    return std::make_unique<OpenXrMirror>(title);
  } catch (const Error& error) {
    say_without(error.what());
    return nullptr;
  }
}

}  // namespace onestroke

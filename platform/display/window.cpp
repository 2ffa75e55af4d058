#include "display/window.h"

#include "core/error.h"
#include "display/default_view.h"
#include "display/desktop_window.h"
#include "display/swapchain.h"

#include <optional>

namespace onestroke {

std::string window_shortfall() {
  try {
    const DesktopWindow window({.title = {}, .width = 64, .height = 64, .hidden = true});
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

struct WindowDisplay::Impl {
  WindowOptions options;
  DesktopWindow window;
  std::shared_ptr<Device> device;
  vk::raii::SurfaceKHR surface{nullptr};
  std::optional<Swapchain> swapchain;
  Duration interval{};
  bool stale = true, failed = false, lost = false;
  std::string failure;

  explicit Impl(const WindowOptions& o)
      : options(o), window({.title = o.title, .width = o.width, .height = o.height}), interval(refresh_interval()) {}

  /// The next image to draw into; null where the window has no area now, or nobody sees it.
  const RenderTarget* acquire() {
    if (window.minimised()) return nullptr;
    DesktopWindow::Size size = window.ask_size();
    // A window may change size again while its images are being made.
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (size.width == 0 || size.height == 0 || (stale && !rebuild(size))) return nullptr;
      Swapchain::Status status{};
      const RenderTarget* target = swapchain->acquire(status);
      stale = status == Swapchain::Status::stale ||
              (target && (target->width != size.width || target->height != size.height));
      if (target || !stale) return target;
      size = window.ask_size();
    }
    return nullptr;
  }

  bool rebuild(DesktopWindow::Size size) {
    device->vk().waitIdle();
    return swapchain->rebuild(size.width, size.height);
  }

  void let_go() {
    // The screen may still be showing the last frame.
    if (device) device->wait_idle();
    swapchain.reset();
    surface = nullptr;
    device.reset();
    stale = true;
    lost = false;
  }

  /// Runs what may throw in the loop; the first error closes the window, unless another GPU may mend it.
  template <typename Work>
  void guard(Work&& work) noexcept {
    try {
      if (!failed && !lost) work();
    } catch (const vk::DeviceLostError&) {
      lost = true;
    } catch (const vk::SurfaceLostKHRError&) {
      lost = true;
    } catch (const std::exception& error) {
      failure = std::string("the window cannot go on: ") + error.what();
      failed = true;
    }
  }
};

WindowDisplay::WindowDisplay(const WindowOptions& options) : impl_(std::make_unique<Impl>(options)) {}

WindowDisplay::~WindowDisplay() {
  impl_->let_go();
}

GpuNeeds WindowDisplay::needs() const {
  return {.instance_extensions = impl_->window.instance_extensions(),
          .device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME}};
}

void WindowDisplay::attach(Gpu& gpu) {
  impl_->let_go();
  impl_->device = gpu.device();
  impl_->surface = impl_->window.make_surface(impl_->device->instance());
  impl_->swapchain.emplace(
      *impl_->device, *impl_->surface,
      SwapchainOptions{.pace = impl_->options.wait_for_screen ? SwapchainPace::screen : SwapchainPace::newest});
}

void WindowDisplay::begin(FrameInfo& frame) {
  frame.target = nullptr;
  impl_->guard([&] { frame.target = impl_->acquire(); });
  frame.should_render = frame.target != nullptr;
  frame.time = Time::now() + impl_->interval;
  frame.view_count = 1;
  if (frame.should_render)
    frame.views[0] = default_view({0, 0, frame.target->width, frame.target->height});
  else
    impl_->window.wait(Duration::from_ms(20));
}

void WindowDisplay::end(const FrameInfo& frame) {
  if (!frame.should_render) return;
  impl_->guard([this] { impl_->stale |= impl_->swapchain->present() == Swapchain::Status::stale; });
}

std::span<const Key> WindowDisplay::poll() {
  return impl_->window.poll();
}

bool WindowDisplay::closed() const {
  return impl_->failed || impl_->window.close_asked();
}

bool WindowDisplay::gpu_lost() const {
  return impl_->lost;
}

void WindowDisplay::finish() {
  impl_->window.close();
  if (!impl_->failure.empty()) throw Error(impl_->failure);
}

void WindowDisplay::resize(int width, int height) {
  impl_->window.resize(width, height);
}

}  // namespace onestroke

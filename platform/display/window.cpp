#include "display/window.h"

#include "core/error.h"
#include "display/default_view.h"
#include "display/swapchain.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <optional>

namespace onestroke {

namespace {

/// GLFW starts with the first window and ends with the last.
class Glfw {
 public:
  Glfw() {
    if (!glfwInit()) fail("no desktop to open a window on");
    if (!glfwVulkanSupported()) {
      glfwTerminate();
      throw Error("this desktop cannot show Vulkan: apt install mesa-vulkan-drivers or the GPU's driver");
    }
  }
  Glfw(const Glfw&) = delete;
  ~Glfw() { glfwTerminate(); }

  [[noreturn]] static void fail(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(what + ": set DISPLAY, or use --display offscreen:DIR" +
                (reason ? std::string(" (") + reason + ")" : std::string()));
  }
};

struct CloseWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

Key special_key(int code) {
  switch (code) {
    case GLFW_KEY_ESCAPE:
      return Key::escape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return Key::enter;
    case GLFW_KEY_TAB:
      return Key::tab;
    case GLFW_KEY_LEFT:
      return Key::left;
    case GLFW_KEY_RIGHT:
      return Key::right;
    case GLFW_KEY_UP:
      return Key::up;
    case GLFW_KEY_DOWN:
      return Key::down;
    case GLFW_KEY_PAGE_UP:
      return Key::page_up;
    case GLFW_KEY_PAGE_DOWN:
      return Key::page_down;
    default:
      return Key::none;
  }
}

/// What was pressed since the last poll; more than fits is dropped.
struct Keys {
  std::array<Key, 32> list{};
  std::size_t count = 0;

  void add(Key key) {
    if (key != Key::none && count < list.size()) list[count++] = key;
  }
};

/// What the desktop has told of the window.
struct Events {
  Keys keys;
  bool minimised = false;
};

Events& events_of(GLFWwindow* window) {
  return *static_cast<Events*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int code, int, int action, int) {
  if (action == GLFW_PRESS) events_of(window).keys.add(special_key(code));
}

// Characters, unlike key codes, follow the user's keyboard layout.
void on_character(GLFWwindow* window, unsigned character) {
  if (character < 128) events_of(window).keys.add(static_cast<Key>(std::tolower(static_cast<int>(character))));
}

void on_minimised(GLFWwindow* window, int minimised) {
  events_of(window).minimised = minimised == GLFW_TRUE;
}

GLFWwindow* make_window(const WindowOptions& options) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GLFWwindow* window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (!window) Glfw::fail("the desktop opens no window");
  return window;
}

Duration refresh_interval() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return Duration::from_seconds(1.0 / (mode && mode->refreshRate > 0 ? mode->refreshRate : 60));
}

}  // namespace

struct WindowDisplay::Impl {
  Glfw glfw;
  WindowOptions options;
  Events events;
  Keys polled;
  std::unique_ptr<GLFWwindow, CloseWindow> window;
  std::shared_ptr<Device> device;
  vk::raii::SurfaceKHR surface{nullptr};
  std::optional<Swapchain> swapchain;
  Duration interval{};
  bool stale = true, failed = false, lost = false;
  std::string failure;

  explicit Impl(const WindowOptions& o) : options(o), window(make_window(o)), interval(refresh_interval()) {
    glfwSetWindowUserPointer(window.get(), &events);
    glfwSetKeyCallback(window.get(), on_key);
    glfwSetCharCallback(window.get(), on_character);
    glfwSetWindowIconifyCallback(window.get(), on_minimised);
  }

  /// The next image to draw into; null where the window has no area now, or nobody sees it.
  const RenderTarget* acquire() {
    if (events.minimised) return nullptr;
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    // A window may change size again while its images are being made.
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (width == 0 || height == 0 || (stale && !swapchain->rebuild(width, height))) return nullptr;
      Swapchain::Status status{};
      const RenderTarget* target = swapchain->acquire(status);
      stale = status == Swapchain::Status::stale || (target && (target->width != width || target->height != height));
      if (target || !stale) return target;
      glfwGetFramebufferSize(window.get(), &width, &height);
    }
    return nullptr;
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
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {.instance_extensions = {names, names + count}, .device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME}};
}

void WindowDisplay::attach(Gpu& gpu) {
  impl_->let_go();
  impl_->device = gpu.device();
  const Device& device = *impl_->device;
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(*device.instance(), impl_->window.get(), nullptr, &surface) != VK_SUCCESS)
    Glfw::fail("the desktop refuses Vulkan a window");
  impl_->surface = vk::raii::SurfaceKHR(device.instance(), surface);
  impl_->swapchain.emplace(*impl_->device, *impl_->surface, impl_->options.wait_for_screen);
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
    glfwWaitEventsTimeout(0.02);
}

void WindowDisplay::end(const FrameInfo& frame) {
  if (!frame.should_render) return;
  impl_->guard([this] { impl_->stale |= impl_->swapchain->present() == Swapchain::Status::stale; });
}

std::span<const Key> WindowDisplay::poll() {
  glfwPollEvents();
  impl_->polled = impl_->events.keys;
  impl_->events.keys.count = 0;
  return {impl_->polled.list.data(), impl_->polled.count};
}

bool WindowDisplay::closed() const {
  return impl_->failed || glfwWindowShouldClose(impl_->window.get());
}

bool WindowDisplay::gpu_lost() const {
  return impl_->lost;
}

void WindowDisplay::finish() {
  glfwSetWindowShouldClose(impl_->window.get(), GLFW_TRUE);
  if (!impl_->failure.empty()) throw Error(impl_->failure);
}

void WindowDisplay::resize(int width, int height) {
  glfwSetWindowSize(impl_->window.get(), width, height);
}

}  // namespace onestroke

#include "display/desktop_window.h"

#include "core/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cctype>

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
  DesktopWindow::Size size;
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

void on_size(GLFWwindow* window, int width, int height) {
  events_of(window).size = {width, height};
}

GLFWwindow* make_window(const DesktopWindow::Options& options) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_VISIBLE, options.hidden ? GLFW_FALSE : GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (!window) Glfw::fail("the desktop opens no window");
  return window;
}

}  // namespace

struct DesktopWindow::Impl {
  Glfw glfw;
  Events events;
  Keys polled;
  std::unique_ptr<GLFWwindow, CloseWindow> window;

  explicit Impl(const Options& options) : window(make_window(options)) {
    glfwSetWindowUserPointer(window.get(), &events);
    glfwSetKeyCallback(window.get(), on_key);
    glfwSetCharCallback(window.get(), on_character);
    glfwSetWindowIconifyCallback(window.get(), on_minimised);
    glfwSetFramebufferSizeCallback(window.get(), on_size);
    glfwGetFramebufferSize(window.get(), &events.size.width, &events.size.height);
  }
};

DesktopWindow::DesktopWindow(const Options& options) : impl_(std::make_unique<Impl>(options)) {}
DesktopWindow::~DesktopWindow() = default;

std::vector<std::string> DesktopWindow::instance_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

vk::raii::SurfaceKHR DesktopWindow::make_surface(const vk::raii::Instance& instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(*instance, impl_->window.get(), nullptr, &surface) != VK_SUCCESS)
    Glfw::fail("the desktop refuses Vulkan a window");
  return {instance, surface};
}

std::span<const Key> DesktopWindow::poll() {
  glfwPollEvents();
  impl_->polled = impl_->events.keys;
  impl_->events.keys.count = 0;
  return {impl_->polled.list.data(), impl_->polled.count};
}

void DesktopWindow::wait(Duration longest) const {
  glfwWaitEventsTimeout(longest.seconds());
}

bool DesktopWindow::minimised() const {
  return impl_->events.minimised;
}

bool DesktopWindow::close_asked() const {
  return glfwWindowShouldClose(impl_->window.get());
}

void DesktopWindow::close() {
  glfwSetWindowShouldClose(impl_->window.get(), GLFW_TRUE);
}

DesktopWindow::Size DesktopWindow::size() const {
  return impl_->events.size;
}

DesktopWindow::Size DesktopWindow::ask_size() const {
  Size size;
  glfwGetFramebufferSize(impl_->window.get(), &size.width, &size.height);
  return size;
}

void DesktopWindow::resize(int width, int height) {
  glfwSetWindowSize(impl_->window.get(), width, height);
}

void DesktopWindow::show() {
  glfwShowWindow(impl_->window.get());
}

void DesktopWindow::hide() {
  glfwHideWindow(impl_->window.get());
}

Duration refresh_interval() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return Duration::from_seconds(1.0 / (mode && mode->refreshRate > 0 ? mode->refreshRate : 60));
}

}  // namespace onestroke

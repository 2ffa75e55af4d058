#include "desktop/x_server.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <utility>

namespace onestroke::test {

struct XServer::Impl {
  ::Display* display;
  ::Time time = 1000;

  Window find_below(Window window, const std::string& title) const {
    char* name = nullptr;
    const bool found = XFetchName(display, window, &name) && name && name == title;
    if (name) XFree(name);
    if (found) return window;
    Window root = 0, parent = 0, *children = nullptr, result = 0;
    unsigned count = 0;
    if (!XQueryTree(display, window, &root, &parent, &children, &count)) return 0;
    for (unsigned i = 0; i < count && !result; ++i) result = find_below(children[i], title);
    if (children) XFree(children);
    return result;
  }

  void set_state(Window window, long state) const {
    const Atom name = XInternAtom(display, "WM_STATE", False);
    const std::array<long, 2> value{state, None};
    XChangeProperty(display, window, name, name, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(value.data()), 2);
  }
};

XServer::XServer(const char* name) : impl_(std::make_unique<Impl>(Impl{.display = XOpenDisplay(name)})) {}
XServer::~XServer() {
  if (impl_->display) XCloseDisplay(impl_->display);
}

bool XServer::answers() const {
  return impl_->display;
}

XServer::Window XServer::root() const {
  return DefaultRootWindow(impl_->display);
}

XServer::Window XServer::find(const std::string& title) const {
  return impl_->find_below(root(), title);
}

bool XServer::visible(Window window) const {
  XWindowAttributes attributes;
  return XGetWindowAttributes(impl_->display, window, &attributes) && attributes.map_state == IsViewable;
}

std::array<int, 3> XServer::pixel(Window window, int x, int y) const {
  XImage* image = XGetImage(impl_->display, window, x, y, 1, 1, AllPlanes, ZPixmap);
  const unsigned long p = image ? XGetPixel(image, 0, 0) : 0;
  if (image) XDestroyImage(image);
  return {static_cast<int>(p >> 16 & 255), static_cast<int>(p >> 8 & 255), static_cast<int>(p & 255)};
}

XServer::Picture XServer::picture(Window window) const {
  XWindowAttributes attributes;
  if (!XGetWindowAttributes(impl_->display, window, &attributes)) return {};
  Picture picture{attributes.width, attributes.height, {}};
  XImage* image = XGetImage(impl_->display, window, 0, 0, static_cast<unsigned>(picture.width),
                            static_cast<unsigned>(picture.height), AllPlanes, ZPixmap);
  if (!image) return {};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const unsigned long p = XGetPixel(image, x, y);
      for (const unsigned shift : {16U, 8U, 0U}) picture.rgb.push_back(static_cast<std::uint8_t>(p >> shift & 255U));
    }
  XDestroyImage(image);
  return picture;
}

void XServer::press(Window window, unsigned long symbol) {
  XKeyEvent event{};
  event.display = impl_->display;
  event.window = window;
  event.root = root();
  event.same_screen = True;
  event.keycode = XKeysymToKeycode(impl_->display, symbol);
  for (const auto& [type, mask] : {std::pair{KeyPress, KeyPressMask}, {KeyRelease, KeyReleaseMask}}) {
    event.type = type;
    // GLFW takes a press at the time of the last one for a repeat.
    event.time = ++impl_->time;
    XSendEvent(impl_->display, window, True, mask, reinterpret_cast<XEvent*>(&event));
  }
  XSync(impl_->display, False);
}

void XServer::close(Window window) {
  XClientMessageEvent event{};
  event.type = ClientMessage;
  event.window = window;
  event.message_type = XInternAtom(impl_->display, "WM_PROTOCOLS", False);
  event.format = 32;
  event.data.l[0] = static_cast<long>(XInternAtom(impl_->display, "WM_DELETE_WINDOW", False));
  XSendEvent(impl_->display, window, False, NoEventMask, reinterpret_cast<XEvent*>(&event));
  XSync(impl_->display, False);
}

void XServer::resize(Window window, int width, int height) {
  XResizeWindow(impl_->display, window, static_cast<unsigned>(width), static_cast<unsigned>(height));
  XSync(impl_->display, False);
}

void XServer::raise(Window window) {
  XRaiseWindow(impl_->display, window);
  XSync(impl_->display, False);
}

void XServer::minimise(Window window) {
  impl_->set_state(window, IconicState);
  XUnmapWindow(impl_->display, window);
  XSync(impl_->display, False);
}

void XServer::restore(Window window) {
  XMapWindow(impl_->display, window);
  impl_->set_state(window, NormalState);
  XSync(impl_->display, False);
}

}  // namespace onestroke::test

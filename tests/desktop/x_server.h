#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace onestroke::test {

/// An X server as another program than the one whose windows are on it sees it.
class XServer {
 public:
  using Window = unsigned long;

  /// ":1", or whatever DISPLAY says where it is null.
  explicit XServer(const char* name = nullptr);
  ~XServer();

  bool answers() const;
  Window root() const;
  /// The first window with that title, 0 for none.
  Window find(const std::string& title) const;
  bool visible(Window window) const;

  /// Rows from the top, red, green and blue.
  struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
  };
  Picture picture(Window window) const;
  /// sRGB, 0 to 255.
  std::array<int, 3> pixel(Window window, int x, int y) const;

  /// A key pressed and released; one of X11/keysym.h.
  void press(Window window, unsigned long symbol);
  /// As by the button in its title bar.
  void close(Window window);
  void resize(Window window, int width, int height);
  /// Before all other windows.
  void raise(Window window);
  /// What a window manager does, of which there need be none.
  void minimise(Window window);
  void restore(Window window);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke::test

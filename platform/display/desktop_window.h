#pragma once

#include "render/display.h"
#include "render/vulkan.h"

#include <memory>
#include <string>
#include <vector>

namespace onestroke {

/// A window of the desktop's, and what the desktop has told of it. The thread that makes it must be the program's main
/// one, and is the only one that uses it.
class DesktopWindow {
 public:
  struct Options {
    std::string title;
    int width = 0, height = 0;  ///< In the desktop's units.
    bool hidden = false;        ///< Until show().
  };

  /// Throws Error where there is no desktop, or one that does not show Vulkan.
  explicit DesktopWindow(const Options& options);
  ~DesktopWindow();

  /// What Vulkan's instance needs for make_surface().
  std::vector<std::string> instance_extensions() const;
  /// The instance outlives it. Throws Error where the desktop refuses.
  vk::raii::SurfaceKHR make_surface(const vk::raii::Instance& instance) const;

  /// Hears the desktop out. Keys pressed since the last call; valid until the next.
  std::span<const Key> poll();
  /// Waits for the desktop to have something to tell, which poll() hears.
  void wait(Duration longest) const;
  bool minimised() const;
  /// True once the user, or close(), has asked for the end.
  bool close_asked() const;
  void close();

  struct Size {
    int width = 0, height = 0;  ///< Pixels; 0 where it has no area.
    friend bool operator==(const Size&, const Size&) = default;
  };
  /// As it was told last.
  Size size() const;
  /// As it is now, for which the desktop must be asked and may take its time.
  Size ask_size() const;
  /// Asks for another size, as a user would with the mouse.
  void resize(int width, int height);

  void show();
  void hide();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The primary screen's, or a sixtieth of a second where it does not say. There must be a DesktopWindow.
Duration refresh_interval();

}  // namespace onestroke

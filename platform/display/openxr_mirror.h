#pragma once

#include "render/device.h"
#include "render/display.h"

#include <memory>

namespace onestroke {

/// A window on the desktop that shows what the headset's left eye sees, in the middle where the shapes differ. It never
/// makes the headset wait: a picture that the window is not ready for is left out, and where the window cannot go on,
/// or its user closes it, there are no more, and the headset's show goes on. At most 30 pictures a second. One thread,
/// the program's main one.
class OpenXrMirror {
 public:
  /// Throws Error where there is no desktop, or one that does not show Vulkan.
  explicit OpenXrMirror(const std::string& title);
  ~OpenXrMirror();

  /// What Vulkan's instance needs for it.
  std::vector<std::string> instance_extensions() const;

  /// Opens the window, for eyes of that many pixels. `can_present`: whether the device has VK_KHR_swapchain. Where the
  /// GPU cannot show on the desktop that is said on standard error, once, and there is no window. Throws Error.
  void attach(std::shared_ptr<Device> device, bool can_present, VkExtent2D eye);
  /// The way back, before the device goes. Waits for the GPU.
  void let_go();

  /// Copies the first layer of what was drawn and handed to the GPU, if it is time for a picture. The image must have
  /// been made to be copied from, and is left in the layout that it came in.
  void copy(const RenderTarget& drawn) noexcept;
  /// Shows what was copied, once the GPU has done so. Called after the headset's frame has ended.
  void show() noexcept;

  /// Keys pressed in it since the last call; valid until the next.
  std::span<const Key> poll();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// None where no screen is named (DISPLAY, WAYLAND_DISPLAY); nor where it cannot be had, which is said on standard
/// error.
std::unique_ptr<OpenXrMirror> open_mirror(const std::string& title);

}  // namespace onestroke

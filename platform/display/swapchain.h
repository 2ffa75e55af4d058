#pragma once

#include "render/frame_ring.h"
#include "render/target.h"

namespace onestroke {

/// The images that a surface shows in turn.
class Swapchain {
 public:
  /// Throws Error where the GPU cannot show on the surface in an sRGB format.
  Swapchain(Device& device, vk::SurfaceKHR surface, bool wait_for_screen);

  /// Makes images of the surface's size, or of `width` x `height` where the surface leaves that open. False where the
  /// surface has no area. Waits for the GPU.
  bool rebuild(int width, int height);

  enum class Status {
    good,
    stale,  ///< rebuild before the next frame
  };
  /// Takes the next image. Null where there is none: with `stale` there will be none, with `good` the screen, which may
  /// not be showing the window at all, has left none free for a tenth of a second.
  const RenderTarget* acquire(Status& status);
  /// Shows the image taken last.
  Status present();

 private:
  // A semaphore is free again when the frame that waited for it is done, which the renderer makes sure of one frame
  // later than it allows frames in flight.
  static constexpr std::size_t acquires = frames_in_flight + 1;

  void make_targets(vk::Extent2D extent);

  Device& device_;
  vk::SurfaceKHR surface_;
  vk::SurfaceFormatKHR format_;
  vk::PresentModeKHR mode_;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  std::vector<vk::raii::ImageView> views_;
  std::vector<vk::raii::Semaphore> done_;
  std::vector<RenderTarget> targets_;
  std::array<vk::raii::Semaphore, acquires> ready_;
  std::size_t next_ready_ = 0;
  std::uint32_t taken_ = 0;
};

}  // namespace onestroke

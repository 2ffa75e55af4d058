#pragma once

#include "render/frame_ring.h"
#include "render/target.h"

namespace onestroke {

/// How the images of a surface follow each other.
enum class SwapchainPace {
  screen,   ///< Each waits for the screen's refresh.
  newest,   ///< The newest wins, where the driver can do that; otherwise as `screen`.
  at_once,  ///< The newest wins, and neither taking an image nor showing it waits.
};

struct SwapchainOptions {
  SwapchainPace pace = SwapchainPace::screen;
  bool copied_to = false;  ///< Images are not only drawn into.
};

/// The images that a surface shows in turn.
class Swapchain {
 public:
  /// Throws Error where the GPU cannot show on the surface in an sRGB format, or not as the options want it.
  Swapchain(Device& device, vk::SurfaceKHR surface, const SwapchainOptions& options);

  /// Makes images of the surface's size, or of `width` x `height` where the surface leaves that open. False where the
  /// surface has no area. The GPU must be done with the images that were taken.
  bool rebuild(int width, int height);

  enum class Status {
    good,
    stale,  ///< rebuild before the next frame
  };
  /// Takes the next image. Null where there is none: with `stale` there will be none, with `good` the screen, which may
  /// not be showing the window at all, has left none free: at once, or else for a tenth of a second.
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
  vk::ImageUsageFlags usage_;
  std::uint64_t longest_wait_ns_;
  vk::raii::SwapchainKHR swapchain_{nullptr};
  std::vector<vk::raii::ImageView> views_;
  std::vector<vk::raii::Semaphore> done_;
  std::vector<RenderTarget> targets_;
  std::array<vk::raii::Semaphore, acquires> ready_;
  std::size_t next_ready_ = 0;
  std::uint32_t taken_ = 0;
};

}  // namespace onestroke

#pragma once

#include "render/depth_surface.h"
#include "render/frame_pass.h"
#include "render/pipelines.h"
#include "render/target.h"

#include <optional>

namespace onestroke {

/// Tells a display that projects what it shows once more how far away that is: the surface on which the camera's
/// picture lies, and before it what stands in the room. Labels and other marks have the depth of what is behind them.
class DepthPass {
 public:
  DepthPass(Device& device, const Layouts& layouts) : device_(device), layouts_(layouts) {}

  /// Into the target's depth image, which it has. `surface`: null where there is no picture. The frame's set is bound,
  /// and the foreground's depth can be sampled within pass.foreground.
  void record(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const FramePass& pass,
              vk::Rect2D viewport, const DepthSurface* surface);

 private:
  struct DepthPipelines {
    vk::Format format = vk::Format::eUndefined;
    vk::raii::Pipeline surface, foreground;
  };

  const DepthPipelines& pipelines_for(vk::Format format, std::uint32_t view_mask);

  Device& device_;
  const Layouts& layouts_;
  // For one view alone, and for several at once.
  std::array<std::optional<DepthPipelines>, 2> pipelines_;
};

}  // namespace onestroke

#pragma once

#include "render/frame_scene.h"
#include "render/pipelines.h"
#include "render/resources.h"
#include "render/target.h"

namespace onestroke {

/// What a frame is drawn into before it is resolved into the display's image: colour and depth with several samples a
/// pixel, and a layer for every view that is drawn at once.
class FrameTargets {
 public:
  explicit FrameTargets(Device& device) : device_(device) {}

  /// How the samples get to the display's image.
  enum class Way {
    at_once,   ///< All layers in one pass, which resolves them itself.
    by_layer,  ///< A pass for each layer, then a transfer: Mesa 22's lavapipe resolves every pass to the first layer.
  };

  /// Makes them as large as the target; what does not fit any more goes to the graveyard.
  void fit(const RenderTarget& target, Way way, Graveyard& graveyard);

  /// Takes the display's image for drawing, and gives it back.
  void open(const vk::raii::CommandBuffer& commands, const RenderTarget& target) const;
  void close(const vk::raii::CommandBuffer& commands, const RenderTarget& target) const;

  /// One pass: over the views of `view_mask`, or, where that is 0, over one layer, which end_pass() names.
  void begin_pass(const vk::raii::CommandBuffer& commands, const RenderTarget& target, std::uint32_t view_mask,
                  const Color& background) const;
  void end_pass(const vk::raii::CommandBuffer& commands, const RenderTarget& target, std::uint32_t layer) const;

 private:
  Device& device_;
  Way way_ = Way::at_once;
  Image color_, depth_;
};

}  // namespace onestroke

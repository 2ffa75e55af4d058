#pragma once

#include "render/depth_surface.h"
#include "render/finger_matte.h"
#include "render/frame_ring.h"
#include "render/pipelines.h"

namespace onestroke {

/// Draws the camera's picture once more over the models, where fingers are and as near as they are.
class FingerLayer {
 public:
  explicit FingerLayer(Device& device);

  /// See FingerMatte.
  void find(const Picture& picture, std::span<const CoveredCell> cells);
  void clear() { matte_.find({}, {}); }

  /// Takes the matte to the GPU where it has changed.
  void record(FrameSlot& slot);
  /// Between the models and what is written over them, for the views that see that picture.
  void draw(const vk::raii::CommandBuffer& commands, const Layouts& layouts, const Pipelines& pipelines,
            const DepthSurface& surface, std::size_t picture) const;

  /// The matte, ready for sampling.
  vk::ImageView view() const { return image_.view(); }
  /// Texture coordinates of the matte for those of a picture of that size: a factor for each axis.
  std::array<float, 2> matte_from_picture(int width, int height) const;

 private:
  static constexpr std::size_t slots = frames_in_flight + 1;

  FingerMatte matte_;
  std::array<PlaneBounds, FingerMatte::most_fingers> bounds_;  // of its fingers
  Image image_;
  std::array<Buffer, slots> staging_;
  std::size_t next_ = 0;
  bool pending_ = true;
};

}  // namespace onestroke

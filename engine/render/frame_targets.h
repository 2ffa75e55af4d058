#pragma once

#include "render/frame_pass.h"
#include "render/frame_scene.h"
#include "render/pipelines.h"
#include "render/resources.h"
#include "render/target.h"

namespace onestroke {

/// What a frame is drawn into. What stands in the room is drawn first, by itself, with several samples a pixel and
/// depth, where it may be seen and nowhere else: the foreground. The picture is drawn after it, straight into the
/// display's image, and the foreground is laid over it. So what has no edges, which is most of a frame, does not pay
/// for smooth ones.
class FrameTargets {
 public:
  explicit FrameTargets(Device& device) : device_(device) {}

  /// Makes the foreground as large as the target, with a layer for every view that is drawn at once; what does not fit
  /// any more goes to the graveyard.
  void fit(const RenderTarget& target, std::uint32_t views_at_once, Graveyard& graveyard);
  /// The foreground as the picture's pass samples it: premultiplied, an array.
  vk::ImageView foreground() const { return foreground_.view(); }
  /// Its depth as the pass for a target that wants depth samples it, an array; null for other targets.
  vk::ImageView foreground_depth() const { return depth_view_ ? **depth_view_ : vk::ImageView(); }

  void begin_foreground(const vk::raii::CommandBuffer& commands, const FramePass& pass) const;
  void end_foreground(const vk::raii::CommandBuffer& commands) const;

  /// Takes the display's image for drawing, and gives it back.
  /// With the depth that it wants, if any.
  static void open(const vk::raii::CommandBuffer& commands, const RenderTarget& target);
  static void close(const vk::raii::CommandBuffer& commands, const RenderTarget& target);
  /// Within a pass's viewport.
  static void begin_picture(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const FramePass& pass,
                            vk::Rect2D viewport, const Color& background);

 private:
  Device& device_;
  Image color_, depth_, foreground_;
  std::shared_ptr<vk::raii::ImageView> depth_view_;
};

}  // namespace onestroke

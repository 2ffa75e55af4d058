#pragma once

#include "render/depth_pass.h"
#include "render/depth_surface.h"
#include "render/frame_data.h"
#include "render/frame_ring.h"
#include "render/frame_targets.h"
#include "render/imgui_pass.h"
#include "render/lighting.h"
#include "render/model_pass.h"
#include "render/overlay.h"
#include "render/seen_picture.h"
#include "render/view.h"

#include <optional>

namespace onestroke {

/// Turns a scene into the commands of one frame. Keeps what lasts longer than a frame: pipelines and attachments.
class FrameRecorder {
 public:
  /// multiview: whether views that look through equal viewports are drawn in one pass, where the driver can do that.
  FrameRecorder(Device& device, const Layouts& layouts, const ModelStore& models, bool multiview);

  /// What comes from the camera.
  struct Seen {
    SeenPictures pictures;
    Lighting& lighting;
  };

  /// views_move: whether move_views() will be called for the frame.
  void record(FrameSlot& slot, const FrameScene& scene, std::span<const View> views, const RenderTarget& target,
              const Seen& seen, bool views_move = false);
  /// Sees the frame that was recorded last from where the views are now, a little way off.
  void move_views(FrameSlot& slot, std::span<const View> views, const SeenPictures& pictures);

 private:
  bool can_draw_together(std::span<const View> views);
  const Pipelines& pipelines_for(const RenderTarget& target, std::uint32_t view_mask);
  void build_surfaces(const FrameScene& scene, std::span<const View> views, const SeenPictures& pictures);
  void build_surface(std::size_t picture, const FrameScene& scene, bool aside, const SeenPictures& pictures,
                     bool in_cells);
  void find_foreground(FramePass& pass, float margin_px) const;
  void write_set(const FrameSlot& slot, const Seen& seen) const;
  void record_foreground(const FrameSlot& slot, const FramePass& pass, const Pipelines& pipelines,
                         std::span<const View> drawn, const FrameScene& scene, const Seen& seen);
  void record_picture(const FrameSlot& slot, const FramePass& pass, const Pipelines& pipelines,
                      std::span<const View> drawn, const RenderTarget& target, const FrameScene& scene,
                      const Seen& seen) const;
  void record_passthrough(const FrameSlot& slot, const Pipelines& pipelines, bool ideal_lens) const;
  /// From the first to before the end.
  void record_quads(const FrameSlot& slot, vk::Pipeline pipeline, std::uint32_t first, std::uint32_t end) const;

  Device& device_;
  const Layouts& layouts_;
  const bool multiview_;
  std::optional<bool> multiview_works_;  // asked when there are first two views
  ModelPass models_;
  Overlay overlay_;
  Surfaces surfaces_;
  FrameTargets targets_;
  DepthPass depth_;
  vk::raii::Sampler sampler_;
  Image glyphs_;
  ImguiPass gui_;
  // For one view alone, and for several at once.
  std::array<std::optional<Pipelines>, 2> pipelines_;
  FrameData data_;
};

}  // namespace onestroke

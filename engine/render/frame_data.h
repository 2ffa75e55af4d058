#pragma once

#include "render/depth_surface.h"
#include "render/frame_ring.h"
#include "render/frame_scene.h"
#include "render/imgui_pass.h"
#include "render/overlay.h"
#include "render/picture_store.h"
#include "render/room_light.h"
#include "render/view.h"

namespace onestroke {

/// One drawing of some views: all of them at once, or one alone.
struct FramePass {
  std::uint32_t view_mask = 0;  ///< A bit for every view that is drawn at once; 0 for one alone.
  std::size_t first_view = 0;
  std::uint64_t views_at = 0;  ///< Where its gpu::ViewData begin in the arena.
};

/// What a frame's shaders read: written to the frame's arena, and where it lies there. Offsets in bytes.
struct FrameData {
  std::array<FramePass, max_views> passes;
  std::size_t pass_count = 0;
  bool passthrough = false;
  std::uint64_t scene_at = 0, surface_at = 0, surface_bytes = 0, quads_at = 0, lines_at = 0;
};

/// Splits the views into passes: together in one where that can be, otherwise one for each.
void plan_passes(FrameData& data, std::span<const View> views, bool together);

/// What goes into the arena.
struct FrameParts {
  const FrameScene& scene;
  std::span<const View> views;
  const PictureStore& picture;
  const RoomLight& light;
  const DepthSurface& surface;
  const Overlay& overlay;
  std::span<const gpu::vec4> balls;         ///< See ModelPass::balls().
  std::array<float, 2> matte_from_picture;  ///< See FingerLayer.
};

/// Leaves room behind for ImguiPass::put().
void fill_arena(FrameData& data, Device& device, Arena& arena, const FrameParts& parts);

}  // namespace onestroke

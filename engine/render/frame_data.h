#pragma once

#include "render/depth_surface.h"
#include "render/frame_pass.h"
#include "render/frame_ring.h"
#include "render/frame_scene.h"
#include "render/imgui_pass.h"
#include "render/overlay.h"
#include "render/room_light.h"
#include "render/seen_picture.h"
#include "render/view.h"

namespace onestroke {

/// What a frame's shaders read: written to the frame's arena, and where it lies there. Offsets in bytes.
struct FrameData {
  std::array<FramePass, max_views> passes;
  std::size_t pass_count = 0;
  bool passthrough = false;
  std::uint64_t scene_at = 0, surface_at = 0, surface_bytes = 0, quads_at = 0, lines_at = 0;
};

/// Splits the views into passes: together in one where that can be, otherwise one for each.
void plan_passes(FrameData& data, std::span<const View> views, bool together, const SeenPictures& pictures);

/// Moves the views of planned passes whose parts fill_arena() has put into the arena.
void move_views(FrameData& data, Arena& arena, std::span<const View> views, const SeenPictures& pictures);

/// The surfaces that the pictures lie on, each in its own camera's frame.
using Surfaces = std::array<DepthSurface, MOST_PICTURES>;

/// What goes into the arena.
struct FrameParts {
  const FrameScene& scene;
  std::span<const View> views;
  const SeenPictures& pictures;
  const RoomLight& light;
  const Surfaces& surfaces;
  const Overlay& overlay;
  std::span<const gpu::vec4> balls;  ///< See ModelPass::balls().
};

/// Leaves room behind for ImguiPass::put().
void fill_arena(FrameData& data, Device& device, Arena& arena, const FrameParts& parts);

}  // namespace onestroke

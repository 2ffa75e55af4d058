#pragma once

#include "render/vulkan.h"
#include "shaders/shared.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace onestroke {

/// One drawing of some views: all of them at once, or one alone.
struct FramePass {
  std::uint32_t view_mask = 0;  ///< A bit for every view that is drawn at once; 0 for one alone.
  std::size_t first_view = 0, view_count = 1;
  std::array<gpu::ViewData, PASS_VIEWS> views{};
  std::uint64_t views_at = 0;  ///< Where they begin in the arena.
  vk::Rect2D foreground{};     ///< Where models, lines and labels may be seen, pixels of the target.
};

}  // namespace onestroke

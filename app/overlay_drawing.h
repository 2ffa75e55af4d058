#pragma once

#include "app/canvas.h"
#include "core/frame_record.h"
#include "marker/catalog.h"

#include <optional>

namespace onestroke {

struct Pixel {
  double u = 0, v = 0;
};

/// Where a camera sees a point (camera axes, mm), distortion included; nothing behind it or nearly so.
std::optional<Pixel> pixel_of(const Intrinsics& intrinsics, Vec3 point);

/// Draws what was found over the picture: the rod's outline and ring edges at the reported pose, the marker's axes (x
/// red, y green, z blue), a dot on each cell that was seen, and the name. Markers that the catalogue lacks are left
/// out.
void draw_overlay(Canvas& canvas, const Intrinsics& intrinsics, const Catalog& catalog, const FrameRecord& record);

}  // namespace onestroke

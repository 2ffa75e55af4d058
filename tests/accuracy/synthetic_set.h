#pragma once

#include "marker/catalog.h"
#include "score.h"

namespace onestroke::accuracy {

/// Sixteen markers; those with even ids are bent with a radius of 8 mm.
Catalog synthetic_catalog();

/// Names of the groups: a turn of 360 degrees about each axis, 300 to 700 mm away, before an even background; and any
/// orientation before a room.
std::vector<std::string> synthetic_groups();

/// Draws the pictures of a group as the paper's camera takes them, 1600 x 1200 at 35 degrees, with mild noise and
/// blur. The same pictures every time.
void draw_synthetic(const std::string& group, const Visit& visit);

}  // namespace onestroke::accuracy

#pragma once

#include "core/frame_record.h"
#include "marker/catalog.h"
#include "scene/comparison_view.h"
#include "scene/model_difference.h"

#include <string>

namespace onestroke {

/// What a snapshot's picture shows, in numbers: JSON, one object. Poses as in the tracker's output: R row by row, t in
/// mm, world from marker. `difference` may be null.
std::string snapshot_numbers(const Catalog& catalog, const FrameRecord& record, const ComparisonView& compared,
                             const DifferenceStatistics* difference);

}  // namespace onestroke

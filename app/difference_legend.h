#pragma once

#include "app/scene_builder.h"
#include "scene/model_difference.h"
#include "scene/text.h"

#include <array>
#include <span>

namespace onestroke {

/// What the colours of a map of differences mean, at the screen's right edge, and its statistics as words. Keeps its
/// words; one thread, allocates nothing.
class DifferenceLegend {
 public:
  void draw(SceneBuilder& scene, const HudArea& area, double em, const DifferenceStatistics& statistics,
            double opacity);

 private:
  std::array<Text, 3> ticks_;
};

/// The statistics, a line each.
void print_statistics(const DifferenceStatistics& statistics, std::span<Text, 3> lines);

}  // namespace onestroke

#pragma once

#include "scene/surface_difference.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace onestroke {

/// A model as it is compared with another: all its parts as one surface without looks, metres, the model's own frame.
struct ComparedModel {
  /// Throws Error "NAME has no surface" where no triangle has any area.
  explicit ComparedModel(const Model& model);

  std::string name;
  Surface surface;
  Surface refined;    ///< The same with edges of 1.2 % of its size at most, as far as that can be; see refine().
  bool double_sided;  ///< Some part is to be seen from behind.
  glm::dvec3 middle;  ///< Of the box round it.
  double size;        ///< The box's diagonal.
  std::uint64_t sum;  ///< Of the surface's bytes: the same surface has the same sum.
};

/// How two models are laid on each other: as their frames say, or as their surfaces lie best.
enum class Alignment { own_frames, best_fit };

/// Of the distances from `laid` to `base`, and of the two by themselves. mm, mm^2, mm^3, degrees.
struct DifferenceStatistics {
  double mean = 0, rms = 0, p95 = 0, most = 0;  ///< See SurfaceDifference.
  double reach = 0;                             ///< Of the ColorScale that shows the distances.
  SurfaceMeasures laid, base;
  /// By the best fit: its own rms, how far the middle of `laid` was moved by it, and how far `laid` was turned. 0
  /// where the models' own frames were taken.
  double fit_rms = 0, moved = 0, turned_deg = 0;

  double area_change() const { return laid.area - base.area; }
  double volume_change() const { return laid.volume - base.volume; }
};

/// All that takes long to find out of two models.
struct ModelDifference {
  glm::dmat4 base_from_laid{1.0};  ///< Rigid; the models' own frames, metres.
  /// Signed distances at the vertices of each one's refined surface to the other's surface, metres; see
  /// SurfaceDifference.
  std::vector<float> laid, base;
  DifferenceStatistics statistics;
};

/// Seconds for a million triangles each.
ModelDifference compare(const ComparedModel& laid, const ComparedModel& base, Alignment alignment,
                        const DifferenceOptions& options = {});

}  // namespace onestroke

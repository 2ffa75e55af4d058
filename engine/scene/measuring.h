#pragma once

#include "scene/point_picker.h"
#include "scene/similarity.h"

#include <array>

namespace onestroke {

/// Points picked on a model, and what lies between them.
struct MeasureView {
  double amount = 0;         ///< 0 where nothing is measured; eased.
  Vec3 tip_world;            ///< What picks, mm.
  double pick_progress = 0;  ///< 0 to 1, of the next point.
  std::array<Vec3, 3> points_world{};
  int count = 0;
  double distance = 0;    ///< From the first to the second, mm of the model's own size.
  double distance_2 = 0;  ///< From the second to the third.
  double angle_deg = 0;   ///< At the second, between the other two.
};

/// Measures between up to three points of a model, which stay with it as it turns.
class Measuring {
 public:
  /// The first point is picked after the tip has left where it is now; world_from_marker as below.
  void begin(Vec3 tip_world, const Similarity& world_from_marker);
  /// One frame: the tip, nothing where it is not near the model or does something else; where the model is shown, and
  /// how large a millimetre of its own is there.
  void update(const std::optional<Vec3>& tip_world, const Similarity& world_from_marker, double mm_scale, Time now);
  /// All but the amount.
  const MeasureView& view() const { return view_; }

 private:
  void fill(const Similarity& world_from_marker, double mm_scale);

  PointPicker picker_;
  std::array<Vec3, 3> points_{};  // in the marker's frame that the model is shown in
  int count_ = 0;
  MeasureView view_;
};

}  // namespace onestroke

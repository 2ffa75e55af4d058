#pragma once

#include "core/pose.h"

#include <array>

namespace onestroke {

/// A pose over the time in which one picture is exposed: five poses, equally spaced from u = 0 (the first row's first
/// light) to u = 1 (the last row's last), the third one at the exposure's middle.
class PosePath {
 public:
  static constexpr int knots = 5;

  PosePath() = default;
  /// Something that stands still.
  PosePath(const Pose& still) { poses_.fill(still); }
  explicit PosePath(const std::array<Pose, knots>& poses);

  bool still() const { return still_; }
  const Pose& middle() const { return poses_[knots / 2]; }
  const std::array<Pose, knots>& poses() const { return poses_; }
  Pose at(double u) const;

 private:
  std::array<Pose, knots> poses_{};
  bool still_ = true;
};

}  // namespace onestroke

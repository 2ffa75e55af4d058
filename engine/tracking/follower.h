#pragma once

#include "core/frame_record.h"
#include "tracking/detector.h"
#include "tracking/motion_filter.h"
#include "tracking/pose_filter.h"
#include "tracking/tracker.h"

namespace onestroke {

/// What is remembered of one marker from picture to picture. World axes, so that the head's motion is not the marker's.
class Follower {
 public:
  enum class Phase { unknown, followed, lost };

  Phase phase() const { return phase_; }
  bool ever_seen() const { return phase_ != Phase::unknown; }
  const Inks& inks() const { return inks_; }

  /// T_world_marker at a time: by MotionFilter, for up to 200 ms after the last measurement, as
  /// a hand that is not seen stops as likely as it goes on.
  Pose predict(Time t) const;
  /// A hand can have brought the marker from where it was last seen to this pose, or to this pose from where it was
  /// last found to be implausible: twice in one place is no mistake. True where it is not followed.
  bool plausible(Time t, const Pose& T_world_marker);
  /// Where it was last measured, T_world_marker, as that and the measurements before it tell together; and the
  /// covariance, world axes.
  const Pose& last_seen() const { return T_world_marker_; }
  const Matrix6d& covariance() const { return filter_.estimate().covariance; }
  /// It has not moved for as long as that many pictures tell.
  int standing_for() const { return filter_.estimate().pictures; }
  /// Takes a picture's measurement in, world axes. `velocity`: of T_world_marker, where the picture told it well, or
  /// else nullptr; it counts where no measurement shortly before tells it better. `sharp`: PoseFilter's.
  void measured(Time t, const PoseMeasurement& measurement, const Inks& inks, const Velocity* velocity = nullptr,
                const PoseMeasurement* sharp = nullptr);
  /// The marker was not found at a time: followed becomes lost, and lost becomes unknown.
  void missed(Time t, const TrackerOptions& options);
  void forget() {
    if (ever_seen()) *this = {};
  }

  Velocity velocity() const { return motion_.velocity(); }
  /// How certain the velocity is at a time.
  MotionPrior motion_prior(Time t) const;
  /// predict() with what it is off by as MotionFilter expects.
  PoseMeasurement expectation(Time t) const;
  /// Covariance of the prediction, world axes: the last measurement's, grown with the time since.
  Matrix6d predicted_covariance(Time t) const;

 private:
  Phase phase_ = Phase::unknown;
  Time last_;
  Pose T_world_marker_;
  bool near_prediction(Time t, const Pose& T_world_marker) const;

  // Where it was found last that was not plausible, and when.
  Time doubted_;
  Pose T_world_doubted_;
  Inks inks_;
  PoseFilter filter_;
  MotionFilter motion_;
};

}  // namespace onestroke

#pragma once

#include "camera/rod.h"
#include "camera/synthetic_renderer.h"
#include "core/frame_record.h"
#include "tracking/tracker.h"

#include <cstdint>
#include <string>
#include <vector>

namespace onestroke::accuracy {

/// A scene at one time, world axes.
struct Scene {
  struct Stick {
    int id = 0;
    Pose T_world_marker;
  };
  struct Finger {
    Pose T_world_finger;
    double radius = 8, length = 60;
  };
  std::vector<Stick> sticks;
  std::vector<Finger> fingers;
  Pose T_world_camera;
  /// What the head's tracking says of it.
  Pose T_world_camera_told;
};

/// The same pose as T_world_marker turned about the middle of an angle, which lies at `place`, mm.
Pose about_middle(Quat rotation, Vec3 place);

/// Degrees.
double turn_deg(const Pose& a, const Pose& b);

/// A live tracker before pictures that the paper's camera takes one after another: 1600 x 1200 at 35 degrees, noise of
/// 2 levels that is fresh in every picture, a blur of half a pixel.
class Film {
 public:
  explicit Film(double pictures_a_second = 30, const TrackerOptions& options = {});

  /// Takes the next picture. Answers hold until the next call.
  const FrameRecord& take(const Scene& scene);
  /// A scene of one marker before a camera that stands still.
  const FrameRecord& take(int id, const Pose& T_camera_marker);

  /// Of the picture last taken.
  const MarkerObservation* find(int id) const;
  int cells_visible(std::size_t stick) const { return cells_visible_[stick]; }
  /// Seconds from the first picture to the next one.
  double time() const { return taken_ / pictures_a_second_; }

 private:
  double pictures_a_second_;
  Tracker tracker_;
  std::vector<Rod> rods_;
  SyntheticRenderer renderer_;
  SyntheticFrame frame_;
  std::vector<std::uint8_t> rgb_;
  std::vector<int> cells_visible_;
  FrameRecord record_;
  int taken_ = 0;
};

}  // namespace onestroke::accuracy

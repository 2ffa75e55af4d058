#include "stereo_set.h"

#include "camera/synthetic_renderer.h"
#include "synthetic_set.h"
#include "tracking/stereo_fusion.h"
#include "tracking/tracker.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <numbers>
#include <random>

namespace onestroke::accuracy {
namespace {

constexpr int width = 960, height = 720;
constexpr double degree = std::numbers::pi / 180;
const Pose T_left_right{exp_so3({0.01, -0.03, 0.005}), {64, 1, -2}};
// Middle of an angle with arms of 72 mm, marker frame; the first arm lies along -y.
constexpr Vec3 middle{24, -24, 0}, first_arm{0, -1, 0}, first_arm_middle{0, -36, 0};

Quat random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalized(Quat{normal(random), normal(random), normal(random), normal(random)});
}

/// The shortest turn that takes one unit vector to another.
Quat turn_between(Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  return normalized(Quat{1 + dot(from, to), axis.x, axis.y, axis.z});
}

Pose pose_of(StereoScene scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> far(300, 600), side(-1, 1);
  const double distance = far(random);
  const Vec3 place{0.15 * distance * side(random), 0.12 * distance * side(random), distance};
  Quat rotation = random_rotation(random);
  if (scene == StereoScene::pointing)
    rotation = turn_between(rotate(rotation, first_arm), -normalized(place)) * rotation;
  return {rotation, place - rotate(rotation, middle)};
}

/// A finger across the first arm, seen from the left camera, half way to it.
SyntheticFinger covering(const Pose& T_left_marker, std::mt19937_64& random) {
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  const double angle = turn(random);
  const Vec3 along{std::cos(angle), std::sin(angle), 0};
  SyntheticFinger finger;
  finger.length = 60;
  finger.radius = 14;
  const Quat rotation = turn_between({0, 1, 0}, along);
  const Vec3 at = 0.5 * (T_left_marker * first_arm_middle);
  finger.T_camera_finger = Pose{rotation, at - 0.5 * finger.length * along};
  return finger;
}

class Eye {
 public:
  explicit Eye(const Room& room) {
    frame_.width = width;
    frame_.height = height;
    frame_.intrinsics = Intrinsics::from_fov(width, height, 50 * degree);
    frame_.effects.noise = 2;
    frame_.effects.blur = 0.5;
    frame_.room = &room;
    rgb_.resize(std::size_t{3} * width * height);
  }

  /// All in the left camera's frame.
  void draw(const Pose& T_left_this, const Rod& rod, const Pose& marker, const SyntheticFinger* finger,
            std::uint64_t seed) {
    const Pose T_this_left = inverse(T_left_this);
    frame_.T_world_camera = T_left_this;
    frame_.markers.assign(1, {&rod, T_this_left * marker});
    frame_.fingers.clear();
    if (finger) {
      frame_.fingers.push_back(*finger);
      frame_.fingers[0].T_camera_finger = T_this_left * finger->T_camera_finger.middle();
    }
    frame_.noise_seed = seed;
    renderer_.render(frame_, rgb_.data(), std::size_t{3} * width);
    picture.width = width;
    picture.height = height;
    picture.planes[0] = rgb_.data();
    picture.strides[0] = std::size_t{3} * width;
    picture.intrinsics = frame_.intrinsics;
    picture.T_world_camera = T_left_this;
  }

  Picture picture;

 private:
  SyntheticRenderer renderer_;
  SyntheticFrame frame_;
  std::vector<std::uint8_t> rgb_;
};

double nees_of(const MarkerObservation& o, const Pose& truth) {
  const Vec3 w = log_so3(truth.rotation * o.T_camera_marker.rotation.conjugate());
  const Vec3 v = truth.translation - o.T_camera_marker.translation;
  const Eigen::Matrix<double, 6, 1> error{w.x, w.y, w.z, v.x, v.y, v.z};
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(o.covariance.data());
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace

void draw_pairs(StereoScene scene, int orientations, const VisitPair& visit) {
  const Catalog catalog = synthetic_catalog();
  const Room room(900, 7, {.half_turn = 0.7, .half_height = 0.6});
  Eye left(room), right(room);
  std::mt19937_64 random(2025);
  for (int i = 0; i < orientations; ++i) {
    const MarkerSpec& spec = catalog.markers[static_cast<std::size_t>(i) % catalog.markers.size()];
    const Rod rod(spec);
    const Pose pose = pose_of(scene, random);
    const SyntheticFinger finger = covering(pose, random);
    const SyntheticFinger* const shown = scene == StereoScene::covered ? &finger : nullptr;
    const auto seed = static_cast<std::uint64_t>(2 * i);
    left.draw({}, rod, pose, shown, seed);
    right.draw(T_left_right, rod, pose, shown, seed + 1);
    left.picture.second = &right.picture;
    visit(left.picture, spec.id, pose);
  }
}

void StereoScore::add(const FrameRecord& record, int id, const Pose& truth) {
  ++pictures;
  for (const MarkerObservation& o : record.seen()) {
    const double turn = angle_between(o.T_camera_marker.rotation, truth.rotation) / degree;
    const double off = norm(o.T_camera_marker * middle - truth * middle);
    if (o.id != id || turn > 10 || off > 0.05 * norm(truth * middle)) {
      ++wrong;
      continue;
    }
    ++measured;
    rotation_deg.push_back(turn);
    position_mm.push_back(off);
    nees.push_back(nees_of(o, truth));
  }
}

StereoScores measure_pairs(StereoScene scene, int orientations) {
  const Catalog catalog = synthetic_catalog();
  Tracker tracker(catalog, {.independent = true});
  const auto left = std::make_unique<FrameRecord>(), right = std::make_unique<FrameRecord>();
  StereoScores scores;
  draw_pairs(scene, orientations, [&](const Picture& pair, int id, const Pose& truth) {
    tracker.process(pair, *left);
    tracker.process(*pair.second, *right);
    scores.left.add(*left, id, truth);
    scores.right.add(*right, id, inverse(pair.second->T_world_camera) * truth);
    fuse_second(*right, *left);
    scores.both.add(*left, id, truth);
  });
  return scores;
}

}  // namespace onestroke::accuracy

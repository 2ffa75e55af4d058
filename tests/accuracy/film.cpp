#include "film.h"

#include "synthetic_set.h"

#include <numbers>

namespace onestroke::accuracy {
namespace {

constexpr int width = 1600, height = 1200, stride = 3 * width;
constexpr double degree = std::numbers::pi / 180;

}  // namespace

Pose about_middle(Quat rotation, Vec3 place) {
  constexpr Vec3 middle{24, -24, 0};
  return {rotation, place - rotate(rotation, middle)};
}

double turn_deg(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation) / degree;
}

Film::Film(double pictures_a_second, const TrackerOptions& options)
    : pictures_a_second_(pictures_a_second), tracker_(synthetic_catalog(), options), rgb_(stride * height) {
  for (const MarkerSpec& marker : tracker_.catalog().markers) rods_.emplace_back(marker);
  frame_.width = width;
  frame_.height = height;
  frame_.intrinsics = Intrinsics::from_fov(width, height, 35 * degree);
  frame_.effects.noise = 2;
  frame_.effects.blur = 0.5;
}

const FrameRecord& Film::take(const Scene& scene) {
  const Pose T_camera_world = inverse(scene.T_world_camera);
  frame_.T_world_camera = scene.T_world_camera;
  frame_.markers.clear();
  frame_.fingers.clear();
  for (const Scene::Stick& s : scene.sticks)
    frame_.markers.push_back({&rods_[static_cast<std::size_t>(s.id - 1)], T_camera_world * s.T_world_marker});
  for (const Scene::Finger& f : scene.fingers)
    frame_.fingers.push_back({T_camera_world * f.T_world_finger, f.length, f.radius});
  ++frame_.noise_seed;
  cells_visible_.assign(scene.sticks.size(), 0);
  renderer_.render(frame_, rgb_.data(), stride, cells_visible_);

  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.planes[0] = rgb_.data();
  picture.strides[0] = stride;
  picture.intrinsics = frame_.intrinsics;
  picture.exposure.start = Time{} + Duration::from_seconds(time());
  picture.T_world_camera = scene.T_world_camera_told;
  ++taken_;
  tracker_.process(picture, record_);
  return record_;
}

const FrameRecord& Film::take(int id, const Pose& T_camera_marker) {
  return take({.sticks = {{id, T_camera_marker}}, .fingers = {}, .T_world_camera = {}, .T_world_camera_told = {}});
}

const MarkerObservation* Film::find(int id) const {
  for (const MarkerObservation& o : record_.seen())
    if (o.id == id) return &o;
  return nullptr;
}

}  // namespace onestroke::accuracy

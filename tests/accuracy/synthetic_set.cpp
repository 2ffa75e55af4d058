#include "synthetic_set.h"

#include "camera/sensor.h"
#include "camera/synthetic_renderer.h"

#include <cmath>
#include <numbers>
#include <random>

namespace onestroke::accuracy {
namespace {

constexpr int width = 1600, height = 1200;
constexpr double degree = std::numbers::pi / 180;
constexpr int steps_round = 24;
constexpr int random_pictures = 80;

MarkerSpec marker(int id) {
  const std::uint64_t value = scramble(static_cast<std::uint64_t>(id)) & ((1ULL << 34) - 1);
  return {id, "m" + std::to_string(id), encode(value, 36), Shape::angle(36, 4, 3, id % 2 ? 0 : 8), ""};
}

// Turned about the middle of the marker's extent, which then lies at `place`.
Pose pose_at(Quat rotation, Vec3 place) {
  constexpr Vec3 turning_point{36, -36, 0};
  return {rotation, place - rotate(rotation, turning_point)};
}

class Stage {
 public:
  explicit Stage(const Visit& visit) : visit_(visit), rgb_(3 * width * height) {
    frame_.width = width;
    frame_.height = height;
    frame_.intrinsics = Intrinsics::from_fov(width, height, 35 * degree);
    frame_.effects.noise = 2;
    frame_.effects.blur = 0.5;
  }

  void stand_in(const Room& room) { frame_.room = &room; }

  void show(const std::string& name, int id, const Pose& pose) {
    const Rod rod(marker(id));
    frame_.markers.assign(1, {&rod, pose});
    ++frame_.noise_seed;
    int cells_visible = 0;
    renderer_.render(frame_, rgb_.data(), 3 * width, {&cells_visible, 1});
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.planes[0] = rgb_.data();
    picture.strides[0] = 3 * width;
    picture.intrinsics = frame_.intrinsics;
    const Truth truth{id, pose, cells_visible};
    visit_(name, picture, {&truth, 1});
  }

 private:
  const Visit& visit_;
  SyntheticRenderer renderer_;
  SyntheticFrame frame_;
  std::vector<std::uint8_t> rgb_;
};

void turn_about(Vec3 axis, const std::string& group, Stage& stage) {
  for (const int id : {3, 4}) {
    for (int i = 0; i < steps_round; ++i) {
      const double angle = 360.0 / steps_round * i;
      // Each distance meets angles of every quarter.
      const double distance = 300 + 100 * ((2 * i + id) % 5);
      const std::string name = group + " " + std::to_string(static_cast<int>(angle)) + " degrees at " +
                               std::to_string(static_cast<int>(distance)) + " mm";
      stage.show(name, id, pose_at(exp_so3(angle * degree * axis), {0, 0, distance}));
    }
  }
}

Quat random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return normalized(Quat{normal(random), normal(random), normal(random), normal(random)});
}

void any_orientation(const std::string& group, Stage& stage) {
  // A little more than the field of view.
  const Room room(1300, 7, {.half_turn = 0.34, .half_height = 0.26});
  stage.stand_in(room);
  std::mt19937_64 random(2024);
  std::uniform_real_distribution<double> far(300, 700), side(-1, 1);
  for (int i = 0; i < random_pictures; ++i) {
    const double distance = far(random);
    const Vec3 place{0.12 * distance * side(random), 0.08 * distance * side(random), distance};
    stage.show(group + " " + std::to_string(i), 1 + i % 16, pose_at(random_rotation(random), place));
  }
}

}  // namespace

Catalog synthetic_catalog() {
  Catalog catalog;
  for (int id = 1; id <= 16; ++id) catalog.markers.push_back(marker(id));
  return catalog;
}

std::vector<std::string> synthetic_groups() {
  return {"turn about x", "turn about y", "turn about z", "any orientation"};
}

void draw_synthetic(const std::string& group, const Visit& visit) {
  Stage stage(visit);
  if (group == "any orientation") {
    any_orientation(group, stage);
  } else {
    const char axis = group.back();
    turn_about({axis == 'x' ? 1.0 : 0.0, axis == 'y' ? 1.0 : 0.0, axis == 'z' ? 1.0 : 0.0}, group, stage);
  }
}

}  // namespace onestroke::accuracy

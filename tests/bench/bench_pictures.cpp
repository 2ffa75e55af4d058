#include "bench_pictures.h"

#include "camera/sensor.h"
#include "camera/synthetic_renderer.h"
#include "confetti.h"

#include <opencv2/aruco.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace onestroke::bench {
namespace {

constexpr int pictures_round = 16;

MarkerSpec marker(int id) {
  const std::uint64_t value = scramble(static_cast<std::uint64_t>(id)) & ((1ULL << 34) - 1);
  return {id, "m" + std::to_string(id), encode(value, 36), Shape::angle(36, 4, 3, 0), ""};
}

// A swing of some 11 degrees and 15 mm about a place before the camera.
Pose swinging(Quat rotation, Vec3 place, double phase, double reach_mm = 15) {
  const Quat turned = exp_so3(0.2 * std::sin(phase) * normalized(Vec3{1, 2, 2})) * rotation;
  const Vec3 shift = reach_mm / 15 * Vec3{15 * std::cos(phase), 8 * std::sin(phase), 0};
  return {turned, place + shift - rotate(turned, {36, -36, 0})};
}

// One of sixteen places before the camera.
Pose in_grid(int i, double phase) {
  constexpr double distance = 750, across = 112, down = 84;
  const Vec3 place{across * (i % 4 - 1.5), down * (i / 4 - 1.5), distance};
  const Quat rotation = exp_so3({0.35, i % 2 ? 0.3 : -0.3, 0.4 * (i % 5) - 0.8});
  return swinging(rotation, place, phase + i, 5);
}

// Neighbours in the order of their coming stand apart.
constexpr std::array<int, 16> places{5, 10, 3, 12, 0, 15, 6, 9, 1, 14, 7, 8, 2, 13, 4, 11};

}  // namespace

Catalog bench_catalog() {
  Catalog catalog;
  for (int id = 1; id <= 16; ++id) catalog.markers.push_back(marker(id));
  return catalog;
}

BenchPictures::BenchPictures(const Scene& scene)
    : scene_(scene),
      intrinsics_(Intrinsics::from_fov(scene.width, scene.height, scene.fov_deg * std::numbers::pi / 180)) {
  draw();
  if (scene.tags)
    for (std::vector<std::uint8_t>& rgb : rgb_) paste_tags(rgb);
  const std::vector<std::uint8_t>& first = rgb_.front();
  for (std::size_t i = 0; i < first.size(); i += 3)
    gray_.push_back(static_cast<std::uint8_t>((first[i] + 2 * first[i + 1] + first[i + 2]) / 4));
}

void BenchPictures::draw() {
  std::vector<Rod> rods;
  for (const int id : {3, 9, 1, 2, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15, 16}) rods.emplace_back(marker(id));
  const double fov = scene_.fov_deg * std::numbers::pi / 180;
  std::optional<Room> room;
  if (scene_.background == Scene::Background::room)
    room.emplace(std::min(intrinsics_.fx, 1000.0), 5,
                 Room::Extent{.half_turn = fov / 2 + 0.02, .half_height = 0.8 * fov});
  SyntheticFrame frame;
  frame.width = scene_.width;
  frame.height = scene_.height;
  frame.intrinsics = intrinsics_;
  frame.effects.noise = 2;
  frame.effects.blur = 0.5;
  frame.room = room ? &*room : nullptr;
  SyntheticRenderer renderer;
  const std::size_t stride = 3 * static_cast<std::size_t>(scene_.width),
                    size = stride * static_cast<std::size_t>(scene_.height);
  std::vector<std::uint8_t> empty(size);
  renderer.render(frame, empty.data(), stride);
  for (int i = 0; i < pictures_round; ++i) {
    const double phase = 2 * std::numbers::pi * i / pictures_round;
    frame.markers.clear();
    if (scene_.markers == 2 && !scene_.grid) {
      frame.markers.push_back({&rods[0], swinging(exp_so3({0.4, -0.3, 0.3}), {-60, 0, 450}, phase)});
      frame.markers.push_back({&rods[1], swinging(exp_so3({-0.3, 0.4, -2.0}), {60, 0, 430}, phase + 1)});
    } else {
      for (std::size_t m = 0; m < static_cast<std::size_t>(scene_.markers); ++m)
        frame.markers.push_back({&rods[m], in_grid(places[m], phase)});
    }
    frame.noise_seed = static_cast<std::uint64_t>(i + 1);
    std::vector<std::uint8_t>& rgb = rgb_.emplace_back(size);
    renderer.render(frame, rgb.data(), stride);
    if (scene_.background == Scene::Background::confetti) scatter_confetti(rgb, empty, scene_.width, scene_.height);
  }
}

void BenchPictures::paste_tags(std::vector<std::uint8_t>& rgb) const {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Mat3b picture(scene_.height, scene_.width, reinterpret_cast<cv::Vec3b*>(rgb.data()));
  const int side = scene_.height / 8, border = side / 3, whole = side + 2 * border;
  for (const auto& [id, x, y] : {std::tuple{7, 0, 0}, {42, scene_.width - whole, scene_.height - whole}}) {
    cv::Mat tag;
    dictionary->drawMarker(id, side, tag, 1);
    picture(cv::Rect(x, y, whole, whole)).setTo(cv::Vec3b(235, 235, 235));
    for (int v = 0; v < side; ++v)
      for (int u = 0; u < side; ++u) {
        const std::uint8_t level = tag.at<std::uint8_t>(v, u) ? 235 : 25;
        picture(y + border + v, x + border + u) = {level, level, level};
      }
  }
}

Picture BenchPictures::picture(std::uint64_t number) const {
  Picture p;
  p.width = scene_.width;
  p.height = scene_.height;
  p.planes[0] = rgb_[number % rgb_.size()].data();
  p.strides[0] = 3 * static_cast<std::size_t>(scene_.width);
  p.sequence = number;
  p.exposure.start = Time{} + Duration::from_seconds(static_cast<double>(number) / 30);
  p.intrinsics = intrinsics_;
  return p;
}

}  // namespace onestroke::bench

#include "bench_pictures.h"

#include "camera/sensor.h"
#include "camera/synthetic_renderer.h"

#include <opencv2/aruco.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke::bench {
namespace {

constexpr int pictures_round = 16;

MarkerSpec marker(int id) {
  const std::uint64_t value = scramble(static_cast<std::uint64_t>(id)) & ((1ULL << 34) - 1);
  return {id, "m" + std::to_string(id), encode(value, 36), Shape::angle(36, 4, 3, 0), ""};
}

// A swing of some 11 degrees and 15 mm about a place before the camera.
Pose swinging(Quat rotation, Vec3 place, double phase) {
  const Quat turned = exp_so3(0.2 * std::sin(phase) * normalized(Vec3{1, 2, 2})) * rotation;
  return {turned, place + Vec3{15 * std::cos(phase), 8 * std::sin(phase), 0} - rotate(turned, {36, -36, 0})};
}

}  // namespace

Catalog bench_catalog() {
  Catalog catalog;
  for (int id = 1; id <= 16; ++id) catalog.markers.push_back(marker(id));
  return catalog;
}

BenchPictures::BenchPictures(int width, int height, double fov)
    : width_(width), height_(height), intrinsics_(Intrinsics::from_fov(width, height, fov)) {
  draw(fov);
  for (std::vector<std::uint8_t>& rgb : rgb_) paste_tags(rgb);
  const std::vector<std::uint8_t>& first = rgb_.front();
  for (std::size_t i = 0; i < first.size(); i += 3)
    gray_.push_back(static_cast<std::uint8_t>((first[i] + 2 * first[i + 1] + first[i + 2]) / 4));
}

void BenchPictures::draw(double fov) {
  const Rod left(marker(3)), right(marker(9));
  const Room room(std::min(intrinsics_.fx, 1000.0), 5, {.half_turn = fov / 2 + 0.02, .half_height = 0.8 * fov});
  SyntheticFrame frame;
  frame.width = width_;
  frame.height = height_;
  frame.intrinsics = intrinsics_;
  frame.effects.noise = 2;
  frame.effects.blur = 0.5;
  frame.room = &room;
  SyntheticRenderer renderer;
  for (int i = 0; i < pictures_round; ++i) {
    const double phase = 2 * std::numbers::pi * i / pictures_round;
    frame.markers.assign(1, {&left, swinging(exp_so3({0.4, -0.3, 0.3}), {-60, 0, 450}, phase)});
    frame.markers.push_back({&right, swinging(exp_so3({-0.3, 0.4, -2.0}), {60, 0, 430}, phase + 1)});
    frame.noise_seed = static_cast<std::uint64_t>(i + 1);
    rgb_.emplace_back(3 * static_cast<std::size_t>(width_ * height_));
    renderer.render(frame, rgb_.back().data(), 3 * static_cast<std::size_t>(width_));
  }
}

void BenchPictures::paste_tags(std::vector<std::uint8_t>& rgb) const {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Mat3b picture(height_, width_, reinterpret_cast<cv::Vec3b*>(rgb.data()));
  const int side = height_ / 8, border = side / 3, whole = side + 2 * border;
  for (const auto& [id, x, y] : {std::tuple{7, 0, 0}, {42, width_ - whole, height_ - whole}}) {
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
  p.width = width_;
  p.height = height_;
  p.planes[0] = rgb_[number % rgb_.size()].data();
  p.strides[0] = 3 * static_cast<std::size_t>(width_);
  p.sequence = number;
  p.exposure.start = Time{} + Duration::from_seconds(static_cast<double>(number) / 30);
  p.intrinsics = intrinsics_;
  return p;
}

}  // namespace onestroke::bench

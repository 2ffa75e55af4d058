#include "camera/room.h"

#include "camera/room_scene.h"
#include "camera/softening.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace onestroke {
namespace {

constexpr float unit = 8192;

using Four = float __attribute__((vector_size(16)));
using FourShort = std::uint16_t __attribute__((vector_size(8)));

Four texel(const std::uint16_t* p) {
  FourShort s;
  std::memcpy(&s, p, sizeof s);
  return __builtin_convertvector(s, Four);
}

}  // namespace

Room::Room(double focal_px, std::uint64_t seed, const Extent& extent)
    : extent_(extent),
      width_(std::max(2, static_cast<int>(2 * extent.half_turn * focal_px))),
      height_(std::max(2, static_cast<int>(2 * extent.half_height * focal_px))),
      scale_(static_cast<float>(focal_px)) {
  const RoomScene scene(seed);
  const std::size_t width = static_cast<std::size_t>(width_);
  std::vector<float> light(4 * width * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    float* row = light.data() + 4 * width * static_cast<std::size_t>(y);
    const double down = (y + 0.5) / focal_px - extent.half_height;
    for (int x = 0; x < width_; ++x) {
      const double turn = (x + 0.5) / focal_px - extent.half_turn;
      const RoomScene::Sight sight = scene.look({std::sin(turn), down, std::cos(turn)});
      row[4 * x] = sight.light.r;
      row[4 * x + 1] = sight.light.g;
      row[4 * x + 2] = sight.light.b;
      row[4 * x + 3] = sight.distance;
    }
  }
  soften(light, focal_px);
}

namespace {

void blur(std::vector<float>& picture, std::vector<float>& scratch, int width, int height, double sigma) {
  Softening soft;
  soft.set(sigma);
  const std::size_t floats = 4 * static_cast<std::size_t>(width);
  const auto row = [&](std::vector<float>& p, int y) { return p.data() + static_cast<std::size_t>(y) * floats; };
  scratch.resize(picture.size());
  for (int y = 0; y < height; ++y) soft.along(row(picture, y), static_cast<std::size_t>(width), row(scratch, y));
  for (int y = 0; y < height; ++y) soft.across(picture.data(), floats, height, y, row(scratch, y));
  picture.swap(scratch);
}

}  // namespace

/// The camera is focused on the hands: what lies behind them blurs, the farther the more. Near things keep a little
/// blur, because one ray a texel leaves jagged edges.
void Room::soften(std::vector<float>& light, double focal_px) {
  constexpr double hands = 450, far = 2400, aperture = 2.4;  // mm
  const double far_blur = focal_px * aperture * (1 / hands - 1 / far) / 2;
  std::vector<float> scratch;
  blur(light, scratch, width_, height_, 0.9);
  std::vector<float> blurred(light);
  blur(blurred, scratch, width_, height_, std::max(0.5, far_blur));
  texels_.resize(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double distance = static_cast<double>(blurred[i / 4 * 4 + 3]);
    const float u = static_cast<float>(std::clamp((1 / hands - 1 / distance) / (1 / hands - 1 / far), 0.0, 1.0));
    const float v = light[i] + u * (blurred[i] - light[i]);
    texels_[i] = static_cast<std::uint16_t>(std::clamp(v * unit + 0.5f, 0.0f, 65535.0f));
  }
}

Room::Place Room::place(Vec3 d) const {
  const double flat = std::hypot(d.x, d.z);
  return {static_cast<float>((std::atan2(d.x, d.z) + extent_.half_turn) * static_cast<double>(scale_)) - 0.5f,
          static_cast<float>((std::clamp(d.y / std::max(flat, 1e-9), -10.0, 10.0) + extent_.half_height) *
                             static_cast<double>(scale_)) -
              0.5f};
}

void Room::draw(Place a, Place b, std::size_t n, float* out) const {
  const float right = static_cast<float>(width_) - 1.001f, bottom = static_cast<float>(height_) - 1.001f;
  const float step = 1.0f / static_cast<float>(n);
  const float dx = step * (b.x - a.x), dy = step * (b.y - a.y);
  const std::size_t below = 4 * static_cast<std::size_t>(width_);
  for (std::size_t i = 0; i < n; ++i) {
    const float k = static_cast<float>(i);
    const float x = std::clamp(a.x + k * dx, 0.0f, right), y = std::clamp(a.y + k * dy, 0.0f, bottom);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    const std::uint16_t* p =
        texels_.data() + static_cast<std::size_t>(row) * below + 4 * static_cast<std::size_t>(column);
    const Four top = texel(p) + u * (texel(p + 4) - texel(p));
    const Four low = texel(p + below) + u * (texel(p + below + 4) - texel(p + below));
    const Four value = (top + v * (low - top)) * (1.0f / unit);
    std::memcpy(out + 4 * i, &value, sizeof value);
  }
}

}  // namespace onestroke

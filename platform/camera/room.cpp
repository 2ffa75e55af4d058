#include "camera/room.h"

#include "camera/room_scene.h"
#include "camera/softening.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace onestroke {
namespace {

constexpr double half_turn = 1.40;    // rad to either side of straight ahead
constexpr double half_height = 1.15;  // tangent of the highest elevation
constexpr float unit = 8192;

using Four = float __attribute__((vector_size(16)));
using FourShort = std::uint16_t __attribute__((vector_size(8)));

Four texel(const std::uint16_t* p) {
  FourShort s;
  std::memcpy(&s, p, sizeof s);
  return __builtin_convertvector(s, Four);
}

}  // namespace

Room::Room(double focal_px, std::uint64_t seed)
    : width_(static_cast<int>(2 * half_turn * focal_px)),
      height_(static_cast<int>(2 * half_height * focal_px)),
      scale_(static_cast<float>(focal_px)) {
  const RoomScene scene(seed);
  const std::size_t width = static_cast<std::size_t>(width_);
  std::vector<float> light(4 * width * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    float* row = light.data() + 4 * width * static_cast<std::size_t>(y);
    for (int x = 0; x < width_; ++x) {
      const double turn = (x + 0.5) / focal_px - half_turn;
      const RoomScene::Sight sight = scene.look({std::sin(turn), (y + 0.5) / focal_px - half_height, std::cos(turn)});
      row[4 * x] = sight.light.r;
      row[4 * x + 1] = sight.light.g;
      row[4 * x + 2] = sight.light.b;
      row[4 * x + 3] = sight.distance;
    }
  }
  soften(light, focal_px);
}

/// The camera is focused on the hands: what lies behind them blurs, the farther the more.
void Room::soften(const std::vector<float>& light, double focal_px) {
  constexpr double hands = 450, aperture = 2.6;  // mm
  constexpr float far = 2400;
  const double most = focal_px * aperture * (1 / hands - 1 / static_cast<double>(far));
  Softening soft;
  soft.set(std::max(0.5, 0.5 * most));
  std::vector<float> blurred(light.size());
  const std::size_t floats = 4 * static_cast<std::size_t>(width_);
  std::vector<float> across(light), scratch(floats);
  for (int y = 0; y < height_; ++y) {
    soft.along(across.data() + static_cast<std::size_t>(y) * floats, static_cast<std::size_t>(width_), scratch.data());
  }
  texels_.resize(light.size());
  for (int y = 0; y < height_; ++y) {
    soft.across(across.data(), floats, height_, y, scratch.data());
    const std::size_t start = static_cast<std::size_t>(y) * floats;
    for (std::size_t i = 0; i < floats; ++i) {
      const float distance = scratch[i / 4 * 4 + 3];
      const float u = std::clamp(static_cast<float>((1 / hands - 1 / static_cast<double>(distance)) /
                                                    (1 / hands - 1 / static_cast<double>(far))),
                                 0.0f, 1.0f);
      const float v = light[start + i] + u * (scratch[i] - light[start + i]);
      texels_[start + i] = static_cast<std::uint16_t>(std::clamp(v * unit + 0.5f, 0.0f, 65535.0f));
    }
  }
}

Room::Place Room::place(Vec3 d) const {
  const double flat = std::hypot(d.x, d.z);
  return {static_cast<float>((std::atan2(d.x, d.z) + half_turn) * static_cast<double>(scale_)) - 0.5f,
          static_cast<float>((std::clamp(d.y / std::max(flat, 1e-9), -10.0, 10.0) + half_height) *
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

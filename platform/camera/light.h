#pragma once

#include "core/pose.h"

#include <array>

namespace onestroke {

/// Linear light, 1 = white paper in the key light; red, green, blue of sRGB's primaries.
struct Linear {
  float r = 0, g = 0, b = 0;

  friend constexpr Linear operator+(Linear a, Linear b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
  friend constexpr Linear operator*(float k, Linear a) { return {k * a.r, k * a.g, k * a.b}; }
  friend constexpr Linear operator*(Linear a, Linear b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
};

constexpr Linear mix(Linear a, Linear b, float u) {
  return (1 - u) * a + u * b;
}

/// The room's light: a window behind the wearer's left shoulder, a bright ceiling, a warm desk below.
namespace room_light {
inline constexpr Vec3 to_window{-0.58, -0.52, -0.63};  ///< World, unit; x right, y down, z ahead of the head at rest.
inline constexpr Vec3 up{0, -1, 0};
inline constexpr Vec3 to_wearer{0, 0, -1};
}  // namespace room_light

/// The light's directions in an object's frame, unit.
struct LightFrame {
  Vec3 window, up, wearer;

  /// R_object_world turns world directions into the object's frame.
  static LightFrame in(const Mat3& R_object_world);
};

/// A surface as light meets it.
struct Material {
  Linear albedo;
  float gloss = 0;  ///< Strength of the soft highlight.
  float wrap = 0;   ///< How far light creeps round the edge of shadow (0 paper, 0.4 skin).
};

/// Light that leaves a surface towards the eye; n and to_eye are unit vectors, occlusion is the open share in [0, 1].
Linear shade(const Material& material, const LightFrame& light, Vec3 n, Vec3 to_eye, float open);

/// Colour of a thermal light of that temperature through a camera balanced for 6500 K, green kept at 1.
Linear white_of(double kelvin);

}  // namespace onestroke

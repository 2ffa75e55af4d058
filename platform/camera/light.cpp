#include "camera/light.h"

#include "camera/matrix.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

/// CIE 1931 chromaticity of a black body (the cubic fit of Kim and others, 1667 to 25000 K), as XYZ with Y = 1.
std::array<double, 3> black_body(double kelvin) {
  const double u = 1e3 / kelvin;
  const double x = kelvin < 4000 ? ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910
                                 : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
  double y = 0;
  if (kelvin < 2222) {
    y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
  } else if (kelvin < 4000) {
    y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
  } else {
    y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  }
  return {x / y, 1.0, (1 - x - y) / y};
}

Linear to_rgb(const std::array<double, 3>& c) {
  return {static_cast<float>(3.2406 * c[0] - 1.5372 * c[1] - 0.4986 * c[2]),
          static_cast<float>(-0.9689 * c[0] + 1.8758 * c[1] + 0.0415 * c[2]),
          static_cast<float>(0.0557 * c[0] - 0.2040 * c[1] + 1.0570 * c[2])};
}

}  // namespace

LightFrame LightFrame::in(const Mat3& R_object_world) {
  return {normalized(apply(R_object_world, room_light::to_window)), apply(R_object_world, room_light::up),
          apply(R_object_world, room_light::to_wearer)};
}

Linear shade(const Material& material, const LightFrame& light, Vec3 n, Vec3 to_eye, float open) {
  constexpr Linear key{0.80f, 0.80f, 0.78f}, ceiling{0.36f, 0.38f, 0.41f}, desk{0.17f, 0.14f, 0.11f},
      front{0.14f, 0.14f, 0.14f};
  const auto facing = [&](Vec3 l) { return static_cast<float>(dot(n, l)); };
  // A window is wide: even paper sees a part of it where its middle has just set.
  const float wrap = 0.15f + material.wrap;
  const float direct = std::max(0.0f, (facing(light.window) + wrap) / (1 + wrap));
  const Linear around =
      mix(desk, ceiling, 0.5f + 0.5f * facing(light.up)) + std::max(0.0f, facing(light.wearer)) * front;
  Linear out = material.albedo * ((direct * (0.35f + 0.65f * open)) * key + open * around);

  const Vec3 half = light.window + to_eye;
  const double peak = std::max(0.0, dot(n, half)) / std::max(1e-6, norm(half));
  const double p4 = peak * peak * peak * peak, p16 = p4 * p4 * p4 * p4;
  return out + (material.gloss * open * static_cast<float>(p16 * p4)) * key;
}

Linear white_of(double kelvin) {
  const Linear light = to_rgb(black_body(kelvin)), reference = to_rgb(black_body(6500));
  const float r = light.r / reference.r, g = light.g / reference.g, b = light.b / reference.b;
  return {r / g, 1.0f, std::max(0.02f, b / g)};
}

}  // namespace onestroke

#include "camera/finger.h"

#include <algorithm>
#include <cmath>

namespace onestroke::finger {
namespace {

Vec3 nearest_on_axis(double length, Vec3 point) {
  return {0, std::clamp(point.y, 0.0, length), 0};
}

double crease(double y, double at, double width) {
  const double u = (y - at) / width;
  return std::exp(-u * u);
}

constexpr double wrist = 62;  // mm down a palm, where the sleeve begins

Material cloth(Vec3 point) {
  const double knit = std::sin(2.2 * point.x) * std::sin(1.7 * point.y) + 0.6 * std::sin(0.11 * point.y * point.x);
  const double cuff = point.y < wrist + 2 ? 0.6 : 1.0;
  return {static_cast<float>(cuff * (1 + 0.10 * knit)) * Linear{0.115f, 0.125f, 0.150f}, 0.01f, 0.2f};
}

}  // namespace

double cast(double length, double radius, Vec3 eye, Vec3 direction) {
  const double a = direction.x * direction.x + direction.z * direction.z;
  const double b = eye.x * direction.x + eye.z * direction.z;
  const double c = eye.x * eye.x + eye.z * eye.z - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return 0;
  const double t = a > 1e-12 ? (-b - std::sqrt(discriminant)) / a : 0;
  const double y = a > 1e-12 ? eye.y + t * direction.y : (direction.y < 0 ? 2 * length : -length);
  if (y >= 0 && y <= length) return std::max(t, 0.0);
  const Vec3 from_end = eye - Vec3{0, y < 0 ? 0.0 : length, 0};
  const double dd = dot(direction, direction), db = dot(from_end, direction);
  const double h = db * db - dd * (dot(from_end, from_end) - radius * radius);
  return h < 0 ? 0 : std::max((-db - std::sqrt(h)) / dd, 0.0);
}

Vec3 normal(double length, double radius, bool jointed, Vec3 point) {
  const Vec3 n = (point - nearest_on_axis(length, point)) / radius;
  if (!jointed) return n;
  // Skin folds: the surface dips at the two joints and is nowhere quite even.
  const double joint = 2.4 * radius, knuckle = 5.2 * radius;
  const double dip = 0.35 * ((point.y - joint) / 1.2 * crease(point.y, joint, 1.2) +
                             (point.y - knuckle) / 1.5 * crease(point.y, knuckle, 1.5));
  const double uneven = 0.025 * std::sin(1.9 * point.y + 2.2 * std::sin(0.8 * point.x) + 0.9 * point.z);
  return normalized(n + Vec3{0, uneven - dip, 0});
}

Material material(double radius, bool jointed, Vec3 point) {
  if (!jointed && point.y > wrist) return cloth(point);
  const double x = point.x / (0.62 * radius), y = (point.y + 0.15 * radius) / (0.85 * radius);
  const double nail = jointed && point.z < 0 ? x * x + y * y : 2;
  if (nail < 1) {
    const float tip = static_cast<float>(std::clamp((-point.y / radius - 0.62) * 8, 0.0, 1.0));
    const Linear plate = mix({0.66f, 0.38f, 0.31f}, {0.72f, 0.62f, 0.54f}, tip);
    return {static_cast<float>(nail > 0.86 ? 0.78 : 1.0) * plate, 0.16f, 0.2f};
  }
  const double folds = !jointed
                           ? 0
                           : crease(point.y, 2.4 * radius, 0.5) + 0.6 * crease(point.y, 2.4 * radius + 1.8, 0.4) +
                                 crease(point.y, 5.2 * radius, 0.6) + 0.5 * crease(point.y, 5.2 * radius - 2.2, 0.5);
  const double mottle = std::sin(0.45 * point.x + 0.21 * point.y) * std::sin(0.33 * point.y - 0.5 * point.z + 1);
  const double redness = std::clamp(1 - std::abs(point.y) / (2 * radius), 0.0, 1.0) + 0.35 * mottle;
  const Linear skin = mix({0.56f, 0.315f, 0.215f}, {0.60f, 0.285f, 0.21f}, static_cast<float>(0.5 + 0.5 * redness));
  const float dark = static_cast<float>(1 - 0.22 * std::min(1.0, folds));
  return {dark * skin, 0.05f, 0.35f};
}

double gap(double length, double radius, Vec3 point) {
  return norm(point - nearest_on_axis(length, point)) - radius;
}

}  // namespace onestroke::finger

#include "core/pose.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

double norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}

Vec3 normalized(Vec3 a) {
  const double n = norm(a);
  return n > 0 ? a / n : a;
}

Quat normalized(Quat q) {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return n > 0 ? Quat{q.w / n, q.x / n, q.y / n, q.z / n} : Quat{};
}

Vec3 rotate(Quat q, Vec3 v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

Mat3 to_matrix(Quat q) {
  const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// Shepperd's method: take the largest of the four components from the diagonal, the others from the off-diagonals.
Quat to_quat(const Mat3& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  const std::array<double, 4> square{trace, m[0][0], m[1][1], m[2][2]};
  const auto largest = std::max_element(square.begin(), square.end()) - square.begin();
  Quat q;
  switch (largest) {
    case 0:
      q = {1 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
      break;
    case 1:
      q = {m[2][1] - m[1][2], 1 + m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[0][2] + m[2][0]};
      break;
    case 2:
      q = {m[0][2] - m[2][0], m[0][1] + m[1][0], 1 + m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]};
      break;
    default:
      q = {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], 1 + m[2][2] - m[0][0] - m[1][1]};
  }
  return normalized(q);
}

Quat exp_so3(Vec3 v) {
  const double angle = norm(v);
  // sin(a/2)/a by its series near zero, where the quotient loses digits.
  const double k = angle < 1e-6 ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), k * v.x, k * v.y, k * v.z};
}

Vec3 log_so3(Quat q) {
  if (q.w < 0) q = {-q.w, -q.x, -q.y, -q.z};
  const Vec3 v{q.x, q.y, q.z};
  const double s = norm(v);
  return s < 1e-9 ? 2.0 * v : (2 * std::atan2(s, q.w) / s) * v;
}

Quat from_euler_xyz(double a, double b, double c) {
  return exp_so3({0, 0, c}) * exp_so3({0, b, 0}) * exp_so3({a, 0, 0});
}

Vec3 to_euler_xyz(Quat q) {
  const Mat3 m = to_matrix(q);
  const double sb = std::clamp(-m[2][0], -1.0, 1.0);
  // At b = +-90 degrees only a -+ c is determined; c = 0 by convention.
  if (std::abs(sb) > 1 - 1e-12) return {std::atan2(-m[1][2], m[1][1]), std::asin(sb), 0};
  return {std::atan2(m[2][1], m[2][2]), std::asin(sb), std::atan2(m[1][0], m[0][0])};
}

Pose inverse(const Pose& p) {
  const Quat r = p.rotation.conjugate();
  return {r, -rotate(r, p.translation)};
}

Pose interpolate(const Pose& a, const Pose& b, double u) {
  const Vec3 turn = log_so3(b.rotation * a.rotation.conjugate());
  return {normalized(exp_so3(u * turn) * a.rotation), a.translation + u * (b.translation - a.translation)};
}

double angle_between(Quat a, Quat b) {
  return norm(log_so3(a * b.conjugate()));
}

}  // namespace onestroke

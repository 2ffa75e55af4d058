#pragma once

#include <array>

namespace onestroke {

/// A point or direction. Millimetres unless the name says otherwise.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double k) { return k * a; }
  friend constexpr Vec3 operator/(Vec3 a, double k) { return {a.x / k, a.y / k, a.z / k}; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double norm(Vec3 a);
/// a / |a|; a itself where |a| is zero.
Vec3 normalized(Vec3 a);

/// Row-major 3 x 3 matrix.
using Mat3 = std::array<std::array<double, 3>, 3>;

/// Unit quaternion, Hamilton convention, w first.
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;

  friend constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
  constexpr Quat conjugate() const { return {w, -x, -y, -z}; }
};

Quat normalized(Quat q);
Vec3 rotate(Quat q, Vec3 v);
Mat3 to_matrix(Quat q);
/// The rotation nearest to m; m must be a rotation up to rounding.
Quat to_quat(const Mat3& m);

/// Rotation vector (axis times angle, radians) to rotation, and back with the angle in [0, pi] (Rodrigues).
Quat exp_so3(Vec3 rotation_vector);
Vec3 log_so3(Quat q);

/// Rx about x, then Ry, then Rz: R = Rz(c) Ry(b) Rx(a), radians; the angles a person reads as Rotation (X, Y, Z).
Quat from_euler_xyz(double a, double b, double c);
Vec3 to_euler_xyz(Quat q);

/// A rigid transform, named T_target_source where it is used: p_target = T_target_source * p_source.
/// Translation in millimetres.
struct Pose {
  Quat rotation;
  Vec3 translation;

  Vec3 operator*(Vec3 p) const { return rotate(rotation, p) + translation; }
  friend Pose operator*(const Pose& a, const Pose& b) {
    return {normalized(a.rotation * b.rotation), a * b.translation};
  }
};

Pose inverse(const Pose& p);

/// Between a (u = 0) and b (u = 1): great-circle rotation, straight translation; u outside [0, 1] extrapolates.
Pose interpolate(const Pose& a, const Pose& b, double u);

/// Angle of the rotation between a and b, radians, [0, pi].
double angle_between(Quat a, Quat b);

/// Rates of change of T_target_source in target axes: rad/s and mm/s.
struct Velocity {
  Vec3 angular;
  Vec3 linear;
};

}  // namespace onestroke

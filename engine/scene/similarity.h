#pragma once

#include "core/pose.h"

namespace onestroke {

/// A rigid transform with a size, named as poses are: p_target = scale * R * p_source + translation.
struct Similarity {
  Quat rotation;
  Vec3 translation;
  double scale = 1;  ///< More than zero.

  Similarity() = default;
  Similarity(Quat r, Vec3 t, double s) : rotation(r), translation(t), scale(s) {}
  explicit Similarity(const Pose& rigid) : rotation(rigid.rotation), translation(rigid.translation) {}

  Vec3 operator*(Vec3 p) const { return scale * rotate(rotation, p) + translation; }
  friend Similarity operator*(const Similarity& a, const Similarity& b) {
    return {normalized(a.rotation * b.rotation), a * b.translation, a.scale * b.scale};
  }
};

inline Similarity inverse(const Similarity& s) {
  const Quat back = s.rotation.conjugate();
  return {back, rotate(back, s.translation) / -s.scale, 1 / s.scale};
}

}  // namespace onestroke

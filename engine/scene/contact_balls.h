#pragma once

#include "scene/model.h"

#include <array>
#include <vector>

namespace onestroke {

/// A ball in a model's own frame, metres.
struct ContactBall {
  std::array<float, 3> centre{};
  float radius = 0;
};

inline constexpr std::size_t most_contact_balls = 8;

/// A few balls that stand for a model where it takes light from another: centres by Lloyd's algorithm on points of its
/// surface, each as large as its points lie far from it in the mean square. Empty where the model has no triangles.
std::vector<ContactBall> contact_balls(const Model& model);

}  // namespace onestroke

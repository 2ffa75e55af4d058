#include "app/rod_mesh.h"

#include "scene/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr int sides = 24;
constexpr double arc_step = 0.15;  // radians between two rings of a bend

std::array<float, 3> to_array(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

/// Arc lengths of the rings: ends of pieces, and steps within bends.
std::vector<double> ring_places(const Shape& shape) {
  std::vector<double> places{0};
  for (const Shape::Piece& piece : shape.pieces()) {
    const int steps =
        piece.radius > 0 ? std::max(1, static_cast<int>(std::ceil(piece.length / piece.radius / arc_step))) : 1;
    for (int i = 1; i <= steps; ++i) places.push_back(piece.start + piece.length * i / steps);
  }
  return places;
}

Vec3 any_across(Vec3 along) {
  const Vec3 other = std::abs(along.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(cross(along, other));
}

/// The shortest turn that takes one direction to another carries `across` along, so that rings do not twist.
Vec3 carried(Vec3 across, Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  const double sine = norm(axis);
  if (sine < 1e-12) return across;
  return rotate(exp_so3(std::atan2(sine, dot(from, to)) / sine * axis), across);
}

class RodBuilder {
 public:
  explicit RodBuilder(const Shape& shape) : shape_(shape), along_(shape.at(0).tangent), across_(any_across(along_)) {}

  Model build() {
    const std::vector<double> places = ring_places(shape_);
    cap(0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      ring(places[i]);
      if (i > 0) join_last_rings();
    }
    cap(shape_.length());
    model_.parts.push_back({0, static_cast<std::uint32_t>(model_.indices.size()), 0});
    model_.materials.emplace_back();
    bound();
    return std::move(model_);
  }

 private:
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(model_.vertices.size()); }

  void add(Vec3 point, Vec3 normal) {
    model_.vertices.push_back({.position = to_array(point_to_graphics(point)),
                               .normal = to_array(direction_to_graphics(normal)),
                               .tangent = {1, 0, 0, 1},
                               .uv = {0, 0},
                               .color = {1, 1, 1, 1}});
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    model_.indices.insert(model_.indices.end(), {a, b, c});
  }

  /// A ring in the plane in which the rod is cut there, which at a mitre is not square to it.
  void ring(double s) {
    const CentrelinePoint at = shape_.at(s);
    across_ = carried(across_, along_, at.tangent);
    along_ = at.tangent;
    const Vec3 cut = shape_.cut_normal(s), up = cross(along_, across_);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      const Vec3 out = std::cos(angle) * across_ + std::sin(angle) * up;
      add(at.position + shape_.radius() * (out - along_ * (dot(out, cut) / dot(along_, cut))), out);
    }
  }

  void join_last_rings() {
    const std::uint32_t after = vertices() - sides, before = after - sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t next = (i + 1) % sides;
      triangle(before + i, before + next, after + i);
      triangle(before + next, after + next, after + i);
    }
  }

  void cap(double s) {
    const bool start = s == 0;
    const Vec3 out = start ? -along_ : along_;
    const std::uint32_t first = vertices();
    const Vec3 centre = shape_.at(s).position, up = cross(along_, across_);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      add(centre + shape_.radius() * (std::cos(angle) * across_ + std::sin(angle) * up), out);
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i)
      triangle(first, first + (start ? i + 1 : i), first + (start ? i : i + 1));
  }

  void bound() {
    model_.lower = model_.upper = model_.vertices.front().position;
    for (const ModelVertex& v : model_.vertices)
      for (std::size_t i = 0; i < 3; ++i) {
        model_.lower[i] = std::min(model_.lower[i], v.position[i]);
        model_.upper[i] = std::max(model_.upper[i], v.position[i]);
      }
  }

  const Shape& shape_;
  Vec3 along_, across_;
  Model model_{.name = "rod",
               .vertices = {},
               .indices = {},
               .parts = {},
               .materials = {},
               .images = {},
               .lower = {},
               .upper = {}};
};

}  // namespace

Model rod_mesh(const Shape& shape) {
  return RodBuilder(shape).build();
}

}  // namespace onestroke

#include "render/cut_face.h"

#include "scene/frames.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

/// World, graphics axes, metres.
struct Section {
  glm::vec3 normal{};      // unit, to the side that is kept
  float plane_offset = 0;  // of the plane along it, with its sign as in ClipPlane
  glm::vec3 centre{};      // of a ball round the model
  float radius = 0;
  float centre_height = 0;  // above the plane

  bool cuts() const { return std::abs(centre_height) < radius; }
};

Section section_of(const ModelInstance& instance, const Box& box) {
  const glm::mat4 m = glm::make_mat4(instance.world_graphics_from_model.data());
  const ClipPlane plane = instance.clip_plane.value_or(ClipPlane{});
  const glm::vec3 normal(plane.a, plane.b, plane.c);
  const float length = glm::length(normal);
  if (!(length > 0)) return {};
  Section section{.normal = normal / length, .plane_offset = plane.d / length};
  section.centre = glm::vec3(m * glm::vec4(box.centre(), 1.0F));
  const glm::vec3 half = (box.upper - box.lower) * 0.5F;
  for (const float x : {-half.x, half.x})
    for (const float y : {-half.y, half.y})
      section.radius = std::max(section.radius, glm::length(glm::mat3(m) * glm::vec3(x, y, half.z)));
  section.centre_height = glm::dot(section.normal, section.centre) + section.plane_offset;
  return section;
}

glm::vec3 in_plane(const glm::vec3& axis, const glm::vec3& normal) {
  return axis - glm::dot(axis, normal) * normal;
}

/// Of three axes that which is nearest to the plane, laid into it.
glm::vec3 nearest_axis(const glm::mat3& axes, const glm::vec3& normal) {
  glm::vec3 best{};
  for (glm::length_t i = 0; i < 3; ++i) {
    const glm::vec3 along = in_plane(glm::normalize(axes[i]), normal);
    if (glm::length(along) > glm::length(best)) best = along;
  }
  return glm::normalize(best);
}

/// Half the side of a square in the plane round `foot` that holds the face; metres.
float half_side(const Section& section, const glm::vec3& foot) {
  // So much holds all that hands can, and is the same for all of it.
  constexpr float usual = 4;
  const float reach = glm::distance(foot, section.centre) + section.radius;
  return std::max(usual, std::exp2(std::ceil(std::log2(reach))));
}

/// Across lines that lie between two of the model's axes; see gpu::CutData.
gpu::vec4 hatch_of(const Section& section, const glm::mat3& world_from_model) {
  const glm::vec3 axis = nearest_axis(world_from_model, section.normal);
  const glm::vec3 across_lines = glm::normalize(axis + glm::cross(section.normal, axis));
  return {across_lines, -glm::dot(across_lines, section.centre)};
}

}  // namespace

bool shows_cut(const ModelInstance& instance, const Box& box, std::span<const View> views) {
  if (!instance.fill_cut || !instance.clip_plane) return false;
  const Section section = section_of(instance, box);
  return section.cuts() && std::ranges::any_of(views, [&section](const View& view) {
           const glm::vec3 eye = point_to_graphics(view.T_world_view.translation);
           return glm::dot(section.normal, eye) + section.plane_offset < 0;
         });
}

gpu::CutData cut_face(const ModelInstance& instance, const Box& box, const glm::vec3& eye) {
  const Section section = section_of(instance, box);
  const glm::vec3 foot = eye - (glm::dot(section.normal, eye) + section.plane_offset) * section.normal;
  const glm::mat3 world_from_model(glm::make_mat4(instance.world_graphics_from_model.data()));
  const Color& c = instance.cut_color;
  return {.plane = {section.normal, section.plane_offset},
          .centre = {foot, half_side(section, foot)},
          .across = {nearest_axis(glm::mat3(1.0F), section.normal), 0.0F},
          .hatch = hatch_of(section, world_from_model),
          // What only hides gives no light.
          .color = {c.r, c.g, c.b, instance.occluder ? 0.0F : instance.tint.a}};
}

}  // namespace onestroke

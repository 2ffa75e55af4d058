#include "scene/gltf_geometry.h"

#include "scene/gltf_materials.h"
#include "scene/mesh_normals.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace onestroke {

namespace {

struct Placed {
  int mesh;
  glm::dmat4 transform;
};

glm::dmat4 local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  glm::dmat4 m(1.0);
  if (node.translation.size() == 3) m = glm::translate(m, glm::make_vec3(node.translation.data()));
  if (node.rotation.size() == 4) {
    const auto& r = node.rotation;
    const glm::dquat q(r[3], r[0], r[1], r[2]);
    if (glm::length(q) > 0) m *= glm::mat4_cast(glm::normalize(q));
  }
  if (node.scale.size() == 3) m = glm::scale(m, glm::make_vec3(node.scale.data()));
  return m;
}

std::vector<int> root_nodes(const GltfReader& reader) {
  const tinygltf::Model& gltf = reader.model();
  if (!gltf.scenes.empty()) {
    const int scene = std::max(gltf.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= gltf.scenes.size()) reader.fail("its default scene is missing");
    return gltf.scenes[static_cast<std::size_t>(scene)].nodes;
  }
  std::vector<bool> is_child(gltf.nodes.size(), false);
  for (const tinygltf::Node& node : gltf.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  return roots;
}

// The meshes of the scene where they stand. A node met twice means a ring or a shared child, which glTF forbids.
std::vector<Placed> placed_meshes(const GltfReader& reader) {
  const tinygltf::Model& gltf = reader.model();
  std::vector<std::pair<int, glm::dmat4>> open;
  for (const int root : root_nodes(reader)) open.emplace_back(root, glm::dmat4(1.0));
  std::reverse(open.begin(), open.end());
  std::vector<bool> met(gltf.nodes.size(), false);
  std::vector<Placed> placed;
  while (!open.empty()) {
    const auto [index, parent] = open.back();
    open.pop_back();
    const std::string name = "node " + std::to_string(index);
    if (index < 0 || static_cast<std::size_t>(index) >= gltf.nodes.size()) reader.fail(name + " is missing");
    if (met[static_cast<std::size_t>(index)]) reader.fail(name + " has two parents");
    met[static_cast<std::size_t>(index)] = true;
    const tinygltf::Node& node = gltf.nodes[static_cast<std::size_t>(index)];
    const glm::dmat4 transform = parent * local_transform(node);
    if (node.mesh >= 0) placed.push_back({node.mesh, transform});
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      open.emplace_back(*child, transform);
  }
  return placed;
}

const int* find_attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? nullptr : &found->second;
}

// Copies an attribute's numbers into one member of every vertex; further numbers of the member stay as they are.
template <std::size_t N>
bool read_attribute(const GltfReader& reader, const int* accessor, std::array<float, N> ModelVertex::*member,
                    std::vector<ModelVertex>& vertices) {
  if (!accessor) return false;
  const std::size_t width = std::min(N, static_cast<std::size_t>(std::max(reader.components(*accessor), 1)));
  std::vector<float> numbers = reader.numbers(*accessor, static_cast<int>(width));
  if (numbers.size() != width * vertices.size())
    reader.fail("accessor " + std::to_string(*accessor) + " does not have one element a vertex");
  // A bad number elsewhere spoils a texture or a shade; a bad position would spoil the model's place and size.
  if (!std::all_of(numbers.begin(), numbers.end(), [](float n) { return std::isfinite(n); })) {
    if constexpr (N == 3)
      if (member == &ModelVertex::position)
        reader.fail("accessor " + std::to_string(*accessor) + " holds positions that are not finite");
    std::replace_if(
        numbers.begin(), numbers.end(), [](float n) { return !std::isfinite(n); }, 0.0F);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i * width), width, (vertices[i].*member).begin());
  return true;
}

std::vector<std::uint32_t> read_triangles(const GltfReader& reader, const tinygltf::Primitive& p,
                                          std::size_t vertices) {
  std::vector<std::uint32_t> order;
  if (p.indices >= 0) {
    order = reader.indices(p.indices);
  } else {
    order.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) order[i] = static_cast<std::uint32_t>(i);
  }
  if (std::any_of(order.begin(), order.end(), [&](std::uint32_t i) { return i >= vertices; }))
    reader.fail("accessor " + std::to_string(p.indices) + " names a vertex that is not there");
  if (p.mode == TINYGLTF_MODE_TRIANGLES) {
    order.resize(order.size() / 3 * 3);
    return order;
  }
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 2; i < order.size(); ++i) {
    const bool fan = p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const std::size_t odd = fan ? 0 : i % 2;
    triangles.insert(triangles.end(), {order[fan ? 0 : i - 2], order[i - 1 + odd], order[i - odd]});
  }
  return triangles;
}

Surface read_surface(const GltfReader& reader, const Model& model, const tinygltf::Primitive& p) {
  const int* position = find_attribute(p, "POSITION");
  if (!position) reader.fail("a surface has no positions");
  if (reader.components(*position) != 3) reader.fail("a surface has positions that are not points in space");
  Surface s;
  s.vertices.resize(reader.count(*position), ModelVertex{{}, {}, {0, 0, 0, 1}, {}, {1, 1, 1, 1}});
  read_attribute(reader, position, &ModelVertex::position, s.vertices);
  const std::string uv = "TEXCOORD_" + std::to_string(texture_coordinate_set(reader, p.material));
  const bool has_uv = read_attribute(reader, find_attribute(p, uv), &ModelVertex::uv, s.vertices);
  read_attribute(reader, find_attribute(p, "COLOR_0"), &ModelVertex::color, s.vertices);
  s.indices = read_triangles(reader, p, s.vertices.size());

  const bool given = read_attribute(reader, find_attribute(p, "NORMAL"), &ModelVertex::normal, s.vertices);
  const bool has_normals = given && make_normals_unit(s.vertices);
  if (!has_normals) compute_normals(s, usual_crease);
  const bool mapped = p.material >= 0 && model.materials[static_cast<std::size_t>(p.material)].normal_texture >= 0;
  const int* tangent = find_attribute(p, "TANGENT");
  if (has_normals && tangent && reader.components(*tangent) == 4) {
    read_attribute(reader, tangent, &ModelVertex::tangent, s.vertices);
  } else if (mapped && has_uv) {
    compute_tangents(s);
  } else {
    fill_tangents(s);
  }
  return s;
}

void set_direction(float* target, const glm::dvec3& direction) {
  const double length = glm::length(direction);
  if (!(length > 0)) return;
  for (glm::length_t k = 0; k < 3; ++k) target[k] = static_cast<float>(direction[k] / length);
}

// Normals go with the cofactor matrix, which unlike the inverse also exists for a flattened surface.
void place(const glm::dmat4& transform, Surface& s) {
  const glm::dmat3 linear(transform);
  const glm::dvec3 x = linear[0], y = linear[1], z = linear[2];
  const double turn = glm::dot(x, glm::cross(y, z)) < 0 ? -1.0 : 1.0;
  const glm::dmat3 cofactor = turn * glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  for (ModelVertex& v : s.vertices) {
    const glm::dvec3 p(transform * glm::dvec4(glm::dvec3(glm::make_vec3(v.position.data())), 1.0));
    for (glm::length_t k = 0; k < 3; ++k) v.position[static_cast<std::size_t>(k)] = static_cast<float>(p[k]);
    set_direction(v.normal.data(), cofactor * glm::dvec3(glm::make_vec3(v.normal.data())));
    set_direction(v.tangent.data(), linear * glm::dvec3(glm::make_vec3(v.tangent.data())));
    v.tangent[3] *= static_cast<float>(turn);
  }
  if (turn < 0)
    for (std::size_t i = 0; i + 2 < s.indices.size(); i += 3) std::swap(s.indices[i + 1], s.indices[i + 2]);
}

bool has_triangles(const tinygltf::Primitive& p) {
  return p.mode == TINYGLTF_MODE_TRIANGLES || p.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

}  // namespace

void read_geometry(const GltfReader& reader, Model& model) {
  const tinygltf::Model& gltf = reader.model();
  const auto default_material = static_cast<int>(gltf.materials.size());
  std::map<int, Surface> of_material;
  for (const Placed& placed : placed_meshes(reader)) {
    if (static_cast<std::size_t>(placed.mesh) >= gltf.meshes.size())
      reader.fail("mesh " + std::to_string(placed.mesh) + " is missing");
    for (const tinygltf::Primitive& p : gltf.meshes[static_cast<std::size_t>(placed.mesh)].primitives) {
      if (!has_triangles(p)) continue;
      if (p.material >= default_material) reader.fail("material " + std::to_string(p.material) + " is missing");
      Surface s = read_surface(reader, model, p);
      place(placed.transform, s);
      append(s, of_material[p.material >= 0 ? p.material : default_material]);
    }
  }
  if (of_material.contains(default_material)) model.materials.emplace_back();
  Surface all;
  for (const auto& [material, surface] : of_material) {
    if (surface.indices.empty()) continue;
    model.parts.push_back(
        {static_cast<std::uint32_t>(all.indices.size()), static_cast<std::uint32_t>(surface.indices.size()), material});
    append(surface, all);
  }
  model.vertices = std::move(all.vertices);
  model.indices = std::move(all.indices);
}

}  // namespace onestroke

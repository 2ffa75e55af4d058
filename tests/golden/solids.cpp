#include "golden/solids.h"

#include <cmath>
#include <numbers>

namespace onestroke::golden {

namespace {

using Vec = std::array<float, 3>;

Vec scaled(Vec v, float k) {
  return {v[0] * k, v[1] * k, v[2] * k};
}

Vec sum(Vec a, Vec b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

void add_quad(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  model.indices.insert(model.indices.end(), {a, b, c, a, c, d});
}

/// A rectangle around `centre`; right x up is its normal.
void add_face(Model& model, Vec centre, Vec right, Vec up, Vec normal) {
  const auto first = static_cast<std::uint32_t>(model.vertices.size());
  const float length = std::hypot(right[0], right[1], right[2]);
  for (const auto& [x, y] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}})
    model.vertices.push_back({.position = sum(centre, sum(scaled(right, x), scaled(up, y))),
                              .normal = normal,
                              .tangent = {right[0] / length, right[1] / length, right[2] / length, 1},
                              .uv = {(x + 1) / 2, (1 - y) / 2},
                              .color = {1, 1, 1, 1}});
  add_quad(model, first, first + 1, first + 2, first + 3);
}

Model finished(Model model, const char* name, const ModelMaterial& material) {
  model.name = name;
  model.materials = {material};
  model.parts = {{.first_index = 0, .index_count = static_cast<std::uint32_t>(model.indices.size()), .material = 0}};
  return model;
}

}  // namespace

Model torus(float ring_radius, float tube_radius, const ModelMaterial& material) {
  constexpr std::uint32_t around = 64, across = 32;
  Model model;
  for (std::uint32_t i = 0; i <= around; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const float u = static_cast<float>(i) / around, v = static_cast<float>(j) / across;
      const float a = u * 2 * std::numbers::pi_v<float>, b = v * 2 * std::numbers::pi_v<float>;
      const float reach = ring_radius + tube_radius * std::cos(b);
      model.vertices.push_back({.position = {reach * std::cos(a), reach * std::sin(a), tube_radius * std::sin(b)},
                                .normal = {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)},
                                .tangent = {-std::sin(a), std::cos(a), 0, 1},
                                .uv = {u * 4, v},
                                .color = {1, 1, 1, 1}});
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t at = i * (across + 1) + j, next = at + across + 1;
      add_quad(model, at, next, next + 1, at + 1);
    }
  return finished(std::move(model), "torus", material);
}

Model box(Vec h, const ModelMaterial& material) {
  Model model;
  add_face(model, {h[0], 0, 0}, {0, 0, -h[2]}, {0, h[1], 0}, {1, 0, 0});
  add_face(model, {-h[0], 0, 0}, {0, 0, h[2]}, {0, h[1], 0}, {-1, 0, 0});
  add_face(model, {0, h[1], 0}, {h[0], 0, 0}, {0, 0, -h[2]}, {0, 1, 0});
  add_face(model, {0, -h[1], 0}, {h[0], 0, 0}, {0, 0, h[2]}, {0, -1, 0});
  add_face(model, {0, 0, h[2]}, {h[0], 0, 0}, {0, h[1], 0}, {0, 0, 1});
  add_face(model, {0, 0, -h[2]}, {-h[0], 0, 0}, {0, h[1], 0}, {0, 0, -1});
  return finished(std::move(model), "box", material);
}

Model sheet(float half, const ModelMaterial& material) {
  Model model;
  add_face(model, {0, 0, 0}, {half, 0, 0}, {0, half, 0}, {0, 0, 1});
  return finished(std::move(model), "sheet", material);
}

Model hollow(const Model& outer, const Model& inner) {
  Model model = outer;
  model.vertices.insert(model.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (auto vertex = model.vertices.begin() + static_cast<std::ptrdiff_t>(outer.vertices.size());
       vertex != model.vertices.end(); ++vertex)
    vertex->normal = scaled(vertex->normal, -1);
  const auto first = static_cast<std::uint32_t>(outer.vertices.size());
  for (std::size_t i = 0; i < inner.indices.size(); i += 3)
    for (const std::size_t corner : {0U, 2U, 1U}) model.indices.push_back(first + inner.indices[i + corner]);
  return finished(std::move(model), "hollow", outer.materials.front());
}

ModelImage checks(int size, int cells) {
  ModelImage image{size, size, true, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const bool light = (x * cells / size + y * cells / size) % 2 == 0;
      const std::uint8_t level = light ? 235 : 150;
      image.rgba.insert(image.rgba.end(), {level, level, level, 255});
    }
  return image;
}

ModelImage bumps(int size, int cells) {
  ModelImage image{size, size, false, {}};
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround((v * 0.5F + 0.5F) * 255)); };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float cell = static_cast<float>(size) / static_cast<float>(cells);
      const float u = std::fmod(static_cast<float>(x) + 0.5F, cell) / cell * 2 - 1;
      const float v = std::fmod(static_cast<float>(y) + 0.5F, cell) / cell * 2 - 1;
      const float r2 = u * u + v * v;
      const float nx = r2 < 0.6F ? u * 0.7F : 0, ny = r2 < 0.6F ? -v * 0.7F : 0;
      image.rgba.insert(image.rgba.end(), {byte(nx), byte(ny), byte(std::sqrt(1 - nx * nx - ny * ny)), 255});
    }
  return image;
}

}  // namespace onestroke::golden

#pragma once

#include "core/model_import.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace onestroke {

/// Right-handed, y up, metres, as glTF 2.0 says.
struct ModelVertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::array<float, 4> tangent;  ///< w is the sign of the bitangent.
  std::array<float, 2> uv;
  std::array<float, 4> color;  ///< Linear, 1 where the file gives none.
};

/// 8-bit RGBA, rows from the top, no padding.
struct ModelImage {
  int width = 0, height = 0;
  bool srgb = false;
  std::vector<std::uint8_t> rgba;
};

/// glTF's metallic-roughness material. Textures are indices into Model::images, -1 for none.
struct ModelMaterial {
  enum class AlphaMode { opaque, mask, blend };
  std::array<float, 4> base_color{1, 1, 1, 1};
  std::array<float, 3> emissive{0, 0, 0};
  float metallic = 1, roughness = 1;
  float normal_scale = 1, occlusion_strength = 1, alpha_cutoff = 0.5F;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
  int base_color_texture = -1, metallic_roughness_texture = -1, normal_texture = -1, occlusion_texture = -1,
      emissive_texture = -1;

  bool textured() const {
    return std::max({base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture,
                     emissive_texture}) >= 0;
  }
};

/// Triangles of one material: a range of Model::indices.
struct ModelPart {
  std::uint32_t first_index = 0, index_count = 0;
  int material = 0;
};

/// The same model in fewer triangles: its parts, in the model's order, as further ranges of Model::indices.
struct ModelLevel {
  float error = 0;  ///< How far surface, texture and colours are off at most, metres.
  std::vector<ModelPart> parts;
};

/// A model as the renderer takes it: one vertex and one index buffer, node transforms already applied.
struct Model {
  std::string name;
  std::vector<ModelVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<ModelPart> parts;
  std::vector<ModelLevel> levels{};  ///< Ever coarser, errors growing; see mesh_levels.h. Often none.
  std::vector<ModelMaterial> materials;
  std::vector<ModelImage> images;
  std::array<float, 3> lower{}, upper{};  ///< Bounding box, metres.
  bool casts_shadow = true;               ///< Takes light from other models that it is close to.
};

/// Told now and then how far a load is, 0 to 1. What it throws ends the load and reaches the caller.
using LoadProgress = std::function<void(double)>;

/// Loads .glb, .gltf, .stl, .obj or .ply, turned upright and in metres. Throws Error that names the file and what is
/// wrong with it.
Model load_model(const std::filesystem::path& file, const ModelImport& import = {}, const LoadProgress& progress = {});

}  // namespace onestroke

#include "scene/mesh_materials.h"

#include "core/error.h"
#include "core/srgb.h"
#include "scene/file_bytes.h"
#include "scene/image_file.h"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace onestroke {

namespace {

constexpr std::array<float, 4> plain{0.47F, 0.47F, 0.47F, 1};
constexpr float plain_roughness = 0.6F;

float share(float x) {
  return std::isfinite(x) ? std::clamp(x, 0.0F, 1.0F) : 0.0F;
}

float linear(float srgb) {
  return linear_from_srgb(share(srgb));
}

std::optional<float> number(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  float value = 0;
  if (m.Get(key, type, index, value) != AI_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<aiColor4D> color(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  aiColor4D value(0, 0, 0, 1);
  if (m.Get(key, type, index, value) != AI_SUCCESS) return std::nullopt;
  return value;
}

std::string texture(const aiMaterial& m, aiTextureType type) {
  aiString path;
  return m.GetTexture(type, 0, &path) == AI_SUCCESS ? std::string(path.C_Str(), path.length) : std::string();
}

// The width of a highlight, as Blinn-Phong's exponent and as a roughness (Karis).
float roughness_of(const aiMaterial& m) {
  if (const auto given = number(m, AI_MATKEY_ROUGHNESS_FACTOR)) return share(*given);
  const auto shininess = number(m, AI_MATKEY_SHININESS);
  const auto specular = color(m, AI_MATKEY_COLOR_SPECULAR);
  const bool shines = specular && std::max({specular->r, specular->g, specular->b}) > 0.01F;
  if (!shininess || !(*shininess > 0) || !shines) return plain_roughness;
  return std::clamp(std::pow(2 / (*shininess + 2), 0.25F), 0.15F, 1.0F);
}

// What nobody could see was meant the other way round: "d" and "Tr" of OBJ's materials are often mixed up.
float opacity_of(const aiMaterial& m) {
  const float opacity = share(number(m, AI_MATKEY_OPACITY).value_or(1));
  return opacity > 0 ? opacity : 1;
}

}  // namespace

std::array<float, 4> linear_color(const aiColor4D& c) {
  return {linear(c.r), linear(c.g), linear(c.b), share(c.a)};
}

std::array<float, 2> texture_place(const aiVector3D& place) {
  const bool sound = std::isfinite(place.x) && std::isfinite(place.y);
  return sound ? std::array{place.x, 1 - place.y} : std::array{0.0F, 0.0F};
}

int MeshMaterials::add(const aiMaterial* material, bool vertex_colors) {
  const auto [entry, added] = known_.try_emplace({material, vertex_colors}, static_cast<int>(model_.materials.size()));
  if (added) model_.materials.push_back(make(material, vertex_colors));
  return entry->second;
}

// Nobody says which side of a surface is the outer one, and scans are open, so both are shown.
ModelMaterial MeshMaterials::make(const aiMaterial* material, bool vertex_colors) {
  ModelMaterial out{.base_color = plain, .metallic = 0, .roughness = plain_roughness, .double_sided = true};
  if (material) {
    const aiMaterial& in = *material;
    const std::string diffuse = texture(in, aiTextureType_DIFFUSE), opacity = texture(in, aiTextureType_OPACITY);
    if (const auto c = color(in, AI_MATKEY_COLOR_DIFFUSE)) out.base_color = linear_color(*c);
    out.base_color[3] = opacity_of(in);
    out.roughness = roughness_of(in);
    out.metallic = share(number(in, AI_MATKEY_METALLIC_FACTOR).value_or(0));
    if (const auto c = color(in, AI_MATKEY_COLOR_EMISSIVE)) out.emissive = {linear(c->r), linear(c->g), linear(c->b)};
    out.base_color_texture = add_image(diffuse, true);
    // Exporters leave the colour of a textured material black now and then.
    const bool black = std::max({out.base_color[0], out.base_color[1], out.base_color[2]}) < 1e-3F;
    if (out.base_color_texture >= 0 && black) std::fill_n(out.base_color.begin(), 3, 1.0F);
    if (out.base_color_texture >= 0 && !opacity.empty() && opacity == diffuse)
      out.alpha_mode = ModelMaterial::AlphaMode::mask;
    if (out.base_color[3] < 0.999F) out.alpha_mode = ModelMaterial::AlphaMode::blend;
  }
  if (vertex_colors) std::fill_n(out.base_color.begin(), 3, 1.0F);
  return out;
}

int MeshMaterials::add_image(const std::string& path, bool srgb) {
  const auto found = file_beside(std::filesystem::absolute(file_).parent_path(), path);
  Bytes bytes;
  if (!found || !read_bytes(*found, bytes)) return -1;
  const auto [entry, added] = images_.try_emplace({found->string(), srgb}, static_cast<int>(model_.images.size()));
  if (!added) return entry->second;
  ModelImage image;
  const std::string fault = decode_image(bytes, image);
  if (!fault.empty()) throw Error(file_.string() + ": image " + path + " " + fault + "; export the model again");
  image.srgb = srgb;
  model_.images.push_back(std::move(image));
  return entry->second;
}

}  // namespace onestroke

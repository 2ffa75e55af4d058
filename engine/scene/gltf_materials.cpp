#include "scene/gltf_materials.h"

#include "scene/image_file.h"

#include <algorithm>
#include <map>

namespace onestroke {

namespace {

std::string name_of(const GltfReader& reader, int image) {
  const tinygltf::Image& i = reader.model().images[static_cast<std::size_t>(image)];
  return i.uri.empty() ? "image " + std::to_string(image) : "image " + i.uri;
}

ModelImage decode(const GltfReader& reader, int index) {
  const tinygltf::Image& image = reader.model().images[static_cast<std::size_t>(index)];
  const std::span<const std::uint8_t> bytes =
      image.bufferView >= 0 ? reader.view(image.bufferView) : std::span<const std::uint8_t>(image.image);
  if (bytes.empty()) reader.fail(name_of(reader, index) + " is missing beside the model, or empty");
  ModelImage result;
  const std::string fault = decode_image(bytes, result);
  if (!fault.empty()) reader.fail(name_of(reader, index) + " " + fault);
  return result;
}

// Decodes each image once a colour space: an image used both as a colour and as data is kept twice.
class Images {
 public:
  Images(const GltfReader& reader, Model& model) : reader_(reader), model_(model) {}

  int add(int texture, bool srgb) {
    if (texture < 0) return -1;
    const auto& textures = reader_.model().textures;
    if (static_cast<std::size_t>(texture) >= textures.size())
      reader_.fail("texture " + std::to_string(texture) + " is missing");
    const int source = textures[static_cast<std::size_t>(texture)].source;
    if (source < 0 || static_cast<std::size_t>(source) >= reader_.model().images.size())
      reader_.fail("texture " + std::to_string(texture) + " has no image");
    const auto [entry, added] = known_.try_emplace({source, srgb}, static_cast<int>(model_.images.size()));
    if (added) {
      model_.images.push_back(decode(reader_, source));
      model_.images.back().srgb = srgb;
    }
    return entry->second;
  }

 private:
  const GltfReader& reader_;
  Model& model_;
  std::map<std::pair<int, bool>, int> known_;
};

template <std::size_t N>
std::array<float, N> factor(const std::vector<double>& values, std::array<float, N> otherwise) {
  if (values.size() != N) return otherwise;
  std::array<float, N> result;
  std::transform(values.begin(), values.end(), result.begin(), [](double v) { return static_cast<float>(v); });
  return result;
}

float emissive_strength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength")) return 1;
  return static_cast<float>(extension->second.Get("emissiveStrength").GetNumberAsDouble());
}

ModelMaterial read_material(const tinygltf::Material& in, Images& images) {
  const auto& pbr = in.pbrMetallicRoughness;
  ModelMaterial out;
  out.base_color = factor(pbr.baseColorFactor, out.base_color);
  out.emissive = factor(in.emissiveFactor, out.emissive);
  for (float& e : out.emissive) e *= emissive_strength(in);
  out.metallic = static_cast<float>(pbr.metallicFactor);
  out.roughness = static_cast<float>(pbr.roughnessFactor);
  out.normal_scale = static_cast<float>(in.normalTexture.scale);
  out.occlusion_strength = static_cast<float>(in.occlusionTexture.strength);
  out.alpha_cutoff = static_cast<float>(in.alphaCutoff);
  if (in.alphaMode == "MASK") out.alpha_mode = ModelMaterial::AlphaMode::mask;
  if (in.alphaMode == "BLEND") out.alpha_mode = ModelMaterial::AlphaMode::blend;
  out.double_sided = in.doubleSided;
  out.base_color_texture = images.add(pbr.baseColorTexture.index, true);
  out.metallic_roughness_texture = images.add(pbr.metallicRoughnessTexture.index, false);
  out.normal_texture = images.add(in.normalTexture.index, false);
  out.occlusion_texture = images.add(in.occlusionTexture.index, false);
  out.emissive_texture = images.add(in.emissiveTexture.index, true);
  return out;
}

}  // namespace

bool keep_encoded_image(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                        int size, void*) {
  // The bytes of a buffer view are not known to be inside their buffer yet; they are read from it later.
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

void read_materials(const GltfReader& reader, Model& model) {
  Images images(reader, model);
  for (const tinygltf::Material& material : reader.model().materials)
    model.materials.push_back(read_material(material, images));
}

int texture_coordinate_set(const GltfReader& reader, int index) {
  if (index < 0) return 0;
  const tinygltf::Material& m = reader.model().materials[static_cast<std::size_t>(index)];
  const auto& pbr = m.pbrMetallicRoughness;
  int set = -1;
  const auto use = [&](const auto& texture) {
    if (texture.index < 0) return;
    if (set >= 0 && set != texture.texCoord)
      reader.fail("material " + std::to_string(index) + " uses two sets of texture coordinates, one is supported");
    set = texture.texCoord;
  };
  use(pbr.baseColorTexture);
  use(pbr.metallicRoughnessTexture);
  use(m.normalTexture);
  use(m.occlusionTexture);
  use(m.emissiveTexture);
  return std::max(set, 0);
}

}  // namespace onestroke

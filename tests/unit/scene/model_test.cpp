#include "scene/model.h"

#include "gltf_file.h"

#include <gmock/gmock.h>
#include <stb/stb_image_write.h>

#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

using testing::ElementsAre;
using testing::FloatNear;

class LoadModel : public testing::Test {
 protected:
  Model load(const GltfFile& f) { return load_model(folder_.write("part.glb", f.glb())); }

  TemporaryFolder folder_;
};

auto near3(float x, float y, float z) {
  return ElementsAre(FloatNear(x, 1e-5F), FloatNear(y, 1e-5F), FloatNear(z, 1e-5F));
}

TEST_F(LoadModel, ReadsASquareAndWorksOutItsNormals) {
  const Model m = load(square());
  EXPECT_EQ(m.name, "part");
  ASSERT_EQ(m.indices.size(), 6U);
  ASSERT_EQ(m.vertices.size(), 4U);
  for (const ModelVertex& v : m.vertices) {
    EXPECT_THAT(v.normal, near3(0, 0, 1));
    EXPECT_EQ(v.color, (std::array<float, 4>{1, 1, 1, 1}));
    EXPECT_NEAR(std::hypot(v.tangent[0], v.tangent[1], v.tangent[2]), 1, 1e-6);
  }
  EXPECT_THAT(m.lower, near3(0, 0, 0));
  EXPECT_THAT(m.upper, near3(1, 1, 0));
  ASSERT_EQ(m.parts.size(), 1U);
  EXPECT_EQ(m.parts[0].index_count, 6U);
  EXPECT_EQ(m.materials.size(), 1U);
}

TEST_F(LoadModel, AppliesNodeTransforms) {
  GltfFile f = square();
  f.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                     {{"mesh", 0}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}, {"scale", {2, 3, 1}}}};
  const Model m = load(f);
  // A quarter turn about y takes x to -z and the normal from +z to +x.
  EXPECT_THAT(m.lower, near3(10, 0, -2));
  EXPECT_THAT(m.upper, near3(10, 3, 0));
  for (const ModelVertex& v : m.vertices) EXPECT_THAT(v.normal, near3(1, 0, 0));
}

std::array<float, 3> face_normal(const Model& m) {
  const auto& a = m.vertices[m.indices[0]].position;
  const auto& b = m.vertices[m.indices[1]].position;
  const auto& c = m.vertices[m.indices[2]].position;
  const std::array<float, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

TEST_F(LoadModel, AMirroredNodeKeepsItsFrontOutside) {
  GltfFile f = square();
  f.json["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Model m = load(f);
  EXPECT_THAT(m.vertices[0].normal, near3(0, 0, 1));
  EXPECT_GT(face_normal(m)[2], 0);
  EXPECT_FLOAT_EQ(m.vertices[0].tangent[3], -1);
}

TEST_F(LoadModel, NormalsFollowAnUnevenScale) {
  GltfFile f = square();
  const int normal = f.add_floats({.6F, 0, .8F, .6F, 0, .8F, .6F, 0, .8F, .6F, 0, .8F}, 3);
  f.primitive()["attributes"]["NORMAL"] = normal;
  f.json["nodes"][0]["scale"] = {2, 1, 1};
  const float length = std::hypot(0.3F, 0.8F);
  EXPECT_THAT(load(f).vertices[0].normal, near3(0.3F / length, 0, 0.8F / length));
}

// Two unit squares that meet in the edge y = 1 at the given angle; 0 is flat.
GltfFile fold(double angle) {
  GltfFile f;
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  const int position = f.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1 + c, -s, 0, 1 + c, -s}, 3);
  const int indices = f.add_shorts({0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5});
  f.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  return f;
}

TEST_F(LoadModel, ASharpEdgeStaysHardAndABluntOneBecomesSmooth) {
  const Model sharp = load(fold(std::numbers::pi / 2));
  EXPECT_EQ(sharp.vertices.size(), 8U);
  const Model smooth = load(fold(0.3));
  ASSERT_EQ(smooth.vertices.size(), 6U);
  for (const ModelVertex& v : smooth.vertices) {
    if (v.position[1] != 1) continue;
    EXPECT_THAT(v.normal, near3(0, std::sin(0.15F), std::cos(0.15F)));
  }
}

TEST_F(LoadModel, StripsAndFansAndUnindexedTrianglesAreTheSameSquare) {
  for (const auto& [mode, order] :
       {std::pair{5, std::vector<std::uint16_t>{0, 1, 3, 2}}, std::pair{6, std::vector<std::uint16_t>{0, 1, 2, 3}}}) {
    GltfFile f = square();
    f.primitive()["indices"] = f.add_shorts(order);
    f.primitive()["mode"] = mode;
    const Model m = load(f);
    EXPECT_EQ(m.indices.size(), 6U);
    for (const ModelVertex& v : m.vertices) EXPECT_THAT(v.normal, near3(0, 0, 1)) << "mode " << mode;
  }
  GltfFile f;
  const int position = f.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, 3);
  f.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", position}}}});
  EXPECT_EQ(load(f).indices.size(), 3U);
}

TEST_F(LoadModel, ReadsEveryMaterialFieldAndTexture) {
  GltfFile f = square();
  const std::vector<std::uint8_t> pixel{10, 20, 30, 255, 40, 50, 60, 128};
  std::vector<std::uint8_t> png;
  const auto write = [](void* user, void* bytes, int size) {
    auto* out = static_cast<std::vector<std::uint8_t>*>(user);
    out->insert(out->end(), static_cast<std::uint8_t*>(bytes), static_cast<std::uint8_t*>(bytes) + size);
  };
  ASSERT_TRUE(stbi_write_png_to_func(write, &png, 2, 1, 4, pixel.data(), 8));
  f.json["images"] = {{{"bufferView", f.add_view(png)}, {"mimeType", "image/png"}}};
  f.json["textures"] = {{{"source", 0}}};
  f.primitive()["attributes"]["TEXCOORD_0"] = f.add_floats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
  f.primitive()["attributes"]["COLOR_0"] =
      f.add_accessor<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 51, 51, 51, 255}, 5121, "VEC4", 4);
  f.json["accessors"].back()["normalized"] = true;
  f.primitive()["material"] = 0;
  f.json["materials"] = {{{"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                            {"metallicFactor", 0.5},
                            {"roughnessFactor", 0.6},
                            {"baseColorTexture", {{"index", 0}}},
                            {"metallicRoughnessTexture", {{"index", 0}}}}},
                          {"normalTexture", {{"index", 0}, {"scale", 0.7}}},
                          {"occlusionTexture", {{"index", 0}, {"strength", 0.8}}},
                          {"emissiveTexture", {{"index", 0}}},
                          {"emissiveFactor", {0.9, 0.8, 0.7}},
                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2.0}}}}},
                          {"alphaMode", "MASK"},
                          {"alphaCutoff", 0.25},
                          {"doubleSided", true}}};
  const Model m = load(f);
  ASSERT_EQ(m.materials.size(), 1U);
  const ModelMaterial& material = m.materials[0];
  EXPECT_THAT(material.base_color,
              ElementsAre(FloatNear(.1F, 1e-6F), FloatNear(.2F, 1e-6F), FloatNear(.3F, 1e-6F), FloatNear(.4F, 1e-6F)));
  EXPECT_THAT(material.emissive, near3(1.8F, 1.6F, 1.4F));
  EXPECT_FLOAT_EQ(material.metallic, 0.5F);
  EXPECT_FLOAT_EQ(material.roughness, 0.6F);
  EXPECT_FLOAT_EQ(material.normal_scale, 0.7F);
  EXPECT_FLOAT_EQ(material.occlusion_strength, 0.8F);
  EXPECT_FLOAT_EQ(material.alpha_cutoff, 0.25F);
  EXPECT_EQ(material.alpha_mode, ModelMaterial::AlphaMode::mask);
  EXPECT_TRUE(material.double_sided);
  // The one image serves as a colour and as data, so it is there in both colour spaces.
  ASSERT_EQ(m.images.size(), 2U);
  EXPECT_TRUE(m.images[static_cast<std::size_t>(material.base_color_texture)].srgb);
  EXPECT_EQ(material.emissive_texture, material.base_color_texture);
  EXPECT_FALSE(m.images[static_cast<std::size_t>(material.normal_texture)].srgb);
  EXPECT_EQ(material.metallic_roughness_texture, material.normal_texture);
  EXPECT_EQ(material.occlusion_texture, material.normal_texture);
  EXPECT_EQ(m.images[0].width, 2);
  EXPECT_EQ(m.images[0].height, 1);
  EXPECT_EQ(m.images[0].rgba, pixel);
  // u runs along +x and v down, so the tangent is +x and the bitangent, up in the texture, n x t.
  for (const ModelVertex& v : m.vertices)
    EXPECT_THAT(v.tangent, ElementsAre(FloatNear(1, 1e-6F), FloatNear(0, 1e-6F), FloatNear(0, 1e-6F), 1.0F));
  EXPECT_FLOAT_EQ(m.vertices[3].color[0], 0.2F);
}

TEST_F(LoadModel, AMirroredTextureSplitsItsVertices) {
  GltfFile f = square();
  // The second triangle's texture runs backwards along x.
  f.primitive()["attributes"]["TEXCOORD_0"] = f.add_floats({0, 1, 1, 1, 1, 0, 2, 0}, 2);
  f.primitive()["attributes"]["NORMAL"] = f.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
  std::vector<std::uint8_t> png;
  const auto write = [](void* user, void* bytes, int size) {
    auto* out = static_cast<std::vector<std::uint8_t>*>(user);
    out->insert(out->end(), static_cast<std::uint8_t*>(bytes), static_cast<std::uint8_t*>(bytes) + size);
  };
  const std::vector<std::uint8_t> flat{128, 128, 255};
  ASSERT_TRUE(stbi_write_png_to_func(write, &png, 1, 1, 3, flat.data(), 3));
  f.json["images"] = {{{"bufferView", f.add_view(png)}, {"mimeType", "image/png"}}};
  f.json["textures"] = {{{"source", 0}}};
  f.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  f.primitive()["material"] = 0;
  const Model m = load(f);
  EXPECT_EQ(m.vertices.size(), 6U);
  EXPECT_FLOAT_EQ(m.vertices[m.indices[0]].tangent[3], 1);
  EXPECT_FLOAT_EQ(m.vertices[m.indices[3]].tangent[3], -1);
  for (const std::uint32_t i : m.indices) {
    const ModelVertex& v = m.vertices[i];
    EXPECT_NEAR(v.tangent[2], 0, 1e-6F);
    EXPECT_NEAR(std::hypot(v.tangent[0], v.tangent[1]), 1, 1e-6F);
  }
}

TEST_F(LoadModel, SparsePositionsAreFilledIn) {
  GltfFile f = square();
  f.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", f.add_view<std::uint16_t>({2})}, {"componentType", 5123}}},
      {"values", {{"bufferView", f.add_view<float>({1, 5, 0})}}}};
  EXPECT_THAT(load(f).upper, near3(1, 5, 0));
}

TEST_F(LoadModel, InterleavedVerticesAreRead) {
  GltfFile f = square();
  f.primitive()["attributes"]["POSITION"] = f.add_floats({0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 1, 1, 0, 9, 9, 0, 1, 0}, 3);
  f.json["bufferViews"].back()["byteStride"] = 20;
  f.json["accessors"].back()["count"] = 4;
  EXPECT_THAT(load(f).upper, near3(1, 1, 0));
}

TEST_F(LoadModel, PartsAreGatheredByMaterial) {
  GltfFile f = square();
  f.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
  auto& primitives = f.json["meshes"][0]["primitives"];
  primitives[0]["material"] = 1;
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 0;
  const Model m = load(f);
  ASSERT_EQ(m.parts.size(), 2U);
  EXPECT_EQ(m.parts[0].material, 0);
  EXPECT_EQ(m.parts[0].index_count, 6U);
  EXPECT_EQ(m.parts[1].material, 1);
  EXPECT_EQ(m.parts[1].first_index, 6U);
  EXPECT_EQ(m.parts[1].index_count, 12U);
}

TEST_F(LoadModel, ReadsTheTextFormWithAFileBesideIt) {
  GltfFile f = square();
  f.json["buffers"] = {{{"byteLength", f.data.size()}, {"uri", "part%20one.bin"}}};
  folder_.write("part one.bin", f.data);
  EXPECT_EQ(load_model(folder_.write("part.gltf", f.json.dump())).indices.size(), 6U);
}

}  // namespace
}  // namespace onestroke

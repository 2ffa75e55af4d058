// What only OBJ has: normals, polygons, materials.
#include "mesh_fixture.h"

namespace onestroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

TEST_F(MeshFile, ObjNormalsAreKeptAndPolygonsCutUp) {
  // An arrow head: concave, so that a fan would leave it.
  const Model m = load("a.obj", "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nvn 0 0.6 0.8\nf 1//1 2//1 3//1 4//1\n");
  ASSERT_EQ(m.indices.size(), 6U);
  double area = 0;
  for (std::size_t i = 0; i < 6; i += 3) {
    const auto p = [&](std::size_t k) { return m.vertices[m.indices[i + k]].position; };
    area += 0.5e6 * ((p(1)[0] - p(0)[0]) * (p(2)[1] - p(0)[1]) - (p(2)[0] - p(0)[0]) * (p(1)[1] - p(0)[1]));
  }
  EXPECT_NEAR(area, 1, 1e-5);
  for (const ModelVertex& v : m.vertices) EXPECT_THAT(v.normal, near3(0, 0.6F, 0.8F));
}

TEST_F(MeshFile, ObjIndicesMayCountFromTheEndAndMustBeThere) {
  EXPECT_EQ(load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n").indices.size(), 3U);
  EXPECT_NE(complaint("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n"), "no complaint");
}

TEST_F(MeshFile, ObjOfWindowsIsRead) {
  std::string text = "\xFF\xFE";
  for (const char c : box_.obj()) text += std::string{c, '\0'};
  expect_box(load("little.obj", text), {0, 0, 0}, {0.06F, 0.04F, 0.02F});
  std::string big = "\xFE\xFF";
  for (const char c : box_.obj()) big += std::string{'\0', c};
  expect_box(load("big.obj", big), {0, 0, 0}, {0.06F, 0.04F, 0.02F});
}

TEST_F(MeshFile, ObjMaterialsBecomeMetallicRoughness) {
  write_png("wood.png", 3);
  folder_.write("box.mtl",
                "newmtl wood\nKd 0 0 0\nKs 0 0 0\nNs 200\nmap_Kd .\\C\\wood.png\n"
                "newmtl glass\nKd 0.5 1 0\nd 0.25\nKs 1 1 1\nNs 200\nKe 0 0 1\n");
  const std::string uvs = "mtllib box.mtl\nvt 0 0\nvt 1 0.25\n";
  const Model m =
      load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n" + uvs + "usemtl wood\nf 1/1 2/2 3/2\nusemtl glass\nf 1/1 2/2 3/2\n");
  ASSERT_EQ(m.parts.size(), 2U);
  const ModelMaterial& wood = m.materials[static_cast<std::size_t>(m.parts[0].material)];
  const ModelMaterial& glass = m.materials[static_cast<std::size_t>(m.parts[1].material)];
  ASSERT_EQ(m.images.size(), 1U);
  EXPECT_EQ(m.images[0].width, 3);
  EXPECT_TRUE(m.images[0].srgb);
  EXPECT_EQ(wood.base_color_texture, 0);
  EXPECT_EQ(wood.base_color, (std::array{1.0F, 1.0F, 1.0F, 1.0F})) << "black would hide the texture";
  EXPECT_EQ(wood.metallic, 0);
  EXPECT_EQ(wood.alpha_mode, ModelMaterial::AlphaMode::opaque);
  EXPECT_GT(wood.roughness, 0.5F) << "nothing shines without a specular colour";
  EXPECT_EQ(glass.alpha_mode, ModelMaterial::AlphaMode::blend);
  EXPECT_THAT(glass.base_color, ElementsAre(FloatNear(0.2140F, 1e-3F), 1, 0, 0.25F));
  EXPECT_LT(glass.roughness, 0.4F);
  EXPECT_THAT(glass.emissive, near3(0, 0, 1));
  // v counts from the top.
  EXPECT_THAT(m.vertices[m.indices[1]].uv, ElementsAre(1, 0.75F));
}

TEST_F(MeshFile, ObjWithoutItsMaterialsIsPlain) {
  for (const std::string line : {"mtllib gone.mtl\nusemtl wood\n", "mtllib ../../../../etc/passwd\nusemtl root\n"}) {
    const Model m = load("a.obj", box_.obj(line));
    EXPECT_EQ(m.indices.size(), 36U);
    EXPECT_TRUE(m.images.empty());
  }
}

TEST_F(MeshFile, TexturesAreTakenFromBesideTheModelAlone) {
  TemporaryFolder elsewhere;
  const std::vector<std::uint8_t> pixel{1, 2, 3};
  ASSERT_TRUE(stbi_write_png((elsewhere.path() / "secret.png").c_str(), 1, 1, 3, pixel.data(), 3));
  std::filesystem::create_symlink(elsewhere.path() / "secret.png", folder_.path() / "link.png");
  const std::string up = "../" + elsewhere.path().filename().string() + "/secret.png";
  for (const std::string& path : {(elsewhere.path() / "secret.png").string(), up, std::string("link.png")}) {
    SCOPED_TRACE(path);
    folder_.write("box.mtl", "newmtl wood\nmap_Kd " + path + "\n");
    EXPECT_TRUE(load("a.obj", box_.obj("mtllib box.mtl\nusemtl wood\n")).images.empty());
  }
  folder_.write("broken.png", "no picture");
  folder_.write("box.mtl", "newmtl wood\nmap_Kd broken.png\n");
  EXPECT_THAT(complaint("a.obj", box_.obj("mtllib box.mtl\nusemtl wood\n")),
              AllOf(HasSubstr("broken.png"), HasSubstr("neither PNG nor JPEG")));
}

}  // namespace
}  // namespace onestroke

// STL, OBJ and PLY.
#include "core/error.h"
#include "gltf_file.h"
#include "mesh_text.h"
#include "scene/model.h"

#include <gmock/gmock.h>
#include <stb/stb_image_write.h>

#include <cmath>

namespace onestroke {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::Not;

auto near3(float x, float y, float z) {
  return ElementsAre(FloatNear(x, 1e-6F), FloatNear(y, 1e-6F), FloatNear(z, 1e-6F));
}

class MeshFile : public testing::Test {
 protected:
  Model load(const std::string& name, const std::string& bytes, const ModelImport& import = {}) {
    return load_model(folder_.write(name, bytes), import);
  }
  std::string complaint(const std::string& name, const std::string& bytes) {
    try {
      load(name, bytes);
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(name), Not(HasSubstr("\n"))));
      return e.what();
    }
    return "no complaint";
  }
  void write_png(const std::string& name, int width) {
    const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * width), 200);
    ASSERT_TRUE(stbi_write_png((folder_.path() / name).c_str(), width, 1, 3, pixels.data(), 3 * width));
  }

  // The box has hard edges, so three vertices at each corner, and normals along the axes, outwards.
  static void expect_box(const Model& m, const std::array<float, 3>& lower, const std::array<float, 3>& upper) {
    EXPECT_EQ(m.indices.size(), 36U);
    EXPECT_EQ(m.vertices.size(), 24U);
    EXPECT_THAT(m.lower, near3(lower[0], lower[1], lower[2]));
    EXPECT_THAT(m.upper, near3(upper[0], upper[1], upper[2]));
    for (const ModelVertex& v : m.vertices) {
      float along = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const float middle = (lower[k] + upper[k]) / 2;
        along += v.normal[k] * (v.position[k] - middle) / (upper[k] - middle);
      }
      EXPECT_NEAR(along, 1, 1e-4);
      EXPECT_NEAR(std::hypot(v.tangent[0], v.tangent[1], v.tangent[2]), 1, 1e-5);
    }
  }

  const BoxMesh box_;
  TemporaryFolder folder_;
};

TEST_F(MeshFile, EveryFormIsTheSameBoxUprightAndInMetres) {
  // z up: the 20 mm are the height, and what was the back is now behind.
  for (const auto& [name, bytes] : {std::pair{"a.stl", box_.ascii_stl()}, std::pair{"b.STL", box_.binary_stl()},
                                    std::pair{"c.ply", box_.ascii_ply()}, std::pair{"d.ply", box_.binary_ply()},
                                    std::pair{"e.ply", box_.binary_ply(true)}}) {
    SCOPED_TRACE(name);
    expect_box(load(name, bytes), {0, 0, -0.04F}, {0.06F, 0.02F, 0});
  }
  const Model obj = load("f.obj", box_.obj());
  expect_box(obj, {0, 0, 0}, {0.06F, 0.04F, 0.02F});
  EXPECT_EQ(obj.name, "f");
}

TEST_F(MeshFile, UnitAndUpAxisAreAsSaid) {
  expect_box(load("a.stl", box_.binary_stl(), {.unit = LengthUnit::metre, .up = UpAxis::y}), {0, 0, 0}, {60, 40, 20});
  expect_box(load("a.stl", box_.binary_stl(), {.unit = LengthUnit::inch}), {0, 0, -1.016F}, {1.524F, 0.508F, 0});
  expect_box(load("a.obj", box_.obj(), {.unit = LengthUnit::centimetre, .up = UpAxis::x}), {-0.4F, 0, 0},
             {0, 0.6F, 0.2F});
  const Model gltf = load("a.glb", square().glb(), {.unit = LengthUnit::foot, .up = UpAxis::z});
  EXPECT_THAT(gltf.upper, near3(0.3048F, 0, 0));
  EXPECT_THAT(gltf.lower, near3(0, 0, -0.3048F));
  EXPECT_THAT(gltf.vertices[0].normal, near3(0, 1, 0));
}

TEST_F(MeshFile, WhatAFileIsDoesNotHangOnItsNameAlone) {
  expect_box(load("really_ply.stl", box_.binary_ply()), {0, 0, -0.04F}, {0.06F, 0.02F, 0});
  EXPECT_EQ(load("really_gltf.obj", square().glb()).indices.size(), 6U);
  EXPECT_THAT(complaint("a.fbx", "Kaydara"), HasSubstr("give a .glb, .gltf, .stl, .obj or .ply file"));
  EXPECT_THAT(complaint("a.ply", "solid"), HasSubstr("not a PLY file"));
  EXPECT_THAT(complaint("a.stl", "<html>"), HasSubstr("not an STL file"));
  EXPECT_THAT(complaint("a.obj", "<html></html> and more of it"), HasSubstr("not an OBJ file"));
}

TEST_F(MeshFile, LinesEndAsTheyLike) {
  const auto with_ends = [](std::string text, const std::string& end) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size()))
      text.replace(at, 1, end);
    return text;
  };
  expect_box(load("a.obj", with_ends(box_.obj(), "\r\n")), {0, 0, 0}, {0.06F, 0.04F, 0.02F});
  expect_box(load("b.obj", with_ends(box_.obj(), "\r")), {0, 0, 0}, {0.06F, 0.04F, 0.02F});
  expect_box(load("a.stl", with_ends(box_.ascii_stl(), "\r\n")), {0, 0, -0.04F}, {0.06F, 0.02F, 0});
  expect_box(load("a.ply", with_ends(box_.ascii_ply(), "\r\n")), {0, 0, -0.04F}, {0.06F, 0.02F, 0});
}

// The first number's first byte may be any, those that end a line in text too.
TEST_F(MeshFile, BinaryPlyMayBeginWithAnyByte) {
  for (const bool windows : {false, true})
    for (int first = 0; first < 256; ++first) {
      SCOPED_TRACE(first);
      std::string header = BoxMesh::ply_header("binary_little_endian", 8, 12), whole = box_.binary_ply();
      const std::string body = whole.substr(header.size());
      for (std::size_t at = header.find('\n'); windows && at != std::string::npos; at = header.find('\n', at + 2))
        header.replace(at, 1, "\r\n");
      whole = header + body;
      whole[header.size()] = static_cast<char>(first);
      EXPECT_EQ(load("a.ply", whole).indices.size(), 36U);
    }
}

TEST_F(MeshFile, StlOfManyMakersIsRead) {
  const std::array<float, 3> lower{0, 0, -0.04F}, upper{0.06F, 0.02F, 0};
  expect_box(load("solid.stl", box_.binary_stl("solid as binary files should not begin")), lower, upper);
  expect_box(load("trailing.stl", box_.binary_stl() + "and a remark"), lower, upper);
  std::string loud = box_.ascii_stl();
  std::transform(loud.begin(), loud.end(), loud.begin(), [](unsigned char c) { return std::toupper(c); });
  expect_box(load("loud.stl", loud), lower, upper);
  std::string named = box_.ascii_stl();
  named.insert(named.find("box"), "Gehäuse ");
  expect_box(load("named.stl", "\xEF\xBB\xBF\r\n" + named), lower, upper);
}

TEST_F(MeshFile, PartsWithoutTrianglesAndRemarksAreNoHindrance) {
  EXPECT_EQ(load("a.stl", box_.ascii_stl() + "solid none\nendsolid none\n").indices.size(), 36U);
  std::string remarked = box_.ascii_ply();
  remarked.insert(remarked.find("element"), "Created by hand\ncomment so it is\nobj_info 3\n");
  EXPECT_EQ(load("a.ply", remarked).indices.size(), 36U);
}

TEST_F(MeshFile, CutShortFilesSaySo) {
  for (const auto& [name, bytes] : {std::pair{"a.stl", box_.ascii_stl()}, std::pair{"b.stl", box_.binary_stl()},
                                    std::pair{"c.ply", box_.binary_ply()}})
    EXPECT_THAT(complaint(name, bytes.substr(0, bytes.size() - 30)), HasSubstr("cut short"));
  EXPECT_THAT(complaint("d.ply", box_.ascii_ply().substr(0, 300)), HasSubstr("d.ply"));
}

TEST_F(MeshFile, NothingToSeeIsAnError) {
  EXPECT_THAT(complaint("a.ply", BoxMesh::ply_header("ascii", 1, 0) + "0 0 0\n"), HasSubstr("cloud of points"));
  EXPECT_THAT(complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\n"), HasSubstr("no faces"));
  EXPECT_THAT(complaint("b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("no triangles"));
  std::string none = box_.binary_stl().substr(0, 84);
  none[80] = 0;
  EXPECT_THAT(complaint("a.stl", none), HasSubstr("no triangles"));
}

TEST_F(MeshFile, NumbersMustBeFinite) {
  for (const std::string bad : {"nan", "inf", "-inf", "1e39"}) {
    SCOPED_TRACE(bad);
    std::string stl = box_.ascii_stl();
    stl.replace(stl.find("60 40 0"), 2, bad);
    EXPECT_NE(complaint("a.stl", stl), "no complaint");
    std::string ply = box_.ascii_ply();
    ply.replace(ply.find("60 40 0"), 2, bad);
    EXPECT_NE(complaint("a.ply", ply), "no complaint");
    std::string obj = box_.obj();
    obj.replace(obj.find("60 40 0"), 2, bad);
    EXPECT_NE(complaint("a.obj", obj), "no complaint");
  }
  std::string binary = box_.binary_stl();
  binary.replace(84 + 12, 4, std::string("\0\0\xC0\x7F", 4));
  EXPECT_THAT(complaint("b.stl", binary), HasSubstr("not finite"));
}

TEST_F(MeshFile, TrianglesWithoutAreaAreDropped) {
  EXPECT_EQ(load("a.obj", box_.obj() + "f 1 1 2\nf 3 3 3\n").indices.size(), 36U);
  const std::string with_normals = "vn 0 0 1\nf 1//1 1//1 2//1\nf 1//1 2//1 4//1\n";
  EXPECT_EQ(load("b.obj", box_.obj().substr(0, box_.obj().find('f')) + with_normals).indices.size(), 3U);
}

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

TEST_F(MeshFile, PlyColoursAreKeptInLinearLight) {
  const std::string more = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const Model m = load("a.ply", BoxMesh::ply_header("ascii", 3, 1, more) +
                                    "0 0 0 255 0 188\n1 0 0 255 0 188\n1 1 0 255 0 188\n3 0 1 2\n");
  for (const ModelVertex& v : m.vertices) {
    EXPECT_FLOAT_EQ(v.color[0], 1);
    EXPECT_FLOAT_EQ(v.color[1], 0);
    EXPECT_NEAR(v.color[2], 0.5F, 0.01F);
  }
  const ModelMaterial& material = m.materials[static_cast<std::size_t>(m.parts[0].material)];
  EXPECT_EQ(material.base_color, (std::array{1.0F, 1.0F, 1.0F, 1.0F}));
  EXPECT_TRUE(material.double_sided);
}

TEST_F(MeshFile, DamagedPlyIsRefusedByWhatIsWrong) {
  const std::string body = "0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n", good = BoxMesh::ply_header("ascii", 3, 1) + body;
  EXPECT_EQ(load("a.ply", good).indices.size(), 3U);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    return complaint("a.ply", bytes);
  };
  EXPECT_THAT(changed("vertex 3", "vertex 4000000000"), HasSubstr("4000000000"));
  EXPECT_THAT(changed("vertex 3", "vertex -3"), HasSubstr("-3"));
  EXPECT_THAT(changed("float z", "real z"), HasSubstr("real"));
  EXPECT_THAT(changed("float z", "float w"), HasSubstr("no x, y and z"));
  EXPECT_THAT(changed("ascii", "latin"), HasSubstr("latin"));
  EXPECT_THAT(changed("1 0 0", "1 0"), HasSubstr("too few numbers"));
  EXPECT_THAT(changed("1 0 0", "1 o 0"), HasSubstr("\"o\""));
  EXPECT_THAT(changed("3 0 1 2", "3 0 1 3"), HasSubstr("not there"));
  EXPECT_THAT(changed("3 0 1 2", "9 0 1 2"), HasSubstr("too few numbers"));
  EXPECT_THAT(changed("vertex_indices", "colours"), HasSubstr("name no vertices"));
}

TEST_F(MeshFile, TellsHowFarItIsAndCanBeLeftOff) {
  for (const auto& [name, bytes] : {std::pair{"a.stl", box_.binary_stl()}, std::pair{"b.obj", box_.obj()},
                                    std::pair{"c.ply", box_.binary_ply()}, std::pair{"d.glb", square().glb()}}) {
    SCOPED_TRACE(name);
    const auto file = folder_.write(name, bytes);
    double last = 0;
    int calls = 0;
    load_model(file, {}, [&](double share) {
      EXPECT_GE(share, last);
      last = share;
      ++calls;
    });
    EXPECT_EQ(last, 1);
    EXPECT_GE(calls, 2);
    for (int at = 1; at <= calls; ++at) {
      struct Enough {};
      int said = 0;
      EXPECT_THROW(load_model(file, {},
                              [&](double) {
                                if (++said == at) throw Enough{};
                              }),
                   Enough);
    }
  }
}

}  // namespace
}  // namespace onestroke

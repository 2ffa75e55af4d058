// STL, PLY, and what they and OBJ have in common.
#include "mesh_fixture.h"

namespace onestroke {
namespace {

using testing::HasSubstr;

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

#include "core/error.h"
#include "gltf_file.h"
#include "scene/model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace onestroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BrokenModel : public testing::Test {
 protected:
  std::string complaint(const std::filesystem::path& file) {
    try {
      load_model(file);
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(file.filename().string()), Not(HasSubstr("\n"))));
      return e.what();
    }
    return "no complaint";
  }
  std::string complaint(const std::string& bytes) { return complaint(folder_.write("bad.glb", bytes)); }
  std::string complaint(const std::function<void(GltfFile&)>& damage) {
    GltfFile f = square();
    damage(f);
    return complaint(f.glb());
  }

  TemporaryFolder folder_;
};

TEST_F(BrokenModel, SaysWhichFileIsMissing) {
  EXPECT_THAT(complaint(folder_.path() / "none.glb"), HasSubstr("no such model file"));
  EXPECT_THAT(complaint(folder_.path()), HasSubstr("no such model file"));
}

TEST_F(BrokenModel, SaysThatAFileIsNotGltf) {
  EXPECT_THAT(complaint(std::string()), HasSubstr("not a glTF file"));
  EXPECT_THAT(complaint(std::string("solid cube\n facet normal 0 0 1\n")), HasSubstr("not a glTF file"));
  EXPECT_THAT(complaint(std::string("{\"a\": ")), HasSubstr("not a whole glTF file"));
  EXPECT_THAT(complaint(std::string("{}")), Not(HasSubstr("no complaint")));
}

TEST_F(BrokenModel, EveryTruncationIsAnError) {
  const std::string whole = square().glb();
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_NE(complaint(whole.substr(0, n)), "no complaint") << n << " bytes of " << whole.size();
}

TEST_F(BrokenModel, AnOldVersionAndAnUnknownExtensionAreNamed) {
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["asset"]["version"] = "1.0"; }), HasSubstr("version 1.0"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
              HasSubstr("KHR_draco_mesh_compression"));
}

TEST_F(BrokenModel, EndlessNestingIsRefused) {
  const std::string deep = std::string(2000000, '[');
  const std::string head = "{\"asset\":{\"version\":\"2.0\",\"extras\":";
  EXPECT_THAT(complaint(folder_.write("bad.gltf", head + deep)), HasSubstr("nested too deep"));
  EXPECT_THAT(complaint(folder_.write("bad.gltf", head + deep + std::string(deep.size(), ']') + "}}")),
              HasSubstr("nested too deep"));
  EXPECT_THAT(complaint([&](GltfFile& f) {
                nlohmann::json nested;
                for (int i = 0; i < 1000; ++i) nested = {nested};
                f.json["extras"] = nested;
              }),
              HasSubstr("nested too deep"));
  EXPECT_EQ(complaint([](GltfFile& f) { f.json["asset"]["generator"] = std::string(500, '[') + "\"\\"; }),
            "no complaint");
}

TEST_F(BrokenModel, NoTrianglesIsAnError) {
  EXPECT_THAT(complaint([](GltfFile& f) { f.primitive()["mode"] = 1; }), HasSubstr("no triangles"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["nodes"] = {{{"name", "empty"}}}; }), HasSubstr("no triangles"));
  EXPECT_THAT(complaint([](GltfFile& f) {
                f.primitive()["indices"] = f.add_shorts({0, 0, 0});
              }),
              HasSubstr("no triangles"));
}

TEST_F(BrokenModel, MissingFilesBesideTheModelAreNamed) {
  GltfFile f = square();
  f.json["buffers"] = {{{"byteLength", f.data.size()}, {"uri", "gone.bin"}}};
  EXPECT_THAT(complaint(folder_.write("bad.gltf", f.json.dump())), HasSubstr("gone.bin"));
  EXPECT_THAT(complaint([](GltfFile& g) {
                g.json["images"] = {{{"uri", "gone.png"}}};
                g.json["textures"] = {{{"source", 0}}};
                g.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
              }),
              HasSubstr("gone.png"));
}

TEST_F(BrokenModel, ABufferShorterThanItSaysIsAnError) {
  GltfFile f = square();
  f.json["buffers"] = {{{"byteLength", f.data.size()}, {"uri", "short.bin"}}};
  folder_.write("short.bin", f.data.substr(0, 8));
  EXPECT_NE(complaint(folder_.write("bad.gltf", f.json.dump())), "no complaint");
}

TEST_F(BrokenModel, BadIndicesAreErrors) {
  const auto names_vertex = HasSubstr("names a vertex that is not there");
  EXPECT_THAT(complaint([](GltfFile& f) { f.primitive()["indices"] = f.add_shorts({0, 1, 4}); }), names_vertex);
  EXPECT_THAT(complaint([](GltfFile& f) { f.primitive()["attributes"]["POSITION"] = 7; }),
              HasSubstr("accessor 7 is missing"));
  EXPECT_NE(complaint([](GltfFile& f) { f.primitive()["indices"] = 7; }), "no complaint");
  EXPECT_NE(complaint([](GltfFile& f) { f.primitive()["indices"] = f.add_floats({0, 1, 2}, 1); }), "no complaint");
  EXPECT_THAT(complaint([](GltfFile& f) { f.primitive()["material"] = 3; }), HasSubstr("material 3 is missing"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["nodes"][0]["mesh"] = 5; }), HasSubstr("mesh 5 is missing"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["scenes"][0]["nodes"] = {9}; }), HasSubstr("node 9 is missing"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["scene"] = 4; }), HasSubstr("default scene"));
}

TEST_F(BrokenModel, AccessorsThatLeaveTheirBufferAreErrors) {
  const auto past = HasSubstr("reaches past the end");
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["accessors"][0]["count"] = 5; }), past);
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 4; }), past);
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 100000; }), past);
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 100000; }), past);
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["accessors"][0]["count"] = 4000000000U; }),
              HasSubstr("4000000000 elements"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["accessors"][0]["bufferView"] = 12; }), HasSubstr("12 is missing"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["accessors"][0].erase("bufferView"); }), HasSubstr("has no data"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 3; }), HasSubstr("buffer"));
}

TEST_F(BrokenModel, ASparsePartMustStayInside) {
  const auto sparse = [](std::uint16_t where, int count) {
    return [=](GltfFile& f) {
      f.json["accessors"][0]["sparse"] = {
          {"count", count},
          {"indices", {{"bufferView", f.add_view<std::uint16_t>({where})}, {"componentType", 5123}}},
          {"values", {{"bufferView", f.add_view<float>({1, 5, 0})}}}};
    };
  };
  EXPECT_THAT(complaint(sparse(4, 1)), HasSubstr("not there"));
  EXPECT_THAT(complaint(sparse(1, 3)), HasSubstr("reaches past the end"));
  EXPECT_NE(complaint(sparse(1, -1)), "no complaint");
}

TEST_F(BrokenModel, ARingOfNodesIsAnError) {
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["nodes"][0]["children"] = {0}; }), HasSubstr("two parents"));
}

TEST_F(BrokenModel, PositionsMustBeFinite) {
  EXPECT_THAT(complaint([](GltfFile& f) {
                const float bad = std::numeric_limits<float>::quiet_NaN();
                f.primitive()["attributes"]["POSITION"] = f.add_floats({0, 0, 0, 1, 0, 0, 1, bad, 0, 0, 1, 0}, 3);
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(complaint([](GltfFile& f) { f.json["nodes"][0]["scale"] = {1e300, 1, 1}; }), HasSubstr("infinity"));
}

TEST_F(BrokenModel, DamagedImagesAreErrors) {
  EXPECT_THAT(complaint([](GltfFile& f) {
                f.json["images"] = {{{"bufferView", f.add_view<std::uint8_t>({1, 2, 3})}, {"mimeType", "image/png"}}};
                f.json["textures"] = {{{"source", 0}}};
                f.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
              }),
              HasSubstr("neither PNG nor JPEG"));
}

// Whatever a byte turns into, the file loads or is refused; a crash would end this test.
TEST_F(BrokenModel, RandomDamageIsSurvived) {
  std::mt19937 random(7);
  const std::string whole = square().glb();
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string bytes = whole;
    const auto changes = 1 + random() % 4;
    for (unsigned i = 0; i < changes; ++i) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    try {
      load_model(folder_.write("bad.glb", bytes));
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 4000);
}

// As above for the values of the JSON, which random bytes seldom reach: every number becomes extreme in turn.
TEST_F(BrokenModel, ExtremeNumbersAreSurvived) {
  const GltfFile f = square();
  const nlohmann::json flat = f.json.flatten();
  const nlohmann::json extremes = {-1, 0, 1, 3, 255, 2147483647, -2147483648LL, 4294967295U, 1e30, "x", nullptr, {{}}};
  int tried = 0;
  for (const auto& [key, value] : flat.items()) {
    if (!value.is_number()) continue;
    for (const nlohmann::json& extreme : extremes) {
      GltfFile changed = f;
      changed.json[nlohmann::json::json_pointer(key)] = extreme;
      ++tried;
      try {
        load_model(folder_.write("bad.glb", changed.glb()));
      } catch (const Error&) {
        continue;
      }
    }
  }
  EXPECT_GT(tried, 100);
}

}  // namespace
}  // namespace onestroke

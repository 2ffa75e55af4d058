// Whatever a file's bytes turn into, it loads or is refused with its name; a crash or a hang would end this test.
#include "core/error.h"
#include "gltf_file.h"
#include "mesh_text.h"
#include "scene/model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace onestroke {
namespace {

struct Format {
  const char* name;
  std::string (*bytes)();
};

class MeshDamage : public testing::TestWithParam<Format> {
 protected:
  // True where it loads; what is loaded is sound.
  bool loads(const std::string& bytes) {
    const auto file = folder_.write(GetParam().name, bytes);
    try {
      const Model m = load_model(file);
      EXPECT_FALSE(m.indices.empty());
      for (const std::uint32_t i : m.indices) EXPECT_LT(i, m.vertices.size());
      for (const ModelVertex& v : m.vertices) {
        EXPECT_TRUE(std::isfinite(v.position[0]) && std::isfinite(v.position[1]) && std::isfinite(v.position[2]));
        EXPECT_NEAR(std::hypot(v.normal[0], v.normal[1], v.normal[2]), 1, 1e-3);
        for (const float c : v.color) EXPECT_TRUE(c >= 0 && c <= 1);
        EXPECT_TRUE(std::isfinite(v.uv[0]) && std::isfinite(v.uv[1]));
      }
      return true;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(file.filename().string()));
      return false;
    }
  }

  TemporaryFolder folder_;
};

TEST_P(MeshDamage, EveryTruncationIsSurvived) {
  const std::string whole = GetParam().bytes();
  ASSERT_TRUE(loads(whole));
  int refused = 0;
  const std::size_t step = whole.size() / 500 + 1;
  for (std::size_t size = 0; size < whole.size(); size += step) refused += loads(whole.substr(0, size)) ? 0 : 1;
  EXPECT_GT(refused, 50);
}

TEST_P(MeshDamage, ChangedBytesAreSurvived) {
  const std::string whole = GetParam().bytes();
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string bytes = whole;
    for (unsigned i = random() % 4; i < 4; ++i) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    refused += loads(bytes) ? 0 : 1;
  }
  EXPECT_GT(refused, 30);
}

TEST_P(MeshDamage, LostAndRepeatedPiecesAreSurvived) {
  const std::string whole = GetParam().bytes();
  std::mt19937 random(11);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    const std::size_t at = random() % bytes.size(), size = random() % 40;
    if (round % 2 == 0)
      bytes.erase(at, size);
    else
      bytes.insert(random() % bytes.size(), whole.substr(at, size));
    refused += loads(bytes) ? 0 : 1;
  }
  EXPECT_GT(refused, 30);
}

// An OBJ that says a bit of everything.
std::string rich_obj() {
  return "mtllib none.mtl\no box\nvt 0 0\nvt 1 1\nvn 0 0 1\n" + BoxMesh().obj("g side\ns 1\nusemtl wood\n") +
         "f 1/1/1 2/2/1 4/1/1 3/2/1\nf -1//1 -2//1 -3//1\nl 1 2\np 3\n# end\n";
}

INSTANTIATE_TEST_SUITE_P(All, MeshDamage,
                         testing::Values(Format{"ascii.stl", [] { return BoxMesh().ascii_stl(); }},
                                         Format{"binary.stl", [] { return BoxMesh().binary_stl(); }},
                                         Format{"rich.obj", rich_obj},
                                         Format{"ascii.ply", [] { return BoxMesh().ascii_ply(); }},
                                         Format{"little.ply", [] { return BoxMesh().binary_ply(); }},
                                         Format{"big.ply", [] { return BoxMesh().binary_ply(true); }}),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           name[name.find('.')] = '_';
                           return name;
                         });

}  // namespace
}  // namespace onestroke

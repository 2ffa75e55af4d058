#pragma once

#include "core/error.h"
#include "gltf_file.h"
#include "mesh_text.h"
#include "scene/model.h"

#include <gmock/gmock.h>
#include <stb/stb_image_write.h>

#include <cmath>

namespace onestroke {

inline auto near3(float x, float y, float z) {
  return testing::ElementsAre(testing::FloatNear(x, 1e-6F), testing::FloatNear(y, 1e-6F), testing::FloatNear(z, 1e-6F));
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
      EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr(name), testing::Not(testing::HasSubstr("\n"))));
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

}  // namespace onestroke

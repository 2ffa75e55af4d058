// The models that Assimp is tested with, of many makers and some broken on purpose: each is drawn, or refused with a
// clear word.
#include "core/error.h"
#include "core/lower_case.h"
#include "golden/stage.h"
#include "scene/anchor.h"
#include "scene/mesh_levels.h"

#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <set>

namespace onestroke::golden {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const fs::path models = "/usr/share/assimp/models";

std::vector<fs::path> model_files() {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(models, missing)) {
    const std::string extension = lower_case(entry.path().extension().string());
    if (std::set<std::string>{".gltf", ".glb", ".stl", ".obj", ".ply"}.contains(extension))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class ManyModels : public Stage {
 protected:
  Picture picture_of(const Model& model, ModelHandle handle) {
    // From half a metre away, turned a little, so that flat models are seen too.
    const Placement placement = place_on_marker(model, 150);
    const glm::vec3 middle(0.001F * static_cast<float>(placement.pivot.x),
                           -0.001F * static_cast<float>(placement.pivot.y), 0);
    const Matrix4 seen = placed(0, 0, -0.5F, 0.5F, 0.6F);
    glm::mat4 m = glm::make_mat4(seen.data());
    m[3] -= m * glm::vec4(middle, 0);
    m = m * placement.marker_graphics_from_model;
    ModelInstance instance{.model = handle};
    std::copy_n(glm::value_ptr(m), 16, instance.world_graphics_from_model.begin());
    return draw({.background = {0.2F, 0.0F, 0.3F, 1}, .instances = {&instance, 1}});
  }
};

TEST_F(ManyModels, AreDrawnOrRefused) {
  const std::vector<fs::path> files = model_files();
  if (files.empty()) GTEST_SKIP() << models << " is missing; install the package assimp-testmodels";
  const Picture empty = draw({.background = {0.2F, 0.0F, 0.3F, 1}});
  int drawn = 0, refused = 0;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const auto start = std::chrono::steady_clock::now();
    try {
      Model model = load_model(file);
      add_levels(model);
      const ModelHandle handle = renderer->load(model);
      EXPECT_FALSE(compare(empty, picture_of(model, handle), {.level = 4, .pixels = 20}).same) << "nothing to see";
      renderer->unload(handle);
      ++drawn;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(file.filename().string()), Not(HasSubstr("\n"))));
      std::cout << "refused: " << fs::relative(file, models).string()
                << std::string(error.what()).substr(file.string().size()) << '\n';
      ++refused;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  }
  std::cout << drawn << " drawn, " << refused << " refused\n";
  EXPECT_EQ(drawn + refused, static_cast<int>(files.size()));
  EXPECT_GE(drawn, 58);
}

}  // namespace
}  // namespace onestroke::golden

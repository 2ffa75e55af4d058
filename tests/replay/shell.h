#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace onestroke {

struct Ended {
  int code = -1;
  std::string out, err;
};

/// Runs the built program in a folder of the test's own.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "onestroke-program-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// As a shell would, without a desktop and under Vulkan's validation.
  Ended run(const std::string& arguments, const std::string& before = "") const {
    const std::string command =
        "cd " + folder.string() + " && " + before +
        " env -u DISPLAY -u WAYLAND_DISPLAY ONESTROKE_VALIDATION=1 XDG_CACHE_HOME=" + cache.string() +
        " " ONESTROKE_PROGRAM " " + arguments + " >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("err.txt")};
  }

  std::string read(const std::string& name) const {
    std::ifstream in(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

  std::filesystem::path folder;
  /// What the program, and the GPU's driver, compile once; not the user's own.
  std::filesystem::path cache = ONESTROKE_CACHE_DIR;
};

inline const std::string demo_catalog = ONESTROKE_SOURCE_DIR "/assets/catalog.json";

}  // namespace onestroke

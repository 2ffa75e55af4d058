#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace onestroke {

/// Writes small glTF files, whole or broken on purpose: fill `json` and `data`, then save.
class GltfFile {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", {0}}}}},
                         {"nodes", {{{"mesh", 0}}}},
                         {"meshes", {{{"primitives", nlohmann::json::array()}}}},
                         {"accessors", nlohmann::json::array()},
                         {"bufferViews", nlohmann::json::array()}};
  std::string data;

  template <class T>
  int add_view(const std::vector<T>& numbers) {
    const std::size_t offset = data.size();
    data.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
    const std::size_t length = data.size() - offset;
    data.resize((data.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int add_accessor(const std::vector<T>& numbers, int component_type, const std::string& type, int width) {
    const int view = add_view(numbers);
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", numbers.size() / static_cast<std::size_t>(width)},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  int add_floats(const std::vector<float>& numbers, int width) {
    return add_accessor(numbers, 5126, width == 1 ? "SCALAR" : "VEC" + std::to_string(width), width);
  }
  int add_shorts(const std::vector<std::uint16_t>& numbers) { return add_accessor(numbers, 5123, "SCALAR", 1); }

  nlohmann::json& primitive(std::size_t i = 0) { return json["meshes"][0]["primitives"][i]; }

  std::string glb() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", data.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    append(out, {2, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + data.size()),
                 static_cast<std::uint32_t>(text.size())});
    out += "JSON" + text;
    append(out, {static_cast<std::uint32_t>(data.size())});
    return out + std::string("BIN\0", 4) + data;
  }

 private:
  static void append(std::string& out, std::initializer_list<std::uint32_t> numbers) {
    for (const std::uint32_t n : numbers) out.append(reinterpret_cast<const char*>(&n), 4);
  }
};

/// A folder that lives as long as the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "onestroke-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A square in the plane z = 0 that faces +z: corners (0,0), (1,0), (1,1), (0,1), two triangles, normals left out.
inline GltfFile square() {
  GltfFile f;
  const int position = f.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
  const int indices = f.add_shorts({0, 1, 2, 0, 2, 3});
  f.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
  return f;
}

}  // namespace onestroke

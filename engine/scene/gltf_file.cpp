#include "scene/gltf_file.h"

#include "core/error.h"
#include "scene/file_bytes.h"
#include "scene/gltf_geometry.h"
#include "scene/gltf_materials.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <set>
#include <string_view>

namespace onestroke {

namespace {

// tinygltf's length check of the last chunk leaves out its 8-byte header; this much beyond the end keeps it in bounds.
constexpr std::size_t slack = 16;

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return "it is damaged";
  return text.substr(begin, text.find('\n', begin) - begin);
}

// tinygltf reads nested values by recursion; no real file nests this deep.
constexpr int deepest = 200;

bool nested_too_deep(std::string_view json) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

// The JSON of either form; of a .glb it is the first chunk, behind five words, the fourth of which is its length.
std::string_view json_of(const Bytes& bytes, bool binary) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!binary) return all;
  constexpr std::size_t words = 5 * sizeof(std::uint32_t);
  if (all.size() < words) return {};
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 3 * sizeof length, sizeof length);
  return all.substr(words, length);
}

// Only files beside the model: tinygltf alone would also look in the working directory and expand shell variables.
tinygltf::FsCallbacks files_under(const std::string& folder) {
  tinygltf::FsCallbacks calls{};
  calls.FileExists = [](const std::string& path, void* user) {
    std::error_code ignored;
    return path.starts_with(*static_cast<const std::string*>(user)) && std::filesystem::is_regular_file(path, ignored);
  };
  calls.ExpandFilePath = [](const std::string& path, void*) { return path; };
  calls.ReadWholeFile = [](Bytes* out, std::string* error, const std::string& path, void*) {
    const bool read = read_bytes(path, *out);
    if (!read && error) *error += "cannot be read";
    return read;
  };
  calls.user_data = const_cast<std::string*>(&folder);
  return calls;
}

void refuse_unknown_extensions(const tinygltf::Model& gltf, const std::string& name) {
  static const std::set<std::string> known{"KHR_mesh_quantization", "KHR_materials_emissive_strength"};
  for (const std::string& extension : gltf.extensionsRequired)
    if (!known.contains(extension))
      throw Error(name + ": needs the extension " + extension + "; export the model without it");
}

tinygltf::Model parse(const std::filesystem::path& file, Bytes bytes) {
  const std::string name = file.string();
  const std::string folder = std::filesystem::absolute(file).parent_path().string();
  const auto text = std::find_if_not(bytes.begin(), bytes.end(), [](unsigned char c) { return std::isspace(c) != 0; });
  const bool binary = bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
  if (!binary && (text == bytes.end() || *text != '{'))
    throw Error(name + ": not a glTF file; give a .glb or .gltf model");
  if (bytes.size() > std::numeric_limits<unsigned>::max())
    throw Error(name + ": larger than 4 GB; use a smaller model");
  if (nested_too_deep(json_of(bytes, binary))) throw Error(name + ": nested too deep; export the model again");
  const auto size = static_cast<unsigned>(bytes.size());
  bytes.resize(bytes.size() + slack, 0);

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded_image, nullptr);
  loader.SetFsCallbacks(files_under(folder));
  tinygltf::Model model;
  std::string error, warning;
  bool sound = false;
  try {
    sound = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                   : loader.LoadASCIIFromString(&model, &error, &warning, reinterpret_cast<const char*>(bytes.data()),
                                                size, folder);
  } catch (const std::exception& e) {
    error += e.what();
  }
  // What the parser stumbles over may be what the extension would have explained.
  refuse_unknown_extensions(model, name);
  if (!sound) throw Error(name + ": not a whole glTF file (" + first_line(error) + "); export the model again");
  return model;
}

}  // namespace

void read_gltf(const std::filesystem::path& file, Bytes bytes, Model& model) {
  const std::string name = file.string();
  const tinygltf::Model gltf = parse(file, std::move(bytes));
  if (!gltf.asset.version.starts_with("2."))
    throw Error(name + ": glTF version " + gltf.asset.version + "; export the model as glTF 2.0");
  const GltfReader reader(gltf, name);
  read_materials(reader, model);
  read_geometry(reader, model);
}

}  // namespace onestroke

#include "scene/mesh_file.h"

#include "core/error.h"
#include "scene/mesh_import.h"
#include "scene/ply_layout.h"
#include "scene/stl_layout.h"

#include <algorithm>
#include <string_view>

namespace onestroke {

namespace {

// Lines may end as in Windows, or as in the Macs of old, which nobody else can read.
void end_lines_alike(Bytes& bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n')) bytes[i] = '\n';
}

// Text files of Windows may be UTF-16, with a mark that says which half of a letter comes first.
void make_utf8(Bytes& bytes) {
  const auto at = [&](std::size_t i) { return i < bytes.size() ? bytes[i] : 0U; };
  if (at(0) == 0xEF && at(1) == 0xBB && at(2) == 0xBF) bytes.erase(bytes.begin(), bytes.begin() + 3);
  const bool little = at(0) == 0xFF && at(1) == 0xFE, big = at(0) == 0xFE && at(1) == 0xFF;
  if (!little && !big) return;
  // What a model file says is ASCII; letters of names become question marks.
  Bytes narrow;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const unsigned unit = little ? at(i) | at(i + 1) << 8U : at(i) << 8U | at(i + 1);
    narrow.push_back(static_cast<unsigned char>(unit < 0x80 ? unit : '?'));
  }
  bytes = std::move(narrow);
}

void refuse_without_faces(const std::filesystem::path& file, const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bool points = false, faces = false;
  for (std::size_t line = 0; line < text.size() && !faces;) {
    const std::size_t start = std::min(text.find_first_not_of(" \t\r\n", line), text.size());
    const std::string_view word = text.substr(start, 2);
    faces = word == "f " || word == "f\t";
    points = points || word == "v " || word == "v\t";
    line = std::min(text.find('\n', start), text.size() - 1) + 1;
  }
  if (faces) return;
  throw Error(file.string() + (points ? ": it has points or lines but no faces; export it as a surface"
                                      : ": not an OBJ file; export the model again"));
}

}  // namespace

void read_stl(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model) {
  prepare_stl(file.string(), bytes);
  // A facet's own normal is flat, and often wrong.
  import_mesh(file, std::move(bytes), {.extension = ".stl", .keeps_normals = false}, progress, model);
}

void read_obj(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model) {
  make_utf8(bytes);
  end_lines_alike(bytes);
  if (std::find(bytes.begin(), bytes.end(), 0) != bytes.end())
    throw Error(file.string() + ": not an OBJ file, which is text; export the model again");
  refuse_without_faces(file, bytes);
  import_mesh(file, std::move(bytes), {.extension = ".obj"}, progress, model);
}

void read_ply(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model) {
  prepare_ply(file.string(), bytes);
  import_mesh(file, std::move(bytes), {.extension = ".ply"}, progress, model);
}

}  // namespace onestroke

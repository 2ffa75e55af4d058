#include "scene/model.h"

#include "core/error.h"
#include "core/lower_case.h"
#include "scene/file_bytes.h"
#include "scene/gltf_file.h"
#include "scene/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

namespace onestroke {

namespace {

enum class Kind { gltf, stl, obj, ply, unknown };

// By the first bytes where a format has some of its own, otherwise by the file's name.
Kind kind_of(const std::filesystem::path& file, const Bytes& bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 4));
  if (start == "glTF") return Kind::gltf;
  if (start == "ply\n" || start == "ply\r") return Kind::ply;
  const std::string extension = lower_case(file.extension().string());
  if (extension == ".gltf" || extension == ".glb") return Kind::gltf;
  if (extension == ".stl") return Kind::stl;
  if (extension == ".obj") return Kind::obj;
  if (extension == ".ply") return Kind::ply;
  return Kind::unknown;
}

void read(Kind kind, const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model) {
  switch (kind) {
    case Kind::gltf:
      return read_gltf(file, std::move(bytes), model);
    case Kind::stl:
      return read_stl(file, std::move(bytes), progress, model);
    case Kind::obj:
      return read_obj(file, std::move(bytes), progress, model);
    case Kind::ply:
      return read_ply(file, std::move(bytes), progress, model);
    case Kind::unknown:
      break;
  }
  throw Error(file.string() + ": not a kind of model that is known; give a .glb, .gltf, .stl, .obj or .ply file");
}

double usual_metres(Kind kind) {
  return metres_of(kind == Kind::gltf ? LengthUnit::metre : LengthUnit::millimetre);
}

UpAxis usual_up(Kind kind) {
  return kind == Kind::stl || kind == Kind::ply ? UpAxis::z : UpAxis::y;
}

// With z up the front looks along -y, as in CAD; with x up it stays where it is.
void turn_upright(UpAxis up, float* v) {
  const float x = v[0], y = v[1], z = v[2];
  if (up == UpAxis::z) v[1] = z, v[2] = -y;
  if (up == UpAxis::x) v[0] = -y, v[1] = x;
}

void put_right(double metres, UpAxis up, Model& model) {
  for (ModelVertex& v : model.vertices) {
    for (float& x : v.position) x = static_cast<float>(double{x} * metres);
    turn_upright(up, v.position.data());
    turn_upright(up, v.normal.data());
    turn_upright(up, v.tangent.data());
  }
}

void find_bounds(const std::string& name, Model& model) {
  model.lower.fill(std::numeric_limits<float>::max());
  model.upper.fill(std::numeric_limits<float>::lowest());
  for (const std::uint32_t i : model.indices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float x = model.vertices[i].position[k];
      // Squares of lengths are still to be taken of it.
      if (!(std::abs(x) < 1e12F)) throw Error(name + ": it reaches to infinity; export the model again");
      model.lower[k] = std::min(model.lower[k], x);
      model.upper[k] = std::max(model.upper[k], x);
    }
  }
}

}  // namespace

Model load_model(const std::filesystem::path& file, const ModelImport& import, const LoadProgress& progress) {
  const std::string name = file.string();
  Bytes bytes;
  if (!read_bytes(file, bytes)) throw Error(name + ": no such model file; check the path");
  if (progress) progress(0.1);
  Model model;
  model.name = file.stem().string();
  const Kind kind = kind_of(file, bytes);
  try {
    read(kind, file, std::move(bytes), progress, model);
  } catch (const std::bad_alloc&) {
    throw Error(name + ": there is not enough memory for it; use a smaller model");
  }
  if (model.indices.empty()) throw Error(name + ": it has no triangles; export the model again");
  put_right(import.unit ? metres_of(*import.unit) : usual_metres(kind), import.up.value_or(usual_up(kind)), model);
  find_bounds(name, model);
  if (progress) progress(1);
  return model;
}

}  // namespace onestroke

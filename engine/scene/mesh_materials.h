#pragma once

#include "scene/model.h"

#include <assimp/color4.h>
#include <assimp/vector3.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

struct aiMaterial;

namespace onestroke {

/// The colours of these formats are those of a screen.
std::array<float, 4> linear_color(const aiColor4D& color);
/// v counts from the top in glTF, and here.
std::array<float, 2> texture_place(const aiVector3D& place);

/// Makes metallic-roughness materials of the older kind, of colours and a shininess. A texture that is not beside the
/// model is left out, as every viewer of these formats does; one that is there and damaged is an Error.
class MeshMaterials {
 public:
  /// Materials and images go into the model. `file` is the model's, for its folder and for messages.
  MeshMaterials(const std::filesystem::path& file, Model& model) : file_(file), model_(model) {}

  /// The index of the material, made when it is met first; plain grey for null. Where the vertices bring colours of
  /// their own, the material's is left out.
  int add(const aiMaterial* material, bool vertex_colors);

 private:
  ModelMaterial make(const aiMaterial* material, bool vertex_colors);
  int add_image(const std::string& path, bool srgb);

  std::filesystem::path file_;
  Model& model_;
  std::map<std::pair<const aiMaterial*, bool>, int> known_;
  std::map<std::pair<std::string, bool>, int> images_;
};

}  // namespace onestroke

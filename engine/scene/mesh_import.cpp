#include "scene/mesh_import.h"

#include "core/error.h"
#include "scene/mesh_io.h"
#include "scene/mesh_materials.h"
#include "scene/mesh_normals.h"
#include "scene/mesh_weld.h"
#include "scene/polygon_cut.h"

#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace onestroke {

namespace {

constexpr double parsed = 0.5, finished = 0.95;  // of a load's progress

// Assimp must not be left by an exception, so what the listener throws waits until it has returned.
class Listener : public Assimp::ProgressHandler {
 public:
  explicit Listener(const LoadProgress& progress) : progress_(progress) {}

  bool Update(float share) override {
    if (!progress_ || thrown_) return !thrown_;
    try {
      progress_(0.1 + (parsed - 0.1) * std::clamp(static_cast<double>(share), 0.0, 1.0));
    } catch (...) {
      thrown_ = std::current_exception();
    }
    return !thrown_;
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  const LoadProgress& progress_;
  std::exception_ptr thrown_;
};

class MeshImport {
 public:
  MeshImport(const std::filesystem::path& file, Model& model)
      : file_(file.string()), model_(model), materials_(file, model) {}

  void read(Bytes bytes, const MeshFormat& format, const LoadProgress& progress) {
    // Both belong to the importer from here on.
    auto* files = new MeshFiles(std::filesystem::absolute(std::filesystem::path(file_)).parent_path(), std::move(bytes),
                                format.extension);
    importer_.SetIOHandler(files);
    auto* listener = new Listener(progress);
    importer_.SetProgressHandler(listener);
    const aiScene* scene = importer_.ReadFile(files->name(), 0);
    listener->rethrow();
    if (!scene) fail(reason());
    check(*scene);
    add_meshes(*scene, format.keeps_normals, progress);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_ + ": " + what + "; export the model again");
  }

  std::string reason() const {
    const std::string all = importer_.GetErrorString();
    const std::string line = all.substr(0, all.find('\n'));
    return "it is damaged" + (line.empty() ? "" : " (" + line + ")");
  }

  void check(const aiScene& scene) const {
    for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
      if (!mesh->mVertices && mesh->mNumVertices > 0) fail("its points are missing");
      for (const aiVector3D& p : std::span(mesh->mVertices, mesh->mNumVertices))
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
          fail("it holds positions that are not finite");
      for (const aiFace& face : std::span(mesh->mFaces, mesh->mFaces ? mesh->mNumFaces : 0))
        for (const unsigned i : std::span(face.mIndices, face.mNumIndices))
          if (i >= mesh->mNumVertices) fail("a face names a point that is not there");
      if (mesh->mMaterialIndex >= scene.mNumMaterials && scene.mNumMaterials > 0) fail("a material is missing");
    }
  }

  void add_meshes(const aiScene& scene, bool keeps_normals, const LoadProgress& progress) {
    std::map<int, Surface> of_material;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[i];
      const Surface s = surface_of(mesh, keeps_normals);
      if (progress) progress(parsed + (finished - parsed) * (i + 1) / scene.mNumMeshes);
      if (s.indices.empty()) continue;
      const aiMaterial* material = scene.mNumMaterials > 0 ? scene.mMaterials[mesh.mMaterialIndex] : nullptr;
      append(s, of_material[materials_.add(material, mesh.HasVertexColors(0))]);
    }
    Surface all;
    for (const auto& [material, surface] : of_material) {
      model_.parts.push_back({static_cast<std::uint32_t>(all.indices.size()),
                              static_cast<std::uint32_t>(surface.indices.size()), material});
      append(surface, all);
    }
    model_.vertices = std::move(all.vertices);
    model_.indices = std::move(all.indices);
  }

  static Surface surface_of(const aiMesh& mesh, bool keeps_normals) {
    Surface s;
    s.vertices.resize(mesh.mNumVertices, ModelVertex{{}, {}, {0, 0, 0, 1}, {}, {1, 1, 1, 1}});
    const bool with_normals = keeps_normals && mesh.HasNormals();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      ModelVertex& v = s.vertices[i];
      const aiVector3D& p = mesh.mVertices[i];
      v.position = {p.x, p.y, p.z};
      if (with_normals) v.normal = {mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z};
      if (mesh.HasTextureCoords(0)) v.uv = texture_place(mesh.mTextureCoords[0][i]);
      if (mesh.HasVertexColors(0)) v.color = linear_color(mesh.mColors[0][i]);
    }
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces))
      cut_polygon(s.vertices, {face.mIndices, face.mNumIndices}, s.indices);
    drop_empty_triangles(s);
    weld(s);
    if (!with_normals || !make_normals_unit(s.vertices)) compute_normals(s, usual_crease);
    fill_tangents(s);
    return s;
  }

  const std::string file_;
  Model& model_;
  MeshMaterials materials_;
  Assimp::Importer importer_;
};

}  // namespace

void import_mesh(const std::filesystem::path& file, Bytes bytes, const MeshFormat& format, const LoadProgress& progress,
                 Model& model) {
  MeshImport(file, model).read(std::move(bytes), format, progress);
}

}  // namespace onestroke

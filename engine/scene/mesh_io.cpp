#include "scene/mesh_io.h"

#include <assimp/MemoryIOWrapper.h>

#include <memory>

namespace onestroke {

bool MeshFiles::Exists(const char* file) const {
  return file == name_ || file_beside(folder_, file).has_value();
}

Assimp::IOStream* MeshFiles::Open(const char* file, const char*) {
  const Bytes* bytes = &model_;
  if (file != name_) {
    const auto path = file_beside(folder_, file);
    Bytes read;
    if (!path || !read_bytes(*path, read)) return nullptr;
    bytes = &beside_.try_emplace(path->string(), std::move(read)).first->second;
  }
  return std::make_unique<Assimp::MemoryIOStream>(bytes->data(), bytes->size()).release();
}

void MeshFiles::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace onestroke

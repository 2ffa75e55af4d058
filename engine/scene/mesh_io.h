#pragma once

#include "scene/file_bytes.h"

#include <assimp/IOSystem.hpp>

#include <map>
#include <string>

namespace onestroke {

/// All of the file system that Assimp gets to see: the model, which is in memory already, and files beside it.
class MeshFiles : public Assimp::IOSystem {
 public:
  /// The folder is the model's; `extension`, ".stl", is what Assimp chooses its reader by.
  MeshFiles(std::filesystem::path folder, Bytes model, const std::string& extension)
      : folder_(std::move(folder)), model_(std::move(model)), name_("model" + extension) {}

  /// What the model is called in here.
  const std::string& name() const { return name_; }

  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  std::filesystem::path folder_;
  Bytes model_;
  std::string name_;
  std::map<std::string, Bytes> beside_;  // Read once, and kept while streams may read from them.
};

}  // namespace onestroke

#pragma once

#include "marker/catalog.h"
#include "score.h"

#include <filesystem>
#include <memory>

namespace onestroke::accuracy {

/// Pictures of another renderer, with their truth: a folder with catalog.json, truth.json and a folder of pictures for
/// each group. truth.json: {"frames": [{"image", "group", "camera": {width, height, fx, fy, cx, cy}, "markers": [{"id",
/// "R", "t", "cells_visible"}]}]}; R and t map marker to camera, mm.
class PhotorealSet {
 public:
  /// Throws Error where the folder is not such a set.
  explicit PhotorealSet(std::filesystem::path folder);
  ~PhotorealSet();

  const Catalog& catalog() const { return catalog_; }
  /// Calls visit for every picture of the group. Throws Error where a picture cannot be read.
  void visit(const std::string& group, const Visit& visit) const;

 private:
  struct Frames;
  std::filesystem::path folder_;
  Catalog catalog_;
  std::unique_ptr<Frames> frames_;
};

/// The folder that the environment variable ONESTROKE_PHOTOREAL names; empty where it is not set.
std::filesystem::path photoreal_folder();

/// What to say where it is not set.
inline constexpr const char* photoreal_missing = "photoreal: not run, ONESTROKE_PHOTOREAL is not set";

}  // namespace onestroke::accuracy

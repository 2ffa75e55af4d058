#pragma once

#include "scene/model_difference.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace onestroke {

/// Keeps what was found out of two models for the next time, a file a pair. Nothing here throws or waits for another
/// program: what cannot be kept is found out again.
class DifferenceCache {
 public:
  struct Key {
    /// ComparedModel::sum: a model that was changed, or is read in another unit or another way up, has another one.
    std::uint64_t laid_sum = 0, base_sum = 0;
    std::uint64_t laid_count = 0, base_count = 0;  ///< Of the refined surfaces' vertices.
    Alignment alignment{};
  };
  static Key key_of(const ComparedModel& laid, const ComparedModel& base, Alignment alignment);

  /// Looks into all folders, and writes to the first that can be written to. They need not be there.
  explicit DifferenceCache(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// None where there is no such file, or where it was cut short, damaged or written by another version.
  std::optional<ModelDifference> find(const Key& key) const noexcept;
  /// False where no folder can be written to.
  bool keep(const Key& key, const ModelDifference& difference) const noexcept;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// FILE.differences beside the catalogue's file, and for catalogues that lie where nothing may be written, a folder in
/// the user's cache.
std::vector<std::filesystem::path> difference_folders(const std::filesystem::path& catalog_file);

}  // namespace onestroke

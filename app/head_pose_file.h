#pragma once

#include "core/picture.h"
#include "core/pose.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace onestroke {

/// Where a head was, from a file: lines of JSON,
///
///   {"time_ns": 123456789, "T_world_head": [w, x, y, z, x, y, z]}
///   {"image": "0001.png", "T_world_head": [...]}
///
/// quaternion and mm, vision axes; by the time of the pictures' exposure or by their names.
class HeadPoseFile {
 public:
  /// Throws Error, which names file and line.
  explicit HeadPoseFile(const std::filesystem::path& file);

  /// Where it was in the middle of the picture's exposure: by its name, or between the two lines around that time.
  std::optional<Pose> head_of(const Picture& picture) const;

 private:
  std::map<std::string, Pose> by_name_;
  std::map<std::int64_t, Pose> by_time_;
};

}  // namespace onestroke

#include "app/head_pose_file.h"

#include "app/pose_line.h"
#include "core/error.h"
#include "files/record_json.h"

#include <fstream>

namespace onestroke {
namespace {

// Between poses that are farther apart nobody knows.
constexpr std::int64_t widest_gap_ns = 200'000'000;

}  // namespace

HeadPoseFile::HeadPoseFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string() + " cannot be read: check its name");
  std::size_t number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    if (text.empty()) continue;
    try {
      const Json line = Json::parse(text);
      const Pose pose = unit_pose_of(line.at("T_world_head"));
      if (const auto image = line.find("image"); image != line.end())
        by_name_[image->get<std::string>()] = pose;
      else
        by_time_[line.at("time_ns").get<std::int64_t>()] = pose;
    } catch (const std::exception& error) {
      throw Error(file.string() + ", line " + std::to_string(number) + ", is no pose of a head: " + error.what());
    }
  }
  if (by_name_.empty() && by_time_.empty()) throw Error(file.string() + " has no pose of a head");
}

std::optional<Pose> HeadPoseFile::head_of(const Picture& picture) const {
  if (const auto named = by_name_.find(picture_name(picture)); named != by_name_.end()) return named->second;
  const std::int64_t time = picture.exposure.middle().ns;
  const auto after = by_time_.lower_bound(time);
  if (after == by_time_.end()) return std::nullopt;
  if (after->first == time) return after->second;
  if (after == by_time_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const std::int64_t gap = after->first - before->first;
  if (gap > widest_gap_ns) return std::nullopt;
  return interpolate(before->second, after->second,
                     static_cast<double>(time - before->first) / static_cast<double>(gap));
}

}  // namespace onestroke

#include "app/pose_line.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace onestroke {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(Vec3 v) {
  return {v.x, v.y, v.z};
}

Json cell_centres(const MarkerObservation& marker) {
  Json list = Json::array();
  for (int i = 0; i < marker.cells_seen; ++i) {
    const CellCentre& cell = marker.cells[static_cast<std::size_t>(i)];
    list.push_back({cell.index, cell.u, cell.v});
  }
  return list;
}

Json second_cells(const MarkerObservation& marker) {
  Json list = Json::array();
  for (int i = 0; i < max_cells_per_marker; ++i)
    if (marker.second_cells >> i & 1) list.push_back(i);
  return list;
}

Json object(const MarkerObservation& marker) {
  const Pose& pose = marker.T_camera_marker;
  Json value{
      {"id", marker.id},
      {"name", marker.name.data()},
      {"R", to_matrix(pose.rotation)},
      {"rvec", numbers(log_so3(pose.rotation))},
      {"t", numbers(pose.translation)},
      {"covariance", marker.covariance},
      {"cells_seen", marker.cells_seen},
      {"state", word_of(marker.state)},
      {"cell_centres", cell_centres(marker)},
      {"velocity", {{"angular", numbers(marker.velocity.angular)}, {"linear", numbers(marker.velocity.linear)}}}};
  if (marker.second_cells != 0) value["second_cells"] = second_cells(marker);
  return value;
}

}  // namespace

const char* word_of(MarkerState state) {
  constexpr const char* words[] = {"measured", "predicted", "lost"};
  return words[static_cast<int>(state)];
}

std::string picture_name(const Picture& picture) {
  if (*picture.source != '\0') return picture.source;
  std::string digits = std::to_string(picture.sequence);
  digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return "frame_" + digits;
}

std::string pose_line(const Picture& picture, const FrameRecord& record) {
  Json markers = Json::array();
  for (const MarkerObservation& marker : record.seen()) markers.push_back(object(marker));
  const Json line{{"image", picture_name(picture)},
                  {"time_ns", record.time.ns},
                  {"ms", std::round(record.cost.ms() * 1e3) / 1e3},
                  {"markers", std::move(markers)}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace onestroke

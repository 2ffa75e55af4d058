#include "files/record_json.h"

#include <cmath>
#include <limits>

namespace onestroke {
namespace {

// More would be no camera's, and a picture of it is made.
constexpr int widest = 32768;

Json marker_value(const MarkerObservation& m) {
  Json cells = Json::array();
  for (int i = 0; i < m.cells_seen; ++i) {
    const CellCentre& cell = m.cells[static_cast<std::size_t>(i)];
    cells.push_back({cell.index, real_value(cell.u), real_value(cell.v)});
  }
  Json value{{"id", m.id},
             {"name", m.name.data()},
             {"state", word_of(m.state)},
             {"T_camera_marker", pose_value(m.T_camera_marker)},
             {"velocity", velocity_value(m.velocity)},
             {"covariance", reals_value(m.covariance)},
             {"cells", std::move(cells)}};
  if (m.second_cells != 0) value["second_cells"] = m.second_cells;
  return value;
}

MarkerState state_of(const Json& value) {
  for (const MarkerState state : {MarkerState::measured, MarkerState::predicted, MarkerState::lost})
    if (value == word_of(state)) return state;
  throw Error(value.dump() + " is no state of a marker");
}

void read_marker(const Json& value, MarkerObservation& m) {
  m = {};
  value.at("id").get_to(m.id);
  const std::string name = value.at("name").get<std::string>();
  if (name.size() > max_name_length) throw Error("the name \"" + name + "\" is too long");
  std::ranges::copy(name, m.name.begin());
  m.state = state_of(value.at("state"));
  m.T_camera_marker = pose_of(value.at("T_camera_marker"));
  m.velocity = velocity_of(value.at("velocity"));
  m.covariance = reals_of<36>(value.at("covariance"));
  m.second_cells = value.value("second_cells", std::uint64_t{0});
  const Json& cells = value.at("cells");
  if (cells.size() > max_cells_per_marker) throw Error("a marker has too many cells");
  for (const Json& cell : cells) {
    const int index = cell.at(0).get<int>();
    if (index < 0 || index >= max_cells_per_marker) throw Error("no marker has a cell " + std::to_string(index));
    m.cells[static_cast<std::size_t>(m.cells_seen++)] = {index, real_of(cell.at(1)), real_of(cell.at(2))};
  }
}

}  // namespace

Json real_value(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

double real_of(const Json& value) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (value.is_number()) return value.get<double>();
  const std::string word = value.get<std::string>();
  if (word != "nan" && word != "inf" && word != "-inf") throw Error("\"" + word + "\" is no number");
  return word == "nan" ? std::numeric_limits<double>::quiet_NaN() : word == "inf" ? infinity : -infinity;
}

void read_reals(const Json& list, std::span<double> numbers) {
  if (!list.is_array() || list.size() != numbers.size())
    throw Error("a list must have " + std::to_string(numbers.size()) + " numbers");
  std::ranges::transform(list, numbers.begin(), real_of);
}

Json vector_value(Vec3 v) {
  return reals_value(std::array{v.x, v.y, v.z});
}

Json pose_value(const Pose& pose) {
  const Quat& q = pose.rotation;
  const Vec3& t = pose.translation;
  return reals_value(std::array{q.w, q.x, q.y, q.z, t.x, t.y, t.z});
}

Pose pose_of(const Json& list) {
  const auto n = reals_of<7>(list);
  return {{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}};
}

Pose unit_pose_of(const Json& list) {
  const Pose pose = pose_of(list);
  const Quat& q = pose.rotation;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(std::abs(length - 1) < 1e-3)) throw Error("a pose must begin with a unit quaternion");
  return {normalized(q), pose.translation};
}

Json velocity_value(const Velocity& velocity) {
  const auto& [a, l] = velocity;
  return reals_value(std::array{a.x, a.y, a.z, l.x, l.y, l.z});
}

Velocity velocity_of(const Json& list) {
  const auto n = reals_of<6>(list);
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

const char* word_of(MarkerState state) {
  constexpr const char* words[] = {"measured", "predicted", "lost"};
  return words[static_cast<int>(state)];
}

Json record_value(const FrameRecord& record) {
  Json markers = Json::array();
  for (const MarkerObservation& marker : record.seen()) markers.push_back(marker_value(marker));
  return {{"sequence", record.sequence},
          {"time_ns", record.time.ns},
          {"T_world_camera", pose_value(record.T_world_camera)},
          {"cost_ns", record.cost.ns},
          {"markers", std::move(markers)}};
}

void read_record(const Json& value, FrameRecord& record) {
  value.at("sequence").get_to(record.sequence);
  value.at("time_ns").get_to(record.time.ns);
  value.at("cost_ns").get_to(record.cost.ns);
  record.T_world_camera = pose_of(value.at("T_world_camera"));
  const Json& markers = value.at("markers");
  if (markers.size() > max_markers_per_frame) throw Error("there are too many markers");
  record.marker_count = 0;
  for (const Json& marker : markers)
    read_marker(marker, record.markers[static_cast<std::size_t>(record.marker_count++)]);
}

Json lens_value(const PictureLens& lens) {
  const Intrinsics& k = lens.intrinsics;
  return {{"width", lens.width},
          {"height", lens.height},
          {"matrix", reals_value(std::array{k.fx, k.fy, k.cx, k.cy})},
          {"distortion", reals_value(k.distortion)}};
}

void read_lens(const Json& value, PictureLens& lens) {
  value.at("width").get_to(lens.width);
  value.at("height").get_to(lens.height);
  if (std::min(lens.width, lens.height) < 1 || std::max(lens.width, lens.height) > widest)
    throw Error("no picture has " + std::to_string(lens.width) + " x " + std::to_string(lens.height) + " pixels");
  const auto n = reals_of<4>(value.at("matrix"));
  lens.intrinsics = {n[0], n[1], n[2], n[3], reals_of<5>(value.at("distortion"))};
}

std::string text_of(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace onestroke

#include "app/session_json.h"

#include "app/pose_line.h"
#include "core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace onestroke {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_key = "onestroke_session";
// More would be no camera's, and a picture of it is made.
constexpr int widest = 32768;

std::string dump(const Json& line) {
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json real(double value) {
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

template <typename Numbers>
Json reals(const Numbers& numbers) {
  Json list = Json::array();
  for (const double n : numbers) list.push_back(real(n));
  return list;
}

template <std::size_t N>
std::array<double, N> reals_of(const Json& list) {
  if (!list.is_array() || list.size() != N) throw Error("a list must have " + std::to_string(N) + " numbers");
  std::array<double, N> numbers{};
  std::ranges::transform(list, numbers.begin(), real_of);
  return numbers;
}

Json pose_value(const Pose& p) {
  const Quat& q = p.rotation;
  const Vec3& t = p.translation;
  return reals(std::array{q.w, q.x, q.y, q.z, t.x, t.y, t.z});
}

Pose pose_of(const Json& list) {
  const auto n = reals_of<7>(list);
  return {{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}};
}

Json velocity_value(const Velocity& v) {
  return reals(std::array{v.angular.x, v.angular.y, v.angular.z, v.linear.x, v.linear.y, v.linear.z});
}

Velocity velocity_of(const Json& list) {
  const auto n = reals_of<6>(list);
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

Json marker_value(const MarkerObservation& m) {
  Json cells = Json::array();
  for (int i = 0; i < m.cells_seen; ++i) {
    const CellCentre& cell = m.cells[static_cast<std::size_t>(i)];
    cells.push_back({cell.index, real(cell.u), real(cell.v)});
  }
  Json value{{"id", m.id},
             {"name", m.name.data()},
             {"state", word_of(m.state)},
             {"T_camera_marker", pose_value(m.T_camera_marker)},
             {"velocity", velocity_value(m.velocity)},
             {"covariance", reals(m.covariance)},
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
          {"matrix", reals(std::array{k.fx, k.fy, k.cx, k.cy})},
          {"distortion", reals(k.distortion)}};
}

void read_lens(const Json& value, PictureLens& lens) {
  value.at("width").get_to(lens.width);
  value.at("height").get_to(lens.height);
  if (std::min(lens.width, lens.height) < 1 || std::max(lens.width, lens.height) > widest)
    throw Error("no picture has " + std::to_string(lens.width) + " x " + std::to_string(lens.height) + " pixels");
  const auto n = reals_of<4>(value.at("matrix"));
  lens.intrinsics = {n[0], n[1], n[2], n[3], reals_of<5>(value.at("distortion"))};
}

void read_second(const Json& value, SecondLens& second) {
  second = {};
  if (value.is_null()) return;
  read_lens(value, second);
  second.T_first_second = pose_of(value.at("T_first_second"));
}

bool is_letter(int key) {
  return key > ' ' && key < 0x7f;
}

Json keys_value(const SessionFrame& frame) {
  Json list = Json::array();
  for (const Key key : frame.keys) {
    const int code = static_cast<int>(key);
    list.push_back(is_letter(code) ? Json(std::string(1, static_cast<char>(code))) : Json(code));
  }
  return list;
}

Key key_of(const Json& value) {
  if (!value.is_string()) return Key{value.get<int>()};
  const std::string letter = value.get<std::string>();
  if (letter.size() != 1) throw Error("\"" + letter + "\" is no key");
  return Key{letter[0]};
}

void read_frame(const Json& line, SessionFrame& frame) {
  line.at("now_ns").get_to(frame.now.ns);
  frame.picture = line.value("picture", false);
  frame.keys.clear();
  frame.events.clear();
  if (const auto keys = line.find("keys"); keys != line.end())
    for (const Json& key : *keys) frame.keys.push_back(key_of(key));
  if (const auto events = line.find("events"); events != line.end())
    for (const Json& word : *events) frame.events.push_back(Text(word.get<std::string>()));
  if (const auto lens = line.find("lens"); lens != line.end()) read_lens(*lens, frame.lens);
  if (const auto second = line.find("second"); second != line.end()) read_second(*second, frame.second);
  if (const auto record = line.find("record"); record != line.end()) read_record(*record, frame.record);
}

/// The library's messages without their own error numbers.
template <typename Read>
auto reading(const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    std::string what = error.what();
    what.erase(0, std::min(what.size(), what.find("] ") + 2));
    throw Error(what);
  }
}

template <typename Value>
void read_optional(const Json& line, const char* key, std::optional<Value>& value) {
  if (const auto found = line.find(key); found != line.end()) value = found->get<Value>();
}

}  // namespace

void copy_record(const FrameRecord& from, FrameRecord& to) {
  to.sequence = from.sequence;
  to.time = from.time;
  to.T_world_camera = from.T_world_camera;
  to.cost = from.cost;
  to.marker_count = from.marker_count;
  std::ranges::copy(from.seen(), to.markers.begin());
}

std::string session_line(const SessionHeader& header) {
  Json line{{format_key, session_format},
            {"program", header.program},
            {"camera", header.camera},
            {"catalog", header.catalog}};
  if (header.fov_deg) line["fov"] = *header.fov_deg;
  if (!header.calibration.empty()) line["calibration"] = header.calibration;
  if (header.readout_ms) line["readout_ms"] = *header.readout_ms;
  if (!header.second_camera.empty()) line["second_camera"] = header.second_camera;
  if (header.side_by_side) line["side_by_side"] = true;
  if (!header.rig.empty()) line["rig"] = header.rig;
  if (header.baseline_mm) line["baseline_mm"] = *header.baseline_mm;
  line["rate"] = header.rate;
  line["stereo"] = header.stereo;
  line["fingers"] = header.fingers;
  line["left_handed"] = header.left_handed;
  if (header.T_head_camera) line["T_head_camera"] = pose_value(*header.T_head_camera);
  return dump(line);
}

std::string session_text(const FrameRecord& record) {
  return dump(record_value(record));
}

std::string session_text(const PictureLens& lens) {
  return dump(lens_value(lens));
}

std::string session_text(const SecondLens& second) {
  if (second.width == 0) return "null";
  Json value = lens_value(second);
  value["T_first_second"] = pose_value(second.T_first_second);
  return dump(value);
}

std::string session_line(const SessionFrame& frame, const SessionTexts& texts) {
  Json line{{"now_ns", frame.now.ns}};
  if (frame.picture) line["picture"] = true;
  if (frame.latency)
    line["latency_ms"] = {{"tracked", frame.latency->tracked.ms()},
                          {"drawn", frame.latency->drawn.ms()},
                          {"seen", frame.latency->seen.ms()}};
  if (!frame.keys.empty()) line["keys"] = keys_value(frame);
  for (const Text& word : frame.events) line["events"].push_back(word.view());
  std::string text = dump(line);
  text.pop_back();
  if (!texts.lens.empty()) text += ",\"lens\":" + texts.lens;
  if (!texts.second.empty()) text += ",\"second\":" + texts.second;
  if (!texts.record.empty()) text += ",\"record\":" + texts.record;
  return text + "}";
}

std::string session_line_missed(std::uint64_t frames) {
  return dump({{"missed", frames}});
}

SessionHeader header_of_line(const std::string& text) {
  return reading([&] {
    const Json line = Json::parse(text);
    const int format = line.at(format_key).get<int>();
    if (format != session_format)
      throw Error("it has format " + std::to_string(format) + " and this program knows format " +
                  std::to_string(session_format) + "; update the program");
    SessionHeader header;
    line.at("program").get_to(header.program);
    line.at("camera").get_to(header.camera);
    line.at("catalog").get_to(header.catalog);
    read_optional(line, "fov", header.fov_deg);
    header.calibration = line.value("calibration", "");
    read_optional(line, "readout_ms", header.readout_ms);
    header.second_camera = line.value("second_camera", "");
    header.side_by_side = line.value("side_by_side", false);
    header.rig = line.value("rig", "");
    read_optional(line, "baseline_mm", header.baseline_mm);
    line.at("rate").get_to(header.rate);
    line.at("stereo").get_to(header.stereo);
    line.at("fingers").get_to(header.fingers);
    line.at("left_handed").get_to(header.left_handed);
    if (const auto mount = line.find("T_head_camera"); mount != line.end()) header.T_head_camera = pose_of(*mount);
    return header;
  });
}

bool read_session_line(const std::string& text, SessionFrame& frame) {
  return reading([&] {
    const Json line = Json::parse(text);
    if (const auto missed = line.find("missed"); missed != line.end()) {
      frame.missed += missed->get<std::uint64_t>();
      return false;
    }
    read_frame(line, frame);
    return true;
  });
}

}  // namespace onestroke

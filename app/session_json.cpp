#include "app/session_json.h"

#include "files/record_json.h"

#include <algorithm>

namespace onestroke {
namespace {

constexpr const char* format_key = "onestroke_session";

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

template <typename Value>
void read_optional(const Json& line, const char* key, std::optional<Value>& value) {
  if (const auto found = line.find(key); found != line.end()) value = found->get<Value>();
}

}  // namespace

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
  if (header.loop) line["loop"] = true;
  if (header.from_s > 0) line["from_s"] = header.from_s;
  line["rate"] = header.rate;
  line["stereo"] = header.stereo;
  line["fingers"] = header.fingers;
  line["left_handed"] = header.left_handed;
  if (header.T_head_camera) line["T_head_camera"] = pose_value(*header.T_head_camera);
  return text_of(line);
}

std::string session_text(const FrameRecord& record) {
  return text_of(record_value(record));
}

std::string session_text(const PictureLens& lens) {
  return text_of(lens_value(lens));
}

std::string session_text(const SecondLens& second) {
  if (second.width == 0) return "null";
  Json value = lens_value(second);
  value["T_first_second"] = pose_value(second.T_first_second);
  return text_of(value);
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
  std::string text = text_of(line);
  text.pop_back();
  if (!texts.lens.empty()) text += ",\"lens\":" + texts.lens;
  if (!texts.second.empty()) text += ",\"second\":" + texts.second;
  if (!texts.record.empty()) text += ",\"record\":" + texts.record;
  return text + "}";
}

std::string session_line_missed(std::uint64_t frames) {
  return text_of({{"missed", frames}});
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
    header.loop = line.value("loop", false);
    header.from_s = line.value("from_s", 0.0);
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

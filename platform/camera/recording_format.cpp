#include "camera/recording_format.h"

#include "files/record_json.h"

#include <array>
#include <string_view>

namespace onestroke {
namespace {

constexpr const char* format_key = "onestroke_recording";
// Behind all that tells of the pictures; no text within them can hold it, since its quotation marks would be escaped.
constexpr std::string_view record_key = ",\"record\":";

constexpr std::array<std::string_view, 4> format_words{"rgb8", "gray8", "nv12", "yuyv"};

PixelFormat format_of(const std::string& word) {
  const auto* const found = std::ranges::find(format_words, word);
  if (found == format_words.end()) throw Error("\"" + word + "\" is no format of pixels");
  return static_cast<PixelFormat>(found - format_words.begin());
}

Json picture_value(const StoredPicture& p, PictureLens& lens) {
  Json value{{"sequence", p.sequence},
             {"start_ns", p.exposure.start.ns},
             {"length_ns", p.exposure.length.ns},
             {"readout_ns", p.exposure.readout.ns},
             {"T_world_camera", pose_value(p.T_world_camera)},
             {"format", format_words[static_cast<std::size_t>(p.format)]},
             {"file", p.file}};
  if (p.video) value["frame"] = p.video->frame, value["frame_ms"] = p.video->ms;
  if (!p.source.empty()) value["source"] = p.source;
  if (p.lens != lens) value["lens"] = lens_value(p.lens);
  lens = p.lens;
  return value;
}

StoredPicture picture_of(const Json& value, PictureLens& lens) {
  StoredPicture p;
  value.at("sequence").get_to(p.sequence);
  value.at("start_ns").get_to(p.exposure.start.ns);
  value.at("length_ns").get_to(p.exposure.length.ns);
  value.at("readout_ns").get_to(p.exposure.readout.ns);
  p.T_world_camera = pose_of(value.at("T_world_camera"));
  p.format = format_of(value.at("format").get<std::string>());
  value.at("file").get_to(p.file);
  if (const auto frame = value.find("frame"); frame != value.end())
    p.video = {frame->get<std::uint64_t>(), value.at("frame_ms").get<std::int64_t>()};
  p.source = value.value("source", "");
  if (const auto other = value.find("lens"); other != value.end()) read_lens(*other, lens);
  if (lens.width == 0) throw Error("nothing is said of the lens");
  p.lens = lens;
  return p;
}

}  // namespace

StoredPicture stored_picture(const Picture& p) {
  return {.sequence = p.sequence,
          .exposure = p.exposure,
          .format = p.format,
          .lens = {p.width, p.height, p.intrinsics},
          .T_world_camera = p.T_world_camera,
          .source = p.source};
}

std::string header_text(const RecordingHeader& header) {
  return text_of({{format_key, recording_format},
                  {"program", header.program},
                  {"camera", header.camera},
                  {"rate", header.rate}},
                 2) +
         "\n";
}

RecordingHeader header_of_text(const std::string& text) {
  return reading([&] {
    const Json value = Json::parse(text);
    const int format = value.at(format_key).get<int>();
    if (format != recording_format)
      throw Error("it has format " + std::to_string(format) + " and this program knows format " +
                  std::to_string(recording_format) + "; update the program");
    return RecordingHeader{.program = value.at("program").get<std::string>(),
                           .camera = value.at("camera").get<std::string>(),
                           .rate = value.at("rate").get<double>()};
  });
}

std::string RecordingLines::line(const StoredShot& shot, const FrameRecord& record) {
  Json value = picture_value(shot.picture, lens_);
  if (shot.second) value["second"] = picture_value(*shot.second, second_lens_);
  std::string text = text_of(value);
  text.pop_back();
  return text.append(record_key).append(text_of(record_value(record))).append("}");
}

std::string RecordingLines::left_out(std::uint64_t pictures) {
  return text_of({{"left_out", pictures}});
}

std::optional<StoredShot> RecordingLines::shot_of(const std::string& line, std::uint64_t& left_out) {
  return reading([&]() -> std::optional<StoredShot> {
    const std::size_t cut = line.find(record_key);
    if (cut != std::string::npos && !line.ends_with('}')) throw Error("it is cut short");
    const Json value = Json::parse(cut == std::string::npos ? line : line.substr(0, cut) + "}");
    if (const auto missing = value.find("left_out"); missing != value.end()) {
      left_out += missing->get<std::uint64_t>();
      return std::nullopt;
    }
    StoredShot shot{.picture = picture_of(value, lens_)};
    if (const auto second = value.find("second"); second != value.end())
      shot.second = picture_of(*second, second_lens_);
    return shot;
  });
}

void record_of_line(const std::string& line, FrameRecord& record) {
  reading([&] {
    read_record(Json::parse(line).at("record"), record);
    return true;
  });
}

}  // namespace onestroke

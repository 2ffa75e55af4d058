#include "app/head_mount.h"

#include "app/cache_folder.h"
#include "core/error.h"
#include "core/kept_file.h"
#include "files/record_json.h"

#include <string_view>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* mounts_key = "headsets";
constexpr std::uint64_t longest_file = 1 << 24;

/// The synthetic camera is one camera, whatever it is told to show.
std::string camera_name(const std::string& spec) {
  return spec.starts_with("synthetic") ? "synthetic" : spec;
}

/// Whether a text is what a pattern says, where '*' is any text.
bool matches(std::string_view pattern, std::string_view text) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == text;
  if (!text.starts_with(pattern.substr(0, star))) return false;
  const std::string_view rest = pattern.substr(star + 1);
  for (std::size_t at = star; at <= text.size(); ++at)
    if (matches(rest, text.substr(at))) return true;
  return false;
}

/// The file's JSON; null where it is not there. Throws Error, which names the file, where it is not sound.
template <typename Read>
auto reading(const fs::path& file, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw Error(file.string() + " says nothing of a headset's camera: correct it or calibrate again (" + error.what() +
                ")");
  } catch (const Error& error) {
    throw Error(file.string() + " says nothing of a headset's camera: " + error.what());
  }
}

Json load(const fs::path& file) {
  std::error_code unknown;
  if (file.empty() || !fs::exists(file, unknown)) return nullptr;
  const std::vector<std::byte> bytes = read_kept(file, longest_file);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  return reading(file, [&] { return Json::parse(text, text + bytes.size()); });
}

HeadCameraMount mount_of(const Json& entry, const fs::path& file) {
  const std::string how = entry.contains("date") ? "calibrated " + entry["date"].get<std::string>().substr(0, 10)
                                                 : entry.value("note", std::string("given"));
  return {.T_head_camera = unit_pose_of(entry.at("T_head_camera")), .from = how + ", " + file.string()};
}

std::optional<HeadCameraMount> find_in(const fs::path& file, const std::string& headset, const std::string& camera,
                                       bool patterns) {
  const Json list = load(file);
  if (list.is_null()) return std::nullopt;
  return reading(file, [&]() -> std::optional<HeadCameraMount> {
    for (const Json& entry : list.at(mounts_key)) {
      const auto named = entry.at("headset").get<std::string>(), with = entry.at("camera").get<std::string>();
      const bool is = patterns ? matches(named, headset) && matches(with, camera_name(camera))
                               : named == headset && with == camera_name(camera);
      if (is) return mount_of(entry, file);
    }
    return std::nullopt;
  });
}

Json value_of(const MountReport& report) {
  const HeadCalibration& c = report.calibration;
  const HeadResiduals& r = c.residuals;
  Json value{{"headset", report.headset},
             {"camera", camera_name(report.camera)},
             {"date", report.date},
             {"T_head_camera", pose_value(c.T_head_camera)},
             {"deviation", {{"rotation_deg", vector_value(c.deviation_deg)}, {"mm", vector_value(c.deviation_mm)}}},
             {"residuals",
              {{"rms_deg", r.rms_deg}, {"worst_deg", r.worst_deg}, {"rms_mm", r.rms_mm}, {"worst_mm", r.worst_mm}}},
             {"turned_deg", {c.turn.first_deg, c.turn.second_deg}},
             {"sights", c.used},
             {"outliers", c.outliers}};
  if (r.worst_px > 0) {
    value["residuals"]["rms_px"] = r.rms_px;
    value["residuals"]["worst_px"] = r.worst_px;
  }
  return value;
}

void write(const fs::path& file, const std::string& text) {
  if (!keep_file(file, {}, std::as_bytes(std::span(text))))
    throw Error(file.string() + " cannot be written: check that you may write there and that the disk is not full");
}

}  // namespace

fs::path mounts_file() {
  const fs::path folder = config_folder();
  return folder.empty() ? folder : folder / "headsets.json";
}

std::optional<HeadCameraMount> find_mount(const std::string& headset, const std::string& camera, const fs::path& file) {
  if (!file.empty()) {
    const Json given = load(file);
    if (given.is_null()) throw Error(file.string() + " is not there: `onestroke calibrate head` makes one");
    return reading(file, [&] { return mount_of(given, file); });
  }
  if (auto own = find_in(mounts_file(), headset, camera, false)) return own;
  return find_in(assets_folder() / "headsets.json", headset, camera, true);
}

std::string to_json(const MountReport& report) {
  return text_of(value_of(report), 2) + "\n";
}

void write_mount(const fs::path& file, const MountReport& report) {
  write(file, to_json(report));
}

void keep_mount(const MountReport& report) {
  const fs::path file = mounts_file();
  if (file.empty())
    throw Error("neither XDG_CONFIG_HOME nor HOME says where the calibration could be kept: set one of them");
  Json all = load(file);
  reading(file, [&] {
    Json kept = Json::array();
    if (!all.is_null())
      for (const Json& entry : all.at(mounts_key))
        if (entry.at("headset") != report.headset || entry.at("camera") != camera_name(report.camera))
          kept.push_back(entry);
    kept.push_back(value_of(report));
    all = Json{{mounts_key, std::move(kept)}};
  });
  write(file, text_of(all, 2) + "\n");
}

}  // namespace onestroke

#include "app/session_options.h"

#include "app/cache_folder.h"
#include "app/say.h"
#include "app/session_files.h"
#include "app/source.h"
#include "core/error.h"
#include "display/open_display.h"

#include <ctime>
#include <string_view>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& path) {
  std::error_code unknown;
  const fs::path whole = path.empty() ? path : fs::absolute(path, unknown);
  return unknown ? path : whole.lexically_normal();
}

/// So that it is found from any folder.
std::string whole_camera(const std::string& camera) {
  for (const std::string_view kind : {"file:", "folder:"})
    if (camera.starts_with(kind)) return std::string(kind) + whole_path(camera.substr(kind.size())).string();
  return camera;
}

/// What was live is a recording now: each picture can be had, however long it takes.
std::string not_live(std::string camera) {
  constexpr std::string_view live = "live=1";
  if (const std::size_t at = camera.find(live); camera.starts_with("synthetic") && at != std::string::npos)
    camera[at + live.size() - 1] = '0';
  return camera;
}

std::unique_ptr<SessionLog> open_usual_log(const SessionHeader& header) {
  try {
    const fs::path state = state_folder();
    if (state.empty()) throw Error("neither XDG_STATE_HOME nor HOME says where it could go");
    return std::make_unique<SessionLog>(new_session_file(state / "sessions", std::time(nullptr)), header);
  } catch (const Error& error) {
    say("this session is not logged: " + std::string(error.what()) + "; --log none does without");
    return nullptr;
  }
}

}  // namespace

SessionHeader session_header(const RunOptions& options, double rate, const std::optional<Pose>& T_head_camera) {
  const SourceOptions& source = options.source;
  return {.program = ONESTROKE_VERSION,
          .camera = whole_camera(source.camera),
          .catalog = whole_path(options.catalog).string(),
          .fov_deg = source.fov_deg,
          .calibration = whole_path(source.calibration).string(),
          .readout_ms = source.readout_ms,
          .second_camera = whole_camera(source.second_camera),
          .side_by_side = source.side_by_side,
          .rig = whole_path(source.rig).string(),
          .baseline_mm = source.baseline_mm,
          .rate = rate,
          .stereo = options.stereo,
          .fingers = options.fingers,
          .left_handed = options.left_handed,
          .T_head_camera = T_head_camera};
}

RunOptions replay_options(const SessionHeader& header, const RunOptions& given) {
  RunOptions options = given;
  if (options.source.camera.empty()) {
    options.source.camera = not_live(header.camera);
    options.source.second_camera = not_live(header.second_camera);
  }
  options.source.fov_deg = header.fov_deg;
  options.source.calibration = header.calibration;
  options.source.readout_ms = header.readout_ms;
  options.source.side_by_side = header.side_by_side && options.source.second_camera.empty();
  if (options.source.pair()) {
    options.source.rig = header.rig;
    options.source.baseline_mm = header.baseline_mm;
    if (options.source.rig.empty() && !options.source.baseline_mm)
      throw UsageError(
          "the session was one camera's, so its log does not say where a second one sits: leave "
          "--second-camera out");
  }
  options.catalog = header.catalog;
  options.stereo = header.stereo;
  options.fingers = header.fingers;
  options.left_handed = header.left_handed;
  return options;
}

std::unique_ptr<SessionLog> open_session_log(const RunOptions& options, const std::string& display,
                                             const SessionHeader& header) {
  if (options.log == "none") return nullptr;
  if (!options.log.empty()) return std::make_unique<SessionLog>(options.log, header);
  const std::optional<fs::path> folder = offscreen_folder(display);
  if (!folder) return open_usual_log(header);
  return std::make_unique<SessionLog>(*folder / "session.jsonl", header);
}

std::unique_ptr<Camera> open_replay_camera(const RunOptions& given, const RunOptions& options, const Catalog& catalog,
                                           const HeadMount& mount) {
  try {
    return open_source(options.source, catalog, mount);
  } catch (const Error& error) {
    if (!given.source.camera.empty()) throw;
    say(std::string(error.what()) + "; dark pictures stand for the session's own, unless --camera names others");
    return nullptr;
  }
}

}  // namespace onestroke

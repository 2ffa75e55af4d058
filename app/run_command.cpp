#include "app/run_command.h"

#include "app/cache_folder.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/show.h"
#include "app/source.h"
#include "core/error.h"
#include "display/open_display.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

// The demo's camera, which is also the synthetic one where nothing more is said of it: hands, a lens and a sensor like
// any other.
constexpr const char* plain_synthetic = "synthetic";
constexpr const char* demo_camera = "synthetic:fingers=1,noise=2,blur=0.5";
// What two hands do before the synthetic camera, once.
constexpr double script_seconds = 24;

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

fs::path catalog_file(const RunOptions& options) {
  if (!options.catalog.empty()) return options.catalog;
  const fs::path assets = set("ONESTROKE_ASSETS") ? std::getenv("ONESTROKE_ASSETS") : ONESTROKE_ASSETS_DIR;
  const fs::path file = assets / "catalog.json";
  std::error_code unknown;
  if (!fs::exists(file, unknown))
    throw Error("the demo's catalogue " + file.string() +
                " is not there; set ONESTROKE_ASSETS to the folder that holds it, or give --catalog FILE");
  return file;
}

std::string display_spec(const RunOptions& options) {
  if (!options.display.empty()) return options.display;
  return set("DISPLAY") || set("WAYLAND_DISPLAY") ? "window" : "offscreen:out/demo";
}

/// On a screen the synthetic camera takes its pictures in real time, unless told otherwise.
SourceOptions source_for(SourceOptions source, bool offscreen) {
  if (source.camera == plain_synthetic) source.camera = demo_camera;
  const bool synthetic = source.camera.starts_with("synthetic");
  if (!synthetic || offscreen || source.camera.find("live=") != std::string::npos) return source;
  source.camera += source.camera.find(':') == std::string::npos ? ":live=1" : ",live=1";
  return source;
}

DisplayOptions display_options(const RunOptions& options, bool offscreen, double rate) {
  DisplayOptions display{.rate = rate};
  if (!options.stereo) return display;
  if (!offscreen) throw UsageError("a window shows one view: leave out --stereo, or use --display offscreen:DIR");
  display.views = 2;
  display.width *= 2;
  return display;
}

FrameFeed::Pace pace_for(const Camera& camera, bool offscreen) {
  if (camera.live()) return FrameFeed::Pace::newest;
  return offscreen ? FrameFeed::Pace::each : FrameFeed::Pace::at_its_time;
}

ShowLimits limits_for(const RunOptions& options, const Camera& camera, bool offscreen) {
  ShowLimits limits;
  if (options.frames) limits.pictures = static_cast<std::size_t>(*options.frames);
  if (options.seconds) limits.length = Duration::from_seconds(*options.seconds);
  // A folder would fill for ever.
  const bool endless = camera.length() == 0 && !camera.live() && !options.frames && !options.seconds;
  if (endless && offscreen) limits.pictures = static_cast<std::size_t>(std::lround(script_seconds * camera.rate()));
  return limits;
}

std::size_t pictures_expected(const ShowLimits& limits, const Camera& camera) {
  const std::size_t length = camera.length();
  if (limits.pictures == ShowLimits{}.pictures) return length;
  return length == 0 ? limits.pictures : std::min(limits.pictures, length);
}

/// After an error, which is the one to be told: what was filmed so far can be played.
void finish_all_the_same(Display& display) noexcept {
  try {
    display.finish();
  } catch (const std::exception&) {
    // Of two errors the first.
  }
}

}  // namespace

int run_command(const RunOptions& options, std::ostream& out) {
  const fs::path file = catalog_file(options);
  const Catalog catalog = load_catalog(file);
  const std::string spec = display_spec(options);
  const bool offscreen = spec.starts_with("offscreen");
  const std::unique_ptr<Camera> camera = open_source(source_for(options.source, offscreen), catalog);
  const double rate = camera->rate() > 0 ? camera->rate() : 30;
  const std::unique_ptr<Display> display = open_display(spec, display_options(options, offscreen, rate));
  Graphics graphics(
      *display,
      {.catalog = catalog,
       .catalog_file = file,
       // A window shows how far the models are; files would show it for ever.
       .models_first = offscreen,
       .gpu = {.validation = set("ONESTROKE_VALIDATION"), .gpu = options.gpu, .cache_folder = cache_folder()}});
  const ShowLimits limits = limits_for(options, *camera, offscreen);
  const std::size_t expected = pictures_expected(limits, *camera);

  catch_interrupt();
  Tracker tracker(catalog);
  const FrameFeed::Pace pace = pace_for(*camera, offscreen);
  TrackingThread tracking(
      *camera, tracker,
      pace == FrameFeed::Pace::newest ? TrackingThread::Pacing::newest : TrackingThread::Pacing::every);
  try {
    Progress progress(!offscreen);
    Show show({*display, graphics, tracking}, pace, options.mode, options.fingers);
    show.run(limits, [&](std::size_t pictures) { progress.say(pictures, expected, " shown"); });
  } catch (const std::exception&) {
    finish_all_the_same(*display);
    throw;
  }
  display->finish();
  for (const std::string& line : display->report()) out << line << '\n';
  if (!out.flush())
    throw Error("standard output cannot be written; check where it leads and that the disk is not full");
  if (tracking.finished() && !tracking.message().empty()) throw Error(tracking.message());
  return 0;
}

}  // namespace onestroke

#include "app/run_command.h"

#include "app/cache_folder.h"
#include "app/frame_feed.h"
#include "app/head_mount.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/replay_feed.h"
#include "app/say.h"
#include "app/session_options.h"
#include "app/show.h"
#include "app/source.h"
#include "core/error.h"
#include "display/open_display.h"
#include "tracking/stereo_tracker.h"

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
// Of what has no end and does not come round.
constexpr double film_seconds = 24;
// How many frames a second a film has of what was shown on a screen.
constexpr double screen_rate = 60;

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

fs::path catalog_file(const RunOptions& options) {
  if (!options.catalog.empty()) return options.catalog;
  const fs::path file = assets_folder() / "catalog.json";
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

std::string in_real_time(std::string camera) {
  if (!camera.starts_with(plain_synthetic) || camera.find("live=") != std::string::npos) return camera;
  return camera + (camera.find(':') == std::string::npos ? ":live=1" : ",live=1");
}

/// On a screen the synthetic camera takes its pictures in real time, unless told otherwise.
SourceOptions source_for(SourceOptions source, bool offscreen) {
  if (source.camera == plain_synthetic) source.camera = demo_camera;
  if (offscreen) return source;
  source.camera = in_real_time(source.camera);
  // By itself it is the first one once more.
  if (source.second_camera != plain_synthetic) source.second_camera = in_real_time(source.second_camera);
  return source;
}

DisplayOptions display_options(const RunOptions& options, bool offscreen, double rate) {
  DisplayOptions display{.world = options.world, .mirror = options.mirror, .rate = rate};
  if (options.wait) display.give_up = interrupted;
  if (!options.stereo) return display;
  if (!offscreen)
    throw UsageError(
        "--stereo is for files alone, since a window shows one view and a headset two anyway: leave it out, "
        "or use --display offscreen:DIR");
  display.views = 2;
  display.width *= 2;
  return display;
}

Feed::Pace pace_for(const Camera& camera, bool offscreen) {
  if (camera.live()) return Feed::Pace::newest;
  return offscreen ? Feed::Pace::each : Feed::Pace::at_its_time;
}

ShowLimits limits_for(const RunOptions& options) {
  ShowLimits limits;
  if (options.frames) limits.pictures = static_cast<std::size_t>(*options.frames);
  if (options.seconds) limits.length = Duration::from_seconds(*options.seconds);
  return limits;
}

ShowLimits limits_for(const RunOptions& options, const Camera& camera, bool offscreen) {
  ShowLimits limits = limits_for(options);
  // A folder would fill for ever.
  const bool endless = camera.length() == 0 && !camera.live() && !options.frames && !options.seconds;
  if (endless && offscreen)
    limits.pictures =
        static_cast<std::size_t>(std::lround((camera.period() > 0 ? camera.period() : film_seconds) * camera.rate()));
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

/// Where a show is to be seen, and whatever it shows.
struct Stage {
  Catalog catalog;
  std::string spec;
  bool offscreen = false;
  std::unique_ptr<Display> display{};
  std::unique_ptr<Graphics> graphics{};
};

Stage prepare(const RunOptions& options) {
  const std::string spec = display_spec(options);
  return {.catalog = load_catalog(options.catalog), .spec = spec, .offscreen = offscreen_folder(spec).has_value()};
}

/// A head that sees must be there before its camera; other displays come when pictures do.
HeadMount find_head(Stage& stage, const RunOptions& options) {
  if (stage.spec != "openxr") return {};
  if (options.wait) catch_interrupt();
  stage.display = open_display(stage.spec, display_options(options, stage.offscreen, screen_rate));
  const std::string headset = stage.display->headset();
  const auto mount = find_mount(headset, options.source.camera, options.head_camera);
  say(mount
          ? "where " + headset + " carries the camera: " + mount->from
          : "nobody has measured where " + headset +
                " carries this camera, so it is taken to be between the eyes; `onestroke calibrate head` measures it");
  return {.head = stage.display.get(), .T_head_camera = mount ? mount->T_head_camera : Pose{}};
}

void open(Stage& stage, const RunOptions& options, double rate) {
  if (!stage.display) stage.display = open_display(stage.spec, display_options(options, stage.offscreen, rate));
  stage.graphics = std::make_unique<Graphics>(
      *stage.display, Graphics::Wanted{.catalog = stage.catalog,
                                       .catalog_file = options.catalog,
                                       // A window shows how far the models are; files would show it for ever.
                                       .models_first = stage.offscreen,
                                       .gpu = gpu_options(options.gpu)});
}

/// The show from its first frame to its last.
struct Play {
  Feed& feed;
  ShowLimits limits;
  std::size_t expected = 0;  ///< Pictures; 0 where that is not known.
  SessionLog* log = nullptr;
};

fs::path snapshot_folder(const RunOptions& options, const std::string& display) {
  if (!options.snapshots.empty()) return options.snapshots;
  return offscreen_folder(display).value_or("snapshots");
}

void play(Stage& stage, const Play& what, const RunOptions& options, std::ostream& out) {
  Display& display = *stage.display;
  const fs::path folder = snapshot_folder(options, stage.spec);
  int snapshots = 0;
  try {
    Progress progress(!stage.offscreen);
    Show show({display, *stage.graphics, what.feed, what.log},
              {.fingers = options.fingers, .left_handed = options.left_handed, .snapshots = folder});
    show.run(what.limits, [&](std::size_t pictures) { progress.say(pictures, what.expected, " shown"); });
    snapshots = show.snapshots_saved();
  } catch (const std::exception&) {
    finish_all_the_same(display);
    throw;
  }
  display.finish();
  for (const std::string& line : display.report()) out << line << '\n';
  if (snapshots > 0)
    out << "wrote " << snapshots << (snapshots == 1 ? " snapshot" : " snapshots") << " to " << folder.string() << '\n';
}

/// Ends the log. A log that somebody asked for must be whole.
void finish(SessionLog& log, bool asked_for, std::ostream& out) {
  log.close();
  if (log.failure().empty())
    out << "wrote " << log.file().string() << "; `onestroke run --replay` shows it again\n";
  else if (asked_for)
    throw Error(log.failure());
  else
    say(log.failure());
}

int run_live(RunOptions options, std::ostream& out) {
  Stage stage = prepare(options);
  options.source = source_for(options.source, stage.offscreen);
  const HeadMount mount = find_head(stage, options);
  const std::unique_ptr<Camera> camera = open_worn_source(options.source, stage.catalog, mount);
  const double rate = camera->rate() > 0 ? camera->rate() : 30;
  open(stage, options, rate);
  const ShowLimits limits = limits_for(options, *camera, stage.offscreen);

  catch_interrupt();
  const std::unique_ptr<SessionLog> log = open_session_log(
      options, stage.spec,
      session_header(options, stage.offscreen ? rate : 0,
                     mount.head && camera->live() ? std::optional(mount.T_head_camera) : std::nullopt));
  StereoTracker tracker(stage.catalog);
  const Feed::Pace pace = pace_for(*camera, stage.offscreen);
  TrackingThread tracking(*camera, tracker,
                          pace == Feed::Pace::newest ? TrackingThread::Pacing::newest : TrackingThread::Pacing::every);
  FrameFeed feed(tracking, pace, stage.display->shows_world() ? PictureTime::seen : options.mode);
  play(stage, {feed, limits, pictures_expected(limits, *camera), log.get()}, options, out);
  if (log) finish(*log, !options.log.empty(), out);
  end_output(out);
  if (!feed.message().empty()) throw Error(feed.message());
  return 0;
}

int run_again(const RunOptions& given, std::ostream& out) {
  SessionReader session(given.replay);
  const RunOptions options = replay_options(session.header(), given);
  Stage stage = prepare(options);
  ReplayFeed feed(session);
  const HeadMount mount =
      session.header().T_head_camera ? HeadMount{&feed, *session.header().T_head_camera} : HeadMount{};
  const std::unique_ptr<Camera> camera = open_replay_camera(given, options, stage.catalog, mount);
  feed.use(camera.get());
  open(stage, options, session.header().rate > 0 ? session.header().rate : screen_rate);

  catch_interrupt();
  play(stage, {feed, limits_for(options)}, options, out);
  end_output(out);
  if (!feed.message().empty()) throw Error(feed.message());
  if (!session.note().empty()) say(session.note());
  if (camera && feed.dark_pictures() > 0)
    say("the camera lacks " + std::to_string(feed.dark_pictures()) +
        " of the session's pictures, and dark ones stand for them");
  return 0;
}

}  // namespace

int run_command(const RunOptions& options, std::ostream& out) {
  if (!options.replay.empty()) return run_again(options, out);
  RunOptions whole = options;
  whole.catalog = catalog_file(options);
  return run_live(std::move(whole), out);
}

}  // namespace onestroke

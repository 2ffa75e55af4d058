#include "app/command_line.h"

#include "app/argument_checks.h"
#include "app/completion.h"
#include "app/help_format.h"
#include "app/help_text.h"
#include "app/live_arguments.h"
#include "core/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace onestroke {
namespace {

constexpr double longest_readout_ms = 1000;

CLI::Validator camera_spec() {
  return one_of({{"synthetic", More::may}, {"libcamera", More::may}, {"file", More::must}, {"folder", More::must}},
                "synthetic[:KEY=VALUE,...], libcamera[:NAME], file:VIDEO or folder:DIR");
}

void add_camera(CLI::App& command, SourceOptions& options) {
  command.add_option("--camera", options.camera, help::camera)
      ->type_name("SPEC")
      ->check(camera_spec())
      ->capture_default_str();
  auto* fov = command.add_option("--fov", options.fov_deg, help::fov)->type_name("DEG");
  fov->check(number_between(1, 170, " degrees"));
  command.add_option("--calibration", options.calibration, help::calibration)->type_name("FILE.yaml")->excludes(fov);
  command.add_option("--readout-ms", options.readout_ms, help::readout)
      ->type_name("MS")
      ->check(number_between(0, longest_readout_ms, " milliseconds"));
  add_live_arguments(command, options.live);
}

void add_second_camera(CLI::App& command, SourceOptions& options) {
  auto* second = command.add_option("--second-camera", options.second_camera, help::second_camera);
  second->type_name("SPEC")->check(camera_spec());
  command.add_flag("--side-by-side", options.side_by_side, help::side_by_side)->excludes(second);
  auto* rig = command.add_option("--rig", options.rig, help::rig)->type_name("FILE.yaml")->check(not_empty());
  command.add_option("--baseline-mm", options.baseline_mm, help::baseline)
      ->type_name("MM")
      ->check(number_between(5, 1000, " millimetres"))
      ->excludes(rig);
}

void add_recording(CLI::App& command, SourceOptions& options, std::filesystem::path& record) {
  command.add_flag("--loop", options.playback.loop, help::loop);
  command
      .add_option_function<double>(
          "--from", [&options](double s) { options.playback.from = Duration::from_seconds(s); }, help::from)
      ->type_name("S")
      ->check(number_between(0, 1e6, " seconds"));
  command.add_option("--record", record, help::record)->type_name("DIR")->check(not_empty());
}

void add_frames(CLI::App& command, std::optional<int>& frames) {
  command.add_option("--frames", frames, help::frames)->type_name("N")->check(whole_number(1, 2'000'000'000));
}

void add_run(CLI::App& program, RunOptions& options) {
  CLI::App& run = *program.add_subcommand("run", help::run);
  run.footer(help::run_examples);
  add_camera(run, options.source);
  add_second_camera(run, options.source);
  run.add_option("--display", options.display, help::display)
      ->type_name("SPEC")
      ->check(one_of({{"window", More::none}, {"openxr", More::none}, {"offscreen", More::must}},
                     "window, openxr or offscreen:DIR"));
  run.add_option_function<std::string>(
         "--world",
         [&options](const std::string& name) {
           options.world = static_cast<World>(std::ranges::find(world_names, name) - world_names.begin());
         },
         help::world)
      ->type_name("WORLD")
      ->check(one_of({{"auto", More::none},
                      {"camera", More::none},
                      {"alpha", More::none},
                      {"additive", More::none},
                      {"passthrough", More::none}},
                     "auto, camera, alpha, additive or passthrough"));
  run.add_flag("--wait", options.wait, help::wait);
  run.add_flag("--stereo", options.stereo, help::stereo);
  run.add_flag_callback(
      "--no-mirror", [&options] { options.mirror = false; }, help::no_mirror);
  run.add_flag_callback(
      "--no-fingers", [&options] { options.fingers = false; }, help::no_fingers);
  run.add_flag("--left-handed", options.left_handed, help::left_handed);
  run.add_option("--snapshots", options.snapshots, help::snapshots)->type_name("DIR")->check(not_empty());
  run.add_option("--gpu", options.gpu, help::gpu)->type_name("NAME|NUMBER")->check(not_empty());
  run.add_option("--catalog", options.catalog, help::run_catalog)->type_name("FILE");
  const std::map<std::string, PictureTime> modes{{"exposure", PictureTime::exposure}, {"fresh", PictureTime::fresh}};
  run.add_option_function<std::string>(
         "--mode", [&options, modes](const std::string& m) { options.mode = modes.at(m); }, help::mode)
      ->type_name("MODE")
      ->check(one_of({{"exposure", More::none}, {"fresh", More::none}}, "exposure or fresh"));
  add_frames(run, options.frames);
  run.add_option("--seconds", options.seconds, help::seconds)
      ->type_name("S")
      ->check(number_between(1e-3, 1e6, " seconds"));
  run.add_option("--head-camera", options.head_camera, help::head_camera)->type_name("FILE")->check(not_empty());
  add_recording(run, options.source, options.record);
  run.add_option("--log", options.log, help::log)->type_name("FILE|none")->check(not_empty());
  auto* replay = run.add_option("--replay", options.replay, help::replay)->type_name("FILE")->check(not_empty());
  for (const char* fixed : {"--fov", "--calibration", "--readout-ms", "--world", "--stereo", "--no-fingers",
                            "--left-handed", "--catalog", "--mode", "--log"})
    replay->excludes(run.get_option(fixed));
}

void add_track(CLI::App& program, TrackOptions& options) {
  CLI::App& track = *program.add_subcommand("track", help::track);
  track.footer(help::track_examples);
  add_camera(track, options.source);
  add_second_camera(track, options.source);
  track.add_option("--catalog", options.catalog, help::catalog)->type_name("FILE")->required();
  track.add_option("--output", options.output, help::track_output)->type_name("FILE.jsonl");
  track.add_option("--overlay", options.overlay, help::overlay)->type_name("DIR");
  add_recording(track, options.source, options.record);
  track.add_flag("--independent", options.independent, help::independent);
  track.add_option("--threads", options.threads, help::threads)
      ->type_name("N")
      ->check(whole_number(1, 256))
      ->capture_default_str();
  add_frames(track, options.frames);
}

CLI::App& add_marker_action(CLI::App& marker, MarkerOptions& options, const std::string& name, const char* what,
                            const char* catalog, MarkerOptions::Action action) {
  CLI::App& command = *marker.add_subcommand(name, what);
  command.add_option("--catalog", options.catalog, catalog)->type_name("FILE")->required();
  command.callback([&options, action] { options.action = action; });
  return command;
}

void add_marker(CLI::App& program, MarkerOptions& options) {
  using Action = MarkerOptions::Action;
  CLI::App& marker = *program.add_subcommand("marker", help::marker);
  marker.footer(help::marker_examples);
  marker.require_subcommand(0, 1);
  CLI::App& import = add_marker_action(marker, options, "import", help::import, help::import_catalog, Action::import);
  import.add_option("file", options.input, help::import_file)->type_name("FILE.json")->required();
  import.add_flag("--replace", options.replace, help::replace);
  CLI::App& write = add_marker_action(marker, options, "export", help::export_, help::catalog, Action::export_);
  write.add_option("--output", options.output, help::export_output)->type_name("FILE.json");
  add_marker_action(marker, options, "list", help::list, help::catalog, Action::list);
  CLI::App& show = add_marker_action(marker, options, "show", help::show, help::catalog, Action::show);
  show.add_option("marker", options.which, help::which)->type_name("ID|NAME")->required();
}

/// What every calibration from a head that moves has.
void add_sights(CLI::App& command, CalibrateOptions& options) {
  add_camera(command, options.source);
  command.add_option("--catalog", options.catalog, help::catalog)->type_name("FILE");
  command.add_option("--display", options.display, help::calibrate_display)
      ->type_name("SPEC")
      ->check(one_of({{"openxr", More::none}}, "openxr"))
      ->capture_default_str();
  command.add_option("--seconds", options.seconds, help::calibrate_seconds)
      ->type_name("S")
      ->check(number_between(1e-3, 1e6, " seconds"));
  command.add_option("--gpu", options.gpu, help::gpu)->type_name("NAME|NUMBER")->check(not_empty());
  auto* poses = command.add_option("--head-poses", options.head_poses, help::head_poses);
  poses->type_name("FILE.jsonl")->check(not_empty());
  for (const char* live : {"--display", "--seconds", "--gpu"}) poses->excludes(command.get_option(live));
}

void add_calibrate_head(CLI::App& calibrate, CalibrateOptions& options) {
  CLI::App& head = *calibrate.add_subcommand("head", help::calibrate_head);
  head.footer(help::calibrate_examples);
  add_sights(head, options);
  head.add_option("--output", options.output, help::calibrate_output)
      ->type_name("FILE")
      ->required()
      ->check(not_empty());
  auto* replay = head.add_option("--replay", options.replay, help::calibrate_replay)->type_name("FILE");
  replay->check(not_empty());
  head.add_option("--headset", options.headset, help::headset)->type_name("NAME")->check(not_empty());
  for (const char* pictures : {"--camera", "--catalog", "--fov", "--calibration", "--readout-ms", "--head-poses",
                               "--display", "--seconds", "--gpu"})
    replay->excludes(head.get_option(pictures));
}

void add_calibrate_camera(CLI::App& calibrate, CalibrateOptions& options) {
  CLI::App& camera = *calibrate.add_subcommand("camera", help::calibrate_camera);
  camera.footer(help::calibrate_camera_examples);
  camera.add_flag("--clock", help::calibrate_clock)->required();
  add_sights(camera, options);
}

void add_calibrate(CLI::App& program, CalibrateOptions& options) {
  CLI::App& calibrate = *program.add_subcommand("calibrate", help::calibrate);
  calibrate.require_subcommand(0, 1);
  add_calibrate_head(calibrate, options);
  add_calibrate_camera(calibrate, options);
}

void add_doctor(CLI::App& program, DoctorOptions& options) {
  CLI::App& doctor = *program.add_subcommand("doctor", help::doctor);
  doctor.add_flag("--json", options.json, help::doctor_json);
}

/// The program's options and where their values go.
struct Program {
  CLI::App app{help::program, "onestroke"};
  RunOptions run;
  TrackOptions track;
  MarkerOptions marker;
  CalibrateOptions calibrate;
  DoctorOptions doctor;
  std::string completion;

  Program() {
    app.formatter(std::make_shared<HelpFormat>());
    app.footer(help::program_footer);
    app.set_version_flag("--version", "onestroke " ONESTROKE_VERSION);
    app.add_option("--completion", completion, help::completion)
        ->type_name("bash")
        ->check(one_of({{"bash", More::none}}, "bash"));
    app.require_subcommand(0, 1);
    add_run(app, run);
    add_track(app, track);
    add_marker(app, marker);
    add_calibrate(app, calibrate);
    add_doctor(app, doctor);
  }

  /// `onestroke track`, as far as the commands were understood.
  std::string command_path() const {
    std::string path = app.get_name();
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
      at = at->get_subcommands().back();
      path += " " + at->get_name();
    }
    return path;
  }
};

[[noreturn]] void refuse(const Program& program, std::string what) {
  std::ranges::replace(what, '\n', ' ');
  throw UsageError(what + "; see `" + program.command_path() + " --help`");
}

void check_threads(const Program& program, const TrackOptions& options) {
  if (options.threads == 1 || options.independent) return;
  refuse(program, "--threads " + std::to_string(options.threads) +
                      " needs --independent: pictures that follow each other are tracked one after the other");
}

void check_wait(const Program& program, const RunOptions& options) {
  if (options.wait && options.display != "openxr")
    refuse(program, "--wait is for a headset: give --display openxr with it, or leave it out");
}

void check_pair(const Program& program, const SourceOptions& options) {
  const bool placed = !options.rig.empty() || options.baseline_mm;
  if (placed && !options.pair())
    refuse(program, std::string(options.baseline_mm ? "--baseline-mm" : "--rig") +
                        " is for two cameras: add --second-camera SPEC or --side-by-side, or leave it out");
  if (options.pair() && !placed)
    refuse(program, "where the second camera sits is unknown: give --rig FILE.yaml or --baseline-mm MM");
  if (options.side_by_side && options.camera.starts_with("synthetic"))
    refuse(program,
           "the synthetic camera shows one eye's picture: give --second-camera synthetic in place of "
           "--side-by-side");
}

/// The command that was given, as `head` of `calibrate head`.
const CLI::App& innermost(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().back();
  return *at;
}

void check_source(const Program& program, const SourceOptions& options) {
  const std::string misplaced = misplaced_live_argument(innermost(program.app), options.camera);
  if (!misplaced.empty()) refuse(program, misplaced);
  check_pair(program, options);
  const bool recording = options.camera.starts_with("file:") || options.camera.starts_with("folder:");
  if (!recording && (options.playback.loop || options.playback.from.ns != 0))
    refuse(program, "--loop and --from are for recordings, and " + options.camera + " is none: leave them out");
  if (options.fov_deg || !options.calibration.empty() || !options.rig.empty()) return;
  // A folder may be a recording that knows its lens.
  for (const std::string& camera : {options.camera, options.second_camera})
    if (!camera.empty() && !camera.starts_with("synthetic") && !camera.starts_with("folder:"))
      refuse(program, "the lens of " + camera + " is unknown: give --fov DEG or --calibration FILE.yaml");
}

void check_replay(const Program& program) {
  if (program.run.replay.empty()) return;
  for (const char* known : {"--head-camera", "--loop", "--from", "--record"})
    if (program.app.get_subcommand("run")->count(known) > 0)
      refuse(program, std::string(known) + " is for new sessions, and a log is shown as it is: leave it out");
}

void check_worn(const Program& program, const RunOptions& options) {
  if (program.app.get_subcommand("run")->count("--world") == 0 || options.display == "openxr") return;
  refuse(program, "--world " + std::string(name_of(options.world)) + " is for a headset alone: add --display openxr");
}

/// The log of a session knows its own cameras.
void check_replayed_source(Program& program, SourceOptions& options) {
  if (options.side_by_side || !options.rig.empty() || options.baseline_mm)
    refuse(program, "the log knows how its two cameras sat: leave --side-by-side, --rig and --baseline-mm out");
  if (program.app.get_subcommand("run")->count("--camera") > 0) return;
  if (options.pair()) refuse(program, "--second-camera names the second one of other cameras: give --camera with it");
  options.camera.clear();
}

CalibrateOptions checked_calibrate(const Program& program) {
  const CLI::App& calibrate = *program.app.get_subcommand("calibrate");
  if (calibrate.get_subcommands().empty()) refuse(program, "what to calibrate is missing: head or camera");
  const CLI::App& what = innermost(calibrate);
  CalibrateOptions options = program.calibrate;
  if (!options.replay.empty()) return options;
  if (what.count("--camera") == 0) refuse(program, "the headset's camera is missing: give --camera SPEC");
  if (options.catalog.empty()) refuse(program, "the markers are missing: give --catalog FILE");
  if (!options.headset.empty() && options.head_poses.empty())
    refuse(program, "--headset is for recordings, since a headset says its name: leave it out");
  check_source(program, options.source);
  if (what.get_name() == "head") return options;
  options.what = CalibrateOptions::What::clock;
  options.recorded = options.source.camera.starts_with("folder");
  return options;
}

}  // namespace

Command parse_command_line(std::vector<std::string> arguments) {
  Program program;
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    program.app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    return PrintText{program.app.help()};
  } catch (const CLI::CallForVersion& version) {
    return PrintText{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    refuse(program, error.what());
  }
  if (!program.completion.empty()) return PrintText{bash_completion(program.app)};
  if (program.app.got_subcommand("marker")) {
    if (program.app.get_subcommand("marker")->get_subcommands().empty())
      refuse(program, "what to do with the markers is missing: import, export, list or show");
    return program.marker;
  }
  if (program.app.got_subcommand("track")) {
    check_source(program, program.track.source);
    check_threads(program, program.track);
    return program.track;
  }
  if (program.app.got_subcommand("calibrate")) return checked_calibrate(program);
  if (program.app.got_subcommand("doctor")) return program.doctor;
  if (!program.app.got_subcommand("run"))
    refuse(program, "a command is missing: run, track, marker, calibrate or doctor");
  check_replay(program);
  check_worn(program, program.run);
  check_wait(program, program.run);
  if (program.run.replay.empty())
    check_source(program, program.run.source);
  else
    check_replayed_source(program, program.run.source);
  return program.run;
}

}  // namespace onestroke

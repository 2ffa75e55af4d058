#pragma once

#include "camera/live_options.h"
#include "render/world.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace onestroke {

/// Where pictures come from and what is known of the lens; the camera factory reads `camera` further.
struct SourceOptions {
  std::string camera = "synthetic";     ///< synthetic[:KEY=VALUE,...], libcamera[:NAME], file:VIDEO or folder:DIR
  std::optional<double> fov_deg;        ///< Horizontal, degrees; never together with a calibration.
  std::filesystem::path calibration;    ///< OpenCV YAML; empty for none.
  std::optional<double> readout_ms;     ///< First row to last; unset where the camera says it or has a global shutter.
  LiveOptions live;                     ///< For `libcamera` alone.
  std::string second_camera{};          ///< The right eye's, as `camera`; empty for none.
  bool side_by_side = false;            ///< `camera` shows both eyes' pictures beside each other.
  std::filesystem::path rig{};          ///< How two cameras sit: OpenCV's stereo calibration, or
  std::optional<double> baseline_mm{};  ///< how far apart they are where they look the same way. One of these.

  bool pair() const { return side_by_side || !second_camera.empty(); }
};

enum class PictureTime {
  exposure,
  fresh,
  seen,  ///< No picture is shown, and models stand where they will be when the frame is seen.
};

struct RunOptions {
  SourceOptions source;
  std::string
      display;        ///< window, openxr or offscreen:DIR; empty for a window where there is a display, else off-screen
  bool wait = false;  ///< For a headset that is not there yet.
  std::filesystem::path catalog;    ///< Empty for the demo's own.
  World world = World::automatic;   ///< In a headset.
  bool stereo = false;              ///< Off-screen: a pair of eyes, side by side.
  bool mirror = true;               ///< Headset: a window beside it, where there is a screen.
  bool left_handed = false;         ///< The left hand points, the right one holds.
  std::filesystem::path snapshots;  ///< Their folder; empty for the usual one.
  bool fingers = true;              ///< Fingers that hold a stick are shown before the model behind them.
  std::string gpu;                  ///< Part of its name, or its number; empty for the fastest.
  PictureTime mode = PictureTime::exposure;
  std::optional<int> frames;      ///< Stop after so many pictures.
  std::optional<double> seconds;  ///< Stop after so long.
  std::string log;                ///< A file for the session's log, or none; empty for where it usually goes.
  /// The log of a session to be shown again, whose camera is taken where `source` names none; empty for a new session.
  std::filesystem::path replay;
  /// How the head carries the camera, as `onestroke calibrate head` wrote it; empty for what is known of the headset.
  std::filesystem::path head_camera;
};

struct TrackOptions {
  SourceOptions source;
  std::filesystem::path catalog;
  std::filesystem::path output;   ///< JSON lines; empty for standard output.
  std::filesystem::path overlay;  ///< Folder for pictures with the poses drawn in; empty for none.
  bool independent = false;       ///< Each picture alone, no memory.
  int threads = 1;
  std::optional<int> frames;
};

struct MarkerOptions {
  enum class Action { import, export_, list, show };
  Action action = Action::list;
  std::filesystem::path catalog{};  ///< The SQLite store; list and show also take the exchange JSON.
  std::filesystem::path input{};    ///< import: the JSON to read, or another store.
  std::filesystem::path output{};   ///< export: the JSON to write; empty for standard output.
  std::string which{};              ///< show: an id or a name.
  bool replace = false;             ///< import: new entries take the place of old ones with the same id.
};

/// `calibrate head` and `calibrate camera --clock`: live, from pictures with poses of the head, or from a session's
/// log.
struct CalibrateOptions {
  enum class What { head, clock };
  What what = What::head;
  SourceOptions source;
  std::string display = "openxr";
  std::filesystem::path catalog;
  std::filesystem::path output;
  std::filesystem::path head_poses, replay;  ///< One of them, or neither for a calibration that is live.
  bool recorded = false;                     ///< The camera is a recording that says where the head was.
  std::string headset;                       ///< Its name, for a recording that does not have it.
  std::string gpu;
  std::optional<double> seconds;  ///< Stop after so long; otherwise when there is enough.
};

struct DoctorOptions {
  bool json = false;
};

/// --help, --version, --completion: what to print before leaving.
struct PrintText {
  std::string text;
};

using Command = std::variant<RunOptions, TrackOptions, MarkerOptions, CalibrateOptions, DoctorOptions, PrintText>;

/// Reads the arguments after the program's name. Throws UsageError, one line with the remedy, where they are wrong.
/// Looks at no file.
Command parse_command_line(std::vector<std::string> arguments);

}  // namespace onestroke

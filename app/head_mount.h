#pragma once

#include "core/pose.h"
#include "tracking/head_calibration.h"

#include <filesystem>
#include <optional>
#include <string>

namespace onestroke {

/// How a headset carries a camera, and who says so.
struct HeadCameraMount {
  Pose T_head_camera{};
  std::string from{};  ///< For the user: "calibrated 2026-11-26, /home/.../headsets.json".
};

/// The mount of a headset's camera: what `file` says, where one is given; otherwise the user's own calibration of this
/// headset and camera; otherwise what the program comes with; otherwise none. `camera` is as for --camera. Throws Error
/// where a file is there and is not sound, or the given one is not there.
std::optional<HeadCameraMount> find_mount(const std::string& headset, const std::string& camera,
                                          const std::filesystem::path& file = {});

/// The user's own calibrations; empty where the environment names no place for them.
std::filesystem::path mounts_file();

/// What `onestroke calibrate head` found, and on what.
struct MountReport {
  HeadCalibration calibration{};
  std::string headset{}, camera{};
  std::string date{};  ///< "2026-11-26T18:40:00Z".
};

/// As JSON, which --head-camera reads: headset, camera, date, T_head_camera as [w, x, y, z, x, y, z] (quaternion, mm),
/// deviations and residuals in degrees and mm.
std::string to_json(const MountReport& report);
/// Puts it into a file of its own. Throws Error where that cannot be written.
void write_mount(const std::filesystem::path& file, const MountReport& report);
/// Puts it among the user's own calibrations, in the place of an older one of the same headset and camera. Throws
/// Error.
void keep_mount(const MountReport& report);

}  // namespace onestroke

#pragma once

#include "core/time.h"

#include <functional>
#include <optional>
#include <string>

namespace onestroke {

struct PictureSize {
  int width = 0, height = 0;
};

/// How a live camera is to take its pictures. What is not set is left to the camera.
struct LiveOptions {
  std::optional<PictureSize> size{};
  std::string format{};                   ///< nv12, yuyv, mjpeg or rgb; empty for the one that suits best.
  std::optional<double> rate{};           ///< Pictures a second.
  std::optional<Duration> exposure{};     ///< Fixed; unset for the camera's own automatic.
  std::optional<double> gain{};           ///< Of the sensor, fixed; 1 is none.
  std::optional<double> white_balance{};  ///< Kelvin, fixed.
  /// How much later than by the driver's word the light was gathered; negative for earlier.
  Duration clock_offset{};
  /// A camera that is silent for so long is started again.
  Duration patience = Duration::from_seconds(2);
  /// Hears, a line at a time, what was found out about the camera, what happened to it and what to do. On the thread
  /// that calls Camera::next(); may be empty.
  std::function<void(const std::string&)> say{};
};

}  // namespace onestroke

#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <array>
#include <cstdint>
#include <span>

namespace onestroke {

enum class MarkerState { measured, predicted, lost };

/// Fixed sizes keep a record free of allocation on its way through the lock-free queue.
inline constexpr int max_markers_per_frame = 16;
inline constexpr int max_cells_per_marker = 64;  // As many as an integer has bits.
inline constexpr int max_name_length = 47;

/// The centre of one cell as seen: pixels, centres at half-integers.
struct CellCentre {
  int index = 0;
  double u = 0, v = 0;
};

/// One marker in one picture.
struct MarkerObservation {
  int id = 0;
  std::array<char, max_name_length + 1> name{};  ///< Zero-terminated, cut to fit.
  MarkerState state = MarkerState::lost;
  Pose T_camera_marker;
  /// 6 x 6, row-major: a left perturbation of T_camera_marker, rotation vector (rad) then translation (mm), camera
  /// axes.
  std::array<double, 36> covariance{};
  /// Of T_camera_marker, the translation being that of the marker's origin; zero until two pictures are known, or one
  /// of a rolling shutter tells it.
  Velocity velocity;
  /// In the picture; of a pair in the first one, so that there are none of a marker that the second alone shows.
  int cells_seen = 0;
  std::array<CellCentre, max_cells_per_marker> cells{};  ///< The first cells_seen are valid.
  /// Which cells the second picture of a pair shows: a bit each, by its index.
  std::uint64_t second_cells = 0;
};

/// What the tracker says of one picture; the one record that tracking and rendering share.
struct FrameRecord {
  std::uint64_t sequence = 0;
  Time time;  ///< Middle of the exposure; the poses belong to it.
  Pose T_world_camera;
  Duration cost;  ///< Tracker's own time for this picture.
  Time tracked;   ///< When it was done, on CLOCK_MONOTONIC; zero where a recording tells.
  int marker_count = 0;
  std::array<MarkerObservation, max_markers_per_frame> markers{};

  std::span<const MarkerObservation> seen() const { return {markers.data(), static_cast<std::size_t>(marker_count)}; }
};

}  // namespace onestroke

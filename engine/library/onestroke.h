#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace onestroke {

/// The camera's lens, for pictures of one size. Either an ideal lens of a horizontal field of view, or a calibration.
struct CameraLens {
  /// Degrees, 1 to 179: square pixels, the axis through the picture's middle, and nothing below counts. 0 where the
  /// lens is calibrated.
  double horizontal_fov_deg = 0;
  /// Pixels, as OpenCV's calibration gives them: the centre of the first pixel is at (0, 0). fx and fy are 1 or more,
  /// and neither is more than four times the other.
  double fx = 0, fy = 0, cx = 0, cy = 0;
  /// OpenCV's k1 k2 p1 p2 k3; all zero for none.
  std::array<double, 5> distortion{};
};

/// How the bytes of a picture lie. yuyv and nv12 are BT.601 of limited range. Inks cannot be told in a grey picture:
/// it is taken, but no marker is found in it.
enum class PictureLayout : int {
  rgb = 0,   ///< 3 bytes a pixel: red, green, blue.
  gray = 1,  ///< 1 byte a pixel.
  nv12 = 2,  ///< A plane of Y, then one of interleaved U and V at half the size. Width and height are even.
  yuyv = 3,  ///< 4 bytes for two pixels: Y U Y V. The width is even.
};

/// One picture, top row first. The memory stays the caller's and is read during process() only.
struct CameraPicture {
  const std::uint8_t* data = nullptr;
  std::size_t stride = 0;                 ///< Bytes from one row to the next.
  const std::uint8_t* uv_data = nullptr;  ///< nv12 only: the plane of U and V; nullptr where it follows the rows of Y.
  std::size_t uv_stride = 0;              ///< nv12 only: bytes from one of its rows to the next; 0 for that of Y.
  int width = 0, height = 0;              ///< Pixels, 1 to 16384.
  PictureLayout layout = PictureLayout::rgb;
  /// When the first row began to gather light, nanoseconds on any clock that all pictures share.
  std::int64_t exposure_start_ns = 0;
  std::int64_t exposure_length_ns = 0;  ///< How long each row gathered light, 0 to 10 s.
  std::int64_t readout_ns = 0;          ///< From the first row's start to the last row's, 0 to 10 s; 0: global shutter.
  std::uint64_t sequence = 0;           ///< Anything; comes back with the markers.
};

/// Found in this picture; not found, and carried on at constant velocity; given up, with the pose that would have been.
enum class TrackedState : int { measured = 0, predicted = 1, lost = 2 };

/// One marker in one picture. Its pose takes marker to camera: p_camera = R p_marker + t. Camera axes: x right, y down,
/// z forward. Marker axes are those of its shape in the catalogue; an angle's arms meet at the origin, the start arm
/// along -y and the stop arm along +x.
struct TrackedMarker {
  int id = 0;             ///< As in the catalogue.
  std::string_view name;  ///< As in the catalogue; lives as long as the tracker.
  TrackedState state = TrackedState::lost;
  std::array<double, 9> rotation{};        ///< R, 3 x 3, row-major.
  std::array<double, 3> translation_mm{};  ///< t, millimetres.
  /// 6 x 6, row-major, camera axes: of a small rotation vector w (rad) and shift v (mm), R' = exp(w) R, t' = t + v.
  std::array<double, 36> covariance{};
  std::array<double, 3> angular_velocity{};  ///< rad/s, camera axes; zero until two pictures are known.
  std::array<double, 3> linear_velocity{};   ///< mm/s, of the marker's origin, camera axes; likewise.
  int cells_seen = 0;                        ///< Rings that showed their ink; 0 where not measured.
};

/// What process() says of one picture.
struct TrackedPicture {
  std::uint64_t sequence = 0;  ///< The picture's.
  std::int64_t time_ns = 0;    ///< Middle row's mid-exposure, to which the poses belong, on the pictures' clock.
  std::int64_t cost_ns = 0;    ///< How long it took.
  /// At most 16, the measured ones first. Valid until the tracker's next process() or its end.
  std::span<const TrackedMarker> markers;
};

struct MarkerTrackerOptions {
  /// Each picture alone, searched thoroughly: for sets of unrelated pictures. Otherwise markers are followed from
  /// picture to picture, which is much quicker.
  bool independent = false;
};

/// Picture in, marker poses out. A tracker serves one camera that stands still, or whose motion may count as the
/// markers'. One thread at a time uses a tracker; different trackers are independent of each other.
///
/// Everything but the destructor and the moves throws std::runtime_error, whose message names what is wrong and where,
/// and std::bad_alloc where memory runs out. A picture that is refused leaves the tracker as it was.
class MarkerTracker {
 public:
  /// Reads a catalogue: JSON as from_json() takes it, or the database that `onestroke marker import` makes.
  static MarkerTracker from_file(const std::string& catalog_file, const CameraLens& lens,
                                 const MarkerTrackerOptions& options = {});
  /// {"markers": [{"id": 1, "name": "first", "cells": "RGRB...", "shape": {"kind": "angle", "cells": 36, "pitch": 4,
  /// "radius": 3, "bend_radius": 0}}, ...]}, lengths in millimetres. An error names the entry and the key.
  static MarkerTracker from_json(const std::string& catalog_text, const CameraLens& lens,
                                 const MarkerTrackerOptions& options = {});
  ~MarkerTracker();
  /// A tracker that was moved from can only be assigned to or destroyed.
  MarkerTracker(MarkerTracker&&) noexcept;
  MarkerTracker& operator=(MarkerTracker&&) noexcept;

  /// Finds the catalogue's markers. Pictures come in the order of their times; one older than the last starts afresh.
  TrackedPicture process(const CameraPicture& picture);

 private:
  class Impl;
  explicit MarkerTracker(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

#pragma once

#include "core/frame_record.h"
#include "core/picture.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace onestroke::accuracy {

/// Where a marker of a picture truly is, and how many of its cells can be seen.
struct Truth {
  int id = 0;
  Pose T_camera_marker;
  int cells_visible = 0;
};

/// A picture of a set with its truth; borrowed during the call.
using Visit = std::function<void(const std::string& name, const Picture& picture, std::span<const Truth> truth)>;

/// Counts over a set of pictures. A marker is found where its id is reported with less than 10 degrees of rotation
/// error and its middle within 5 % of its distance; every other report is false. Markers of which fewer than 12 cells
/// can be seen are not asked for: found or not, they are not missed.
struct Score {
  int pictures = 0, asked = 0, found = 0;
  /// False reports that are in the right place, turned wrongly.
  int flips = 0;
  std::vector<double> rotation_deg;  ///< Of each marker found.
  std::vector<double> distance_pct;  ///< Of the distance of the marker's middle from the camera.
  std::vector<double> ms;            ///< The tracker's own time for each picture.
  std::vector<std::string> missed, wrong;

  void add(const std::string& picture, std::span<const Truth> truth, const FrameRecord& record);
  double found_pct() const { return asked > 0 ? 100.0 * found / asked : 100.0; }
};

/// q in [0, 1]; not a number where there are no values.
double quantile(std::vector<double> values, double q);

}  // namespace onestroke::accuracy

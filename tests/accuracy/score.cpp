#include "score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace onestroke::accuracy {
namespace {

constexpr double max_turn_deg = 10, max_shift = 0.05;
constexpr int cells_asked_for = 12;

// Middle of an angle with arms of 72 mm, marker frame.
constexpr Vec3 middle{24, -24, 0};

double turn_deg(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation) * 180 / std::numbers::pi;
}

bool in_place(const Pose& found, const Pose& truth) {
  return norm(found * middle - truth * middle) < max_shift * norm(truth * middle);
}

std::string label(const std::string& picture, int id) {
  return picture + " marker " + std::to_string(id);
}

}  // namespace

void Score::add(const std::string& picture, std::span<const Truth> truth, const FrameRecord& record) {
  ++pictures;
  ms.push_back(record.cost.ms());
  std::vector<MarkerObservation> left(record.seen().begin(), record.seen().end());
  for (const Truth& t : truth) {
    const auto hit = std::find_if(left.begin(), left.end(), [&](const MarkerObservation& o) {
      return o.id == t.id && turn_deg(o.T_camera_marker, t.T_camera_marker) < max_turn_deg &&
             in_place(o.T_camera_marker, t.T_camera_marker);
    });
    if (hit == left.end()) {
      if (t.cells_visible < cells_asked_for) continue;
      ++asked;
      missed.push_back(label(picture, t.id));
      continue;
    }
    ++asked;
    ++found;
    rotation_deg.push_back(turn_deg(hit->T_camera_marker, t.T_camera_marker));
    const double distance = norm(t.T_camera_marker * middle);
    distance_pct.push_back(100 * std::abs(norm(hit->T_camera_marker * middle) - distance) / distance);
    left.erase(hit);
  }
  for (const MarkerObservation& o : left) {
    wrong.push_back(label(picture, o.id));
    flips += std::any_of(truth.begin(), truth.end(), [&](const Truth& t) {
      return t.id == o.id && in_place(o.T_camera_marker, t.T_camera_marker);
    });
  }
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const auto at = static_cast<std::size_t>(q * static_cast<double>(values.size()));
  return values[std::min(at, values.size() - 1)];
}

}  // namespace onestroke::accuracy

#include "app/covered_cells.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

// A ring that is turned further to the camera than this shows too little of itself to be missed; cosine.
constexpr double end_on = 0.94;
// One ring alone that is not seen may be glare or blur.
constexpr std::size_t fewest_in_a_row = 2;

using CellSet = std::bitset<max_cells_per_marker>;

CellSet seen_cells(const MarkerObservation& m) {
  CellSet seen;
  for (int i = 0; i < m.cells_seen; ++i) {
    const int index = m.cells[static_cast<std::size_t>(i)].index;
    if (index >= 0 && index < max_cells_per_marker) seen.set(static_cast<std::size_t>(index));
  }
  return seen;
}

/// Whether another ring of the same stick is before this one.
bool hidden_by_itself(std::span<const Vec3> cells, std::size_t i, double radius) {
  const Vec3 p = cells[i];
  return std::any_of(cells.begin(), cells.end(), [&](Vec3 q) {
    const double apart = std::hypot(p.x / p.z - q.x / q.z, p.y / p.z - q.y / q.z) * p.z;
    return q.z < p.z - 2 * radius && apart < 2 * radius;
  });
}

}  // namespace

std::span<const CoveredCell> CoveredCells::find(const FrameRecord& record, const Picture& picture) {
  count_ = 0;
  for (const MarkerObservation& m : record.seen())
    if (m.state == MarkerState::measured && m.cells_seen > 0)
      add_covered({m.id, m.T_camera_marker, seen_cells(m)}, picture);
  return {covered_.data(), count_};
}

std::span<const CoveredCell> CoveredCells::find_in_second(const FrameRecord& record, const Picture& picture) {
  count_ = 0;
  const Pose T_second_first = inverse(picture.T_world_camera) * record.T_world_camera;
  for (const MarkerObservation& m : record.seen())
    if (m.state == MarkerState::measured && m.second_cells != 0)
      add_covered({m.id, T_second_first * m.T_camera_marker, m.second_cells}, picture);
  return {covered_.data(), count_};
}

void CoveredCells::add_covered(const Stick& stick, const Picture& picture) {
  const ShelfEntry* const entry = shelf_.find(stick.id);
  if (!entry) return;
  const std::size_t cells = std::min<std::size_t>(entry->cells.size(), max_cells_per_marker);
  std::array<Vec3, max_cells_per_marker> at;
  std::transform(entry->cells.begin(), entry->cells.begin() + static_cast<std::ptrdiff_t>(cells), at.begin(),
                 [&stick](Vec3 cell) { return stick.T_camera_marker * cell; });
  const std::span places(at.data(), cells);
  const auto missed = [&](std::size_t i) {
    const Vec3 p = at[i];
    if (stick.seen.test(i) || p.z <= 0) return false;
    const double u = picture.intrinsics.fx * p.x / p.z + picture.intrinsics.cx;
    const double v = picture.intrinsics.fy * p.y / p.z + picture.intrinsics.cy;
    if (!(u >= 0 && v >= 0 && u < picture.width && v < picture.height)) return false;
    const Vec3 along = normalized(at[std::min(i + 1, cells - 1)] - at[i == 0 ? 0 : i - 1]);
    return std::abs(dot(along, normalized(p))) < end_on && !hidden_by_itself(places, i, entry->radius);
  };
  for (std::size_t i = 0; i < cells;) {
    std::size_t end = i;
    while (end < cells && missed(end)) ++end;
    if (end - i >= fewest_in_a_row)
      for (std::size_t k = i; k < end && count_ < most; ++k) covered_[count_++] = {at[k], stick.id};
    i = end + 1;
  }
}

}  // namespace onestroke

#include "tracking/proposals.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace onestroke {
namespace {

constexpr std::size_t max_readings_per_marker = 60;
constexpr int max_singles_per_chain = 4;
// Chance makes rows of pieces by the hundred.
constexpr int max_joined_singles = 16;

// Of the points only those that lie on the straight arm which has most of them.
void keep_fullest_arm(const RodModel& rod, std::vector<CellPoint>& points) {
  const auto on = [&](int arm) {
    return std::count_if(points.begin(), points.end(), [&](const CellPoint& p) { return rod.arm_of(p.cell) == arm; });
  };
  int fullest = -1;
  for (const CellPoint& p : points)
    if (const int arm = rod.arm_of(p.cell); arm >= 0 && (fullest < 0 || on(arm) > on(fullest))) fullest = arm;
  std::erase_if(points, [&](const CellPoint& p) { return fullest < 0 || rod.arm_of(p.cell) != fullest; });
}

}  // namespace

Inks inks_of(const ImageView& image, const RodModel& rod, std::span<const CellPoint> points, int factor) {
  InkSamples samples;
  for (const CellPoint& c : points) {
    const double u = factor * c.pixel.x(), v = factor * c.pixel.y();
    if (image.contains(u, v)) samples.add(rod.ink(c.cell), image.sample(u, v));
  }
  return samples.mean();
}

// Calls visit(CellPoint) for the links that agree.
template <typename Visit>
void Proposer::for_points(const Reading& r, Visit visit) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  for (int i = r.begin; i < r.end; ++i) {
    const Chain::Link& l = chains_[static_cast<std::size_t>(r.chain)].links[static_cast<std::size_t>(i)];
    const Cell& cell = cells_[static_cast<std::size_t>(l.cell)];
    const int index = r.cell_of(l.position);
    if (index >= 0 && index < rod.cell_count() && rod.ink(index) == cell.ink) visit(CellPoint{index, cell.centre});
  }
}

Proposer::Row Proposer::row_of(const Reading& r) const {
  Row row;
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  row.low = rod.cell_count();
  double mean_s = 0, n = 0;
  Vec2d mean = Vec2d::Zero();
  for_points(r, [&](const CellPoint& p) {
    row.low = std::min(row.low, p.cell);
    row.high = std::max(row.high, p.cell);
    mean_s += rod.middle(p.cell).s;
    mean += p.pixel;
    ++n;
  });
  mean_s /= n;
  mean /= n;
  double ss = 0;
  Vec2d sp = Vec2d::Zero();
  for_points(r, [&](const CellPoint& p) {
    const double ds = rod.middle(p.cell).s - mean_s;
    ss += ds * ds;
    sp += ds * (p.pixel - mean);
  });
  row.slope = sp / std::max(ss, 1e-9);
  row.origin = mean - mean_s * row.slope;
  row.arm = rod.arm_of((row.low + row.high) / 2);
  row.middle = mean_s;
  return row;
}

// Two rows on neighbouring arms, prolonged, meet in the picture where the arms' axes do. Perspective bends the scale
// along an arm, so the tolerance grows with the distance prolonged.
bool Proposer::meet(const RodModel& rod, const Row& a, const Row& b) {
  if (a.arm < 0 || b.arm < 0 || a.arm == b.arm) return false;
  if (std::abs(a.arm - b.arm) > 1) return true;
  const Row &first = a.arm < b.arm ? a : b, &second = a.arm < b.arm ? b : a;
  const RodModel::Meeting& m = rod.meeting(first.arm);
  const Vec2d p = first.origin + m.on_arm * first.slope, q = second.origin + m.on_next * second.slope;
  const double prolonged = std::abs(m.on_arm - first.middle) * first.slope.norm() +
                           std::abs(m.on_next - second.middle) * second.slope.norm();
  const double diameter = 2 * rod.radius() * std::max(first.slope.norm(), second.slope.norm());
  return (p - q).norm() < 0.25 * prolonged + diameter;
}

bool Proposer::compatible(const Reading& a, const Row& row_a, const Reading& b, const Row& row_b) const {
  if (a.score() + b.score() < limits_.min_pair_score) return false;
  // Rows may share the cell at the corner.
  if (std::min(row_a.high, row_b.high) - std::max(row_a.low, row_b.low) + 1 > 1) return false;
  if (a.chain == b.chain && a.begin < b.end - 1 && b.begin < a.end - 1) return false;
  return meet(rods_[static_cast<std::size_t>(a.marker)], row_a, row_b);
}

double Proposer::max_rms(const Intrinsics& k, const RodModel& rod, const EigenPose& pose) {
  return 0.35 * pitch_in_pixels(k, rod, pose) + 0.5;
}

void Proposer::find(const std::vector<bool>& skip, std::vector<ReadingPair>& pairs) const {
  order_.clear();
  for (std::size_t i = 0; i < readings_.size(); ++i)
    if (skip.empty() || !skip[static_cast<std::size_t>(readings_[i].marker)]) order_.push_back(static_cast<int>(i));
  const auto marker_of = [&](int i) { return readings_[static_cast<std::size_t>(i)].marker; };
  std::sort(order_.begin(), order_.end(),
            [&](int a, int b) { return std::pair(marker_of(a), a) < std::pair(marker_of(b), b); });
  for (auto first = order_.begin(), last = first; first != order_.end(); first = last) {
    const int m = marker_of(*first);
    last = std::find_if(first, order_.end(), [&](int i) { return marker_of(i) != m; });
    const auto count = std::min(static_cast<std::size_t>(last - first), max_readings_per_marker);
    const std::span<const int> list(first, count);
    const RodModel& rod = rods_[static_cast<std::size_t>(m)];
    rows_.clear();
    for (const int i : list) rows_.push_back(row_of(readings_[static_cast<std::size_t>(i)]));
    for (std::size_t i = 0; i < count; ++i) {
      const Reading& a = readings_[static_cast<std::size_t>(list[i])];
      if (rod.arm_of(rows_[i].low) != rod.arm_of(rows_[i].high)) pairs.push_back({m, list[i], -1, a.score()});
      for (std::size_t j = i + 1; j < count; ++j) {
        const Reading& b = readings_[static_cast<std::size_t>(list[j])];
        if (compatible(a, rows_[i], b, rows_[j])) pairs.push_back({m, list[i], list[j], a.score() + b.score()});
      }
    }
  }
}

void Proposer::points_of(const ReadingPair& pair, Points& points) const {
  points.clear();
  int low = max_cells, high = -1;
  for_points(readings_[static_cast<std::size_t>(pair.first)], [&](const CellPoint& p) {
    points.push_back(p);
    low = std::min(low, p.cell);
    high = std::max(high, p.cell);
  });
  if (pair.second < 0) return;
  for_points(readings_[static_cast<std::size_t>(pair.second)], [&](const CellPoint& p) {
    if (p.cell < low || p.cell > high) points.push_back(p);
  });
}

void Proposer::pairs(const Intrinsics& k, const std::vector<bool>& skip, std::vector<Proposal>& proposals) const {
  std::vector<ReadingPair> found;
  find(skip, found);
  Points points;
  for (const ReadingPair& pair : found) {
    points_of(pair, points);
    const RodModel& rod = rods_[static_cast<std::size_t>(pair.marker)];
    Proposal p{pair.marker, {points.begin(), points.end()}, {}, pair.score};
    p.guesses = poses_from_cells(k, rod, p.points);
    if (p.guesses.empty() || p.guesses.front().rms >= max_rms(k, rod, p.guesses.front().pose)) continue;
    proposals.push_back(std::move(p));
  }
}

void Proposer::singles(const std::vector<bool>& skip, std::vector<Proposal>& proposals) const {
  std::vector<int> best(chains_.size(), 0), count(chains_.size(), 0);
  int joined = 0;
  for (const Reading& r : readings_) {
    const auto c = static_cast<std::size_t>(r.chain);
    best[c] = std::max(best[c], r.score());
    if (!skip.empty() && skip[static_cast<std::size_t>(r.marker)]) continue;
    if (r.score() < std::max(limits_.min_single_score, best[c] - 1) || ++count[c] > max_singles_per_chain) continue;
    if (!chains_[c].joints.empty() && ++joined > max_joined_singles) continue;
    Proposal p{r.marker, {}, {}, r.score()};
    for_points(r, [&](const CellPoint& point) { p.points.push_back(point); });
    // A row on one arm may seem to run a cell or two round a corner that turns towards the camera.
    keep_fullest_arm(rods_[static_cast<std::size_t>(r.marker)], p.points);
    p.score -= r.agree - static_cast<int>(p.points.size());
    if (p.score >= limits_.min_single_score) proposals.push_back(std::move(p));
  }
}

}  // namespace onestroke

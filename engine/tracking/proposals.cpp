#include "tracking/proposals.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace onestroke {
namespace {

constexpr std::size_t max_readings_per_marker = 60;
constexpr int max_singles_per_chain = 4;
// Chance makes rows of pieces by the hundred.
constexpr int max_joined_singles = 16;

}  // namespace

Inks inks_of(const ImageView& image, const RodModel& rod, const Proposal& proposal, int factor) {
  InkSamples samples;
  for (const CellPoint& c : proposal.points) {
    const double u = factor * c.pixel.x(), v = factor * c.pixel.y();
    if (image.contains(u, v)) samples.add(rod.ink(c.cell), image.sample(u, v));
  }
  return samples.mean();
}

namespace {

// Those of the points that lie on the straight arm which has most of them.
std::vector<CellPoint> on_fullest_arm(const RodModel& rod, const std::vector<CellPoint>& points) {
  const auto on = [&](int arm) {
    return std::count_if(points.begin(), points.end(), [&](const CellPoint& p) { return rod.arm_of(p.cell) == arm; });
  };
  int fullest = -1;
  for (const CellPoint& p : points)
    if (const int arm = rod.arm_of(p.cell); arm >= 0 && (fullest < 0 || on(arm) > on(fullest))) fullest = arm;
  std::vector<CellPoint> kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept),
               [&](const CellPoint& p) { return fullest >= 0 && rod.arm_of(p.cell) == fullest; });
  return kept;
}

}  // namespace

// A reading as a line in the picture: pixel = origin + slope * arc length.
struct Proposer::Row {
  std::vector<CellPoint> points;
  int low = 0, high = 0;  // Cells.
  int arm = -1;
  double middle = 0;  // Arc length of the points' mean.
  Vec2d origin, slope;
};

void Proposer::append_points(const Reading& r, std::vector<CellPoint>& points) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  for (int i = r.begin; i < r.end; ++i) {
    const Chain::Link& l = chains_[static_cast<std::size_t>(r.chain)].links[static_cast<std::size_t>(i)];
    const Cell& cell = cells_[static_cast<std::size_t>(l.cell)];
    const int index = r.cell_of(l.position);
    if (index < 0 || index >= rod.cell_count() || rod.ink(index) != cell.ink) continue;
    points.push_back({index, cell.centre});
  }
}

Proposer::Row Proposer::row_of(const Reading& r) const {
  Row row;
  append_points(r, row.points);
  const RodModel& rod = rods_[static_cast<std::size_t>(r.marker)];
  row.low = rod.cell_count();
  double mean_s = 0;
  Vec2d mean = Vec2d::Zero();
  for (const CellPoint& p : row.points) {
    row.low = std::min(row.low, p.cell);
    row.high = std::max(row.high, p.cell);
    mean_s += rod.middle(p.cell).s;
    mean += p.pixel;
  }
  const auto n = static_cast<double>(row.points.size());
  mean_s /= n;
  mean /= n;
  double ss = 0;
  Vec2d sp = Vec2d::Zero();
  for (const CellPoint& p : row.points) {
    const double ds = rod.middle(p.cell).s - mean_s;
    ss += ds * ds;
    sp += ds * (p.pixel - mean);
  }
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

void Proposer::add(const Intrinsics& k, Proposal p, std::vector<Proposal>& proposals) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(p.marker)];
  p.guesses = poses_from_cells(k, rod, p.points);
  if (p.guesses.empty()) return;
  const double limit = 0.35 * pitch_in_pixels(k, rod, p.guesses.front().pose) + 0.5;
  if (p.guesses.front().rms < limit) proposals.push_back(std::move(p));
}

void Proposer::pairs(const Intrinsics& k, const std::vector<bool>& skip, std::vector<Proposal>& proposals) const {
  std::vector<std::vector<const Reading*>> by_marker(rods_.size());
  for (const Reading& r : readings_) {
    const auto m = static_cast<std::size_t>(r.marker);
    if (!skip.empty() && skip[m]) continue;
    if (by_marker[m].size() < max_readings_per_marker) by_marker[m].push_back(&r);
  }
  for (std::size_t m = 0; m < rods_.size(); ++m) {
    const auto& list = by_marker[m];
    std::vector<Row> rows;
    for (const Reading* r : list) rows.push_back(row_of(*r));
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Row& a = rows[i];
      if (rods_[m].arm_of(a.low) != rods_[m].arm_of(a.high))
        add(k, {static_cast<int>(m), a.points, {}, list[i]->score()}, proposals);
      for (std::size_t j = i + 1; j < list.size(); ++j) {
        if (!compatible(*list[i], a, *list[j], rows[j])) continue;
        Proposal p{static_cast<int>(m), a.points, {}, list[i]->score() + list[j]->score()};
        for (const CellPoint& q : rows[j].points)
          if (q.cell < a.low || q.cell > a.high) p.points.push_back(q);
        add(k, std::move(p), proposals);
      }
    }
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
    // A row on one arm may seem to run a cell or two round a corner that turns towards the camera.
    std::vector<CellPoint> points = on_fullest_arm(rods_[static_cast<std::size_t>(r.marker)], row_of(r).points);
    const int lost = r.agree - static_cast<int>(points.size());
    if (r.score() - lost < limits_.min_single_score) continue;
    proposals.push_back({r.marker, std::move(points), {}, r.score() - lost});
  }
}

}  // namespace onestroke

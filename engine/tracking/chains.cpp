#include "tracking/chains.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

constexpr double grid_size = 32;

}  // namespace

// Cells lie `steps` positions apart on one row: both are wider than long across the line that joins them, of like
// width, and the distance fits the lengths. Touching cells differ in ink.
bool ChainFinder::fits(const std::vector<Cell>& cells, int first, int second, int steps) const {
  const Cell &a = cells[static_cast<std::size_t>(first)], &b = cells[static_cast<std::size_t>(second)];
  if (steps == 1 && a.ink == b.ink) return false;
  const Eigen::Vector2d v = b.centre - a.centre;
  const double square = v.squaredNorm();
  const double most =
      steps *
      (0.95 * std::max(longest_[static_cast<std::size_t>(first)], longest_[static_cast<std::size_t>(second)]) + 1.5);
  if (square < 1 || square > most * most) return false;
  const double d = std::sqrt(square);
  const Eigen::Vector2d u = v / d, n(-u.y(), u.x());
  const double wa = a.extent(n), wb = b.extent(n), la = a.extent(u), lb = b.extent(u);
  if (wa > 1.8 * wb + 1 || wb > 1.8 * wa + 1) return false;
  if (la > 1.15 * wa + 1.5 || lb > 1.15 * wb + 1.5) return false;
  if (d / steps > 0.95 * std::max(wa, wb) + 1.5) return false;
  if (steps > 1) return true;
  const double mean = (la + lb) / 2;
  return d > 0.5 * mean - 0.5 && d < 1.5 * mean + 1.5;
}

void ChainFinder::build_grid(const std::vector<Cell>& cells, int width, int height) {
  grid_width_ = static_cast<int>(width / grid_size) + 1;
  grid_height_ = static_cast<int>(height / grid_size) + 1;
  grid_start_.assign(static_cast<std::size_t>(grid_width_ * grid_height_) + 1, 0);
  const auto slot = [&](const Cell& c) {
    return static_cast<std::size_t>(static_cast<int>(c.centre.y() / grid_size) * grid_width_ +
                                    static_cast<int>(c.centre.x() / grid_size));
  };
  for (const Cell& c : cells) ++grid_start_[slot(c)];
  for (std::size_t i = 1; i < grid_start_.size(); ++i) grid_start_[i] += grid_start_[i - 1];
  grid_cells_.resize(cells.size());
  for (std::size_t i = cells.size(); i-- > 0;)
    grid_cells_[static_cast<std::size_t>(--grid_start_[slot(cells[i])])] = static_cast<int>(i);
}

template <typename Visit>
void ChainFinder::near(const Eigen::Vector2d& centre, double radius, Visit visit) const {
  const int x0 = std::max(0, static_cast<int>((centre.x() - radius) / grid_size));
  const int x1 = std::min(grid_width_ - 1, static_cast<int>((centre.x() + radius) / grid_size));
  const int y0 = std::max(0, static_cast<int>((centre.y() - radius) / grid_size));
  const int y1 = std::min(grid_height_ - 1, static_cast<int>((centre.y() + radius) / grid_size));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const auto s = static_cast<std::size_t>(y * grid_width_ + x);
      for (int k = grid_start_[s]; k < grid_start_[s + 1]; ++k) visit(grid_cells_[static_cast<std::size_t>(k)]);
    }
}

// Extends the row at its end while a cell lies where the last step says, one to max_gap + 1 positions on.
void ChainFinder::grow(const std::vector<Cell>& cells, const ChainOptions& options, Walk& walk) const {
  for (;;) {
    const Chain::Link last = walk.links.back();
    const Cell& from = cells[static_cast<std::size_t>(last.cell)];
    const double step = walk.step.norm();
    int best = -1, best_steps = 0;
    double best_cost = 1;
    const int reach = walk.links.size() > 2 ? options.max_gap + 1 : 2;
    for (int steps = 1; steps <= reach && best < 0; ++steps) {
      const Eigen::Vector2d expected = from.centre + steps * walk.step;
      const double tolerance = 0.35 * step + 0.8 + 0.1 * (steps - 1) * step;
      near(expected, tolerance, [&](int k) {
        if (k == last.cell) return;
        const Cell& c = cells[static_cast<std::size_t>(k)];
        const double cost = (c.centre - expected).squaredNorm() / (tolerance * tolerance);
        if (cost < best_cost && fits(cells, last.cell, k, steps)) {
          best_cost = cost;
          best = k;
          best_steps = steps;
        }
      });
    }
    if (best < 0 || walk.links.full()) return;
    for (const Chain::Link& l : walk.links)
      if (l.cell == best) return;
    const Eigen::Vector2d seen = (cells[static_cast<std::size_t>(best)].centre - from.centre) / best_steps;
    walk.links.push_back({best, last.position + best_steps});
    // Averaging steadies the direction; the newest half follows perspective.
    walk.step = 0.5 * walk.step + 0.5 * seen;
  }
}

void ChainFinder::seed(const std::vector<Cell>& cells, int first, const ChainOptions& options,
                       std::vector<Chain>& chains) {
  const Cell& a = cells[static_cast<std::size_t>(first)];
  const double reach = 2 * longest_[static_cast<std::size_t>(first)] + 4;
  partners_.clear();
  near(a.centre, reach, [&](int k) {
    if (k == first) return;
    for (int steps = 1; steps <= 2; ++steps)
      if (fits(cells, first, k, steps)) {
        partners_.emplace_back(steps, k);
        break;
      }
  });
  std::sort(partners_.begin(), partners_.end());
  Walk best;
  for (const auto& [steps, k] : partners_) {
    Walk walk;
    walk.links.push_back({first, 0});
    walk.links.push_back({k, steps});
    walk.step = (cells[static_cast<std::size_t>(k)].centre - a.centre) / steps;
    grow(cells, options, walk);
    // Turn round and grow the other end.
    const int last = walk.links.back().position;
    std::reverse(walk.links.begin(), walk.links.end());
    for (Chain::Link& l : walk.links) l.position = last - l.position;
    const auto n = walk.links.size();
    const Chain::Link &p = walk.links[n - 2], &q = walk.links[n - 1];
    walk.step = (cells[static_cast<std::size_t>(q.cell)].centre - cells[static_cast<std::size_t>(p.cell)].centre) /
                (q.position - p.position);
    grow(cells, options, walk);
    if (walk.links.size() > best.links.size()) best = walk;
  }
  if (static_cast<int>(best.links.size()) < options.min_cells) return;
  Chain& chain = chains.emplace_back();
  chain.links = best.links;
  widths_.clear();
  const Eigen::Vector2d along = (cells[static_cast<std::size_t>(chain.links.back().cell)].centre -
                                 cells[static_cast<std::size_t>(chain.links.front().cell)].centre)
                                    .normalized();
  for (const Chain::Link& l : chain.links) {
    in_chain_[static_cast<std::size_t>(l.cell)] = 1;
    widths_.push_back(cells[static_cast<std::size_t>(l.cell)].extent({-along.y(), along.x()}));
  }
  const auto middle = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 2);
  std::nth_element(widths_.begin(), middle, widths_.end());
  chain.width = *middle;
}

void ChainFinder::find(const std::vector<Cell>& cells, int width, int height, const ChainOptions& options,
                       std::vector<Chain>& chains) {
  chains.clear();
  build_grid(cells, width, height);
  in_chain_.assign(cells.size(), 0);
  longest_.clear();
  for (const Cell& c : cells) longest_.push_back(std::sqrt(12 * c.covariance.trace()));
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!in_chain_[i]) seed(cells, static_cast<int>(i), options, chains);
}

}  // namespace onestroke

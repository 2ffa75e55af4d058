#include "tracking/row_joiner.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// Positions that a cover may hide.
constexpr double max_gap = 13;
// How far off one piece's line the next may lie: of the rod's width, and of the way to it.
constexpr double off_by_width = 0.3, off_by_distance = 0.1;
// Rods look thicker and cells longer where they are nearer.
constexpr double max_width_ratio = 1.6, max_step_ratio = 2;
// How far off the number of cells in a gap may be, positions; and where the gap is long and a piece short, so that a
// tip's disc or a cell half covered falsifies its spacing, the share of the gap besides.
constexpr double off_by_place = 0.78, off_by_spacing = 0.06, long_gap = 7;
constexpr std::size_t short_piece = 3;
constexpr std::size_t max_joined = 300;

double ratio(double a, double b) {
  return std::max(a, b) / std::max(1e-9, std::min(a, b));
}

double off_line(const Eigen::Vector2d& direction, const Eigen::Vector2d& v) {
  return std::abs(direction.x() * v.y() - direction.y() * v.x());
}

}  // namespace

RowJoiner::Piece RowJoiner::piece_of(const std::vector<Cell>& cells, const Chain& chain, int index, bool reversed) {
  const auto n = static_cast<double>(chain.links.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), sum = Eigen::Vector2d::Zero();
  double mean_position = 0, square = 0;
  for (const Chain::Link& l : chain.links) {
    mean += cells[static_cast<std::size_t>(l.cell)].centre / n;
    mean_position += l.position / n;
  }
  for (const Chain::Link& l : chain.links) {
    const double p = l.position - mean_position;
    sum += p * (cells[static_cast<std::size_t>(l.cell)].centre - mean);
    square += p * p;
  }
  const Eigen::Vector2d slope = sum / std::max(square, 1e-9);
  const double first = chain.links.front().position - mean_position, last = chain.links.back().position - mean_position;
  Piece p{index, reversed, mean, mean + first * slope, mean + last * slope, slope.normalized(), slope.norm()};
  if (!reversed) return p;
  std::swap(p.first, p.last);
  p.direction = -p.direction;
  return p;
}

void RowJoiner::find_links(const std::vector<Chain>& chains) {
  links_.assign(pieces_.size(), {});
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    for (std::size_t j = 0; j < pieces_.size(); ++j) {
      const Piece &a = pieces_[i], &b = pieces_[j];
      if (a.chain == b.chain || a.direction.dot(b.direction) < 0.9 || ratio(a.step, b.step) > max_step_ratio) continue;
      const double wa = chains[static_cast<std::size_t>(a.chain)].width,
                   wb = chains[static_cast<std::size_t>(b.chain)].width;
      if (ratio(wa, wb) > max_width_ratio) continue;
      const Eigen::Vector2d way = b.first - a.last;
      const double distance = way.norm(), limit = off_by_width * std::min(wa, wb) + off_by_distance * distance;
      if (way.dot(a.direction) <= 0.5 * a.step || off_line(a.direction, way) > limit ||
          off_line(b.direction, way) > limit)
        continue;
      // Along a line seen in perspective positions go as the distance over the geometric mean of the spacings.
      const double across_a = (a.last - a.middle).norm() / a.step, across_b = (b.middle - b.first).norm() / b.step;
      const double gap = (b.middle - a.middle).norm() / std::sqrt(a.step * b.step) - across_a - across_b;
      if (gap < 0.7 || gap > max_gap) continue;
      const std::size_t fewest = std::min(chains[static_cast<std::size_t>(a.chain)].links.size(),
                                          chains[static_cast<std::size_t>(b.chain)].links.size());
      const double off = off_by_place + (fewest <= short_piece && gap > long_gap ? off_by_spacing * gap : 0);
      for (int g = std::max(1, static_cast<int>(std::ceil(gap - off))); g <= gap + off; ++g)
        links_[i].push_back({j, g});
    }
}

// The cells of one more piece behind those of a row.
Chain RowJoiner::joined(const std::vector<Chain>& chains, const Piece& a, const Piece& b, int gap, Chain row) {
  const auto append = [&](const Piece& p, int offset) {
    const Chain& c = chains[static_cast<std::size_t>(p.chain)];
    const int end = c.length() - 1;
    for (std::size_t k = 0; k < c.links.size(); ++k) {
      const Chain::Link& l = c.links[p.reversed ? c.links.size() - 1 - k : k];
      row.links.push_back({l.cell, offset + (p.reversed ? end - l.position : l.position)});
    }
  };
  if (row.links.empty()) append(a, 0);
  row.joints.push_back(static_cast<int>(row.links.size()));
  append(b, row.links.back().position + gap);
  row.width = std::max(row.width, chains[static_cast<std::size_t>(b.chain)].width);
  return row;
}

void RowJoiner::join(const std::vector<Cell>& cells, std::size_t min_cells, std::vector<Chain>& chains) {
  pieces_.clear();
  for (std::size_t c = 0; c < chains.size(); ++c)
    for (const bool reversed : {false, true})
      pieces_.push_back(piece_of(cells, chains[c], static_cast<int>(c), reversed));
  find_links(chains);
  std::vector<Chain> rows;
  const auto keep = [&](const Piece& first, const Piece& last, Chain row) {
    // The same the other way round is no other row.
    if (first.chain < last.chain && row.links.size() >= min_cells && rows.size() < max_joined)
      rows.push_back(std::move(row));
  };
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    for (const Link& one : links_[i]) {
      const Chain two = joined(chains, pieces_[i], pieces_[one.to], one.gap, {});
      keep(pieces_[i], pieces_[one.to], two);
      for (const Link& more : links_[one.to])
        if (pieces_[more.to].chain != pieces_[i].chain)
          keep(pieces_[i], pieces_[more.to], joined(chains, pieces_[one.to], pieces_[more.to], more.gap, two));
    }
  std::move(rows.begin(), rows.end(), std::back_inserter(chains));
}

}  // namespace onestroke

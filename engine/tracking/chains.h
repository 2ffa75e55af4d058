#pragma once

#include "core/inline_vector.h"
#include "tracking/cells.h"

#include <utility>
#include <vector>

namespace onestroke {

/// A straight row of cells as seen in the picture. Positions count cells along the row; gaps (a cell merged with the
/// background or lost in a highlight) leave positions out.
struct Chain {
  struct Link {
    int cell;      ///< Index into the cells given.
    int position;  ///< 0 at the row's first cell, rising.
  };
  using Links = InlineVector<Link, 96>;
  Links links;
  double width = 0;  ///< Median width of the rod across the row, pixels.
  /// Of a row joined from pieces: the link that begins each piece but the first.
  std::vector<int> joints;

  int length() const { return links.empty() ? 0 : links.back().position + 1; }
};

struct ChainOptions {
  int min_cells = 4;
  /// Cells left out in one step that a row may jump over.
  int max_gap = 2;
};

/// Finds rows of neighbouring cells: ring cells are wider than long, of even width, evenly spaced along a straight
/// line, and touching cells differ in ink. Keeps its memory between pictures.
class ChainFinder {
 public:
  void find(const std::vector<Cell>& cells, int width, int height, const ChainOptions& options,
            std::vector<Chain>& chains);

 private:
  struct Walk {
    Chain::Links links;
    Eigen::Vector2d step;  // One position along the row, pixels.
  };
  void build_grid(const std::vector<Cell>& cells, int width, int height);
  template <typename Visit>
  void near(const Eigen::Vector2d& centre, double radius, Visit visit) const;
  bool fits(const std::vector<Cell>& cells, int a, int b, int steps) const;
  void grow(const std::vector<Cell>& cells, const ChainOptions& options, Walk& walk) const;
  void seed(const std::vector<Cell>& cells, int first, const ChainOptions& options, std::vector<Chain>& chains);

  int grid_width_ = 0, grid_height_ = 0;
  std::vector<int> grid_start_, grid_cells_;
  std::vector<std::uint8_t> in_chain_;
  std::vector<double> longest_;  // No cell is wider or longer than this, pixels.
  std::vector<std::pair<int, int>> partners_;
  std::vector<double> widths_;
};

}  // namespace onestroke

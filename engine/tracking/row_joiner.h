#pragma once

#include "tracking/chains.h"

#include <vector>

namespace onestroke {

/// Joins rows of cells that something lies across: pieces on one line, of like width and spacing. Keeps its memory
/// between pictures.
class RowJoiner {
 public:
  /// Appends a chain for each way of joining two or three of the chains given that makes a row of `min_cells` at least.
  /// How many cells are covered between two pieces follows from their spacing and its change by perspective; there is a
  /// chain for each number that this leaves.
  void join(const std::vector<Cell>& cells, std::size_t min_cells, std::vector<Chain>& chains);

 private:
  /// A chain read in one of its two directions, as a line in the picture.
  struct Piece {
    int chain;
    bool reversed;
    Eigen::Vector2d middle, first, last, direction;
    double step;  ///< Pixels a position, at the middle.
  };
  struct Link {
    std::size_t to;
    int gap;  ///< Positions from the last cell of the one piece to the first cell of the next.
  };
  static Piece piece_of(const std::vector<Cell>& cells, const Chain& chain, int index, bool reversed);
  void find_links(const std::vector<Chain>& chains);
  static Chain joined(const std::vector<Chain>& chains, const Piece& a, const Piece& b, int gap, Chain so_far);

  std::vector<Piece> pieces_;
  std::vector<std::vector<Link>> links_;
};

}  // namespace onestroke

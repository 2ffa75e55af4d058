#include "tracking/row_joiner.h"

#include "row_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace onestroke::test {
namespace {

constexpr std::size_t min_cells = 7;

/// Pieces of one row of twenty cells seen in perspective: a cell's place in the row is its index among the cells.
class Joining : public ::testing::Test {
 protected:
  /// shrink: each step's length against the last one's.
  void draw(double shrink) {
    Eigen::Vector2d at(100, 80);
    double pitch = 12;
    for (int i = 0; i < 20; ++i) {
      cells_.push_back(bar(at, heading(0.4), 0.9 * pitch, 1.5 * pitch, i % 3));
      at += pitch * heading(0.4);
      pitch *= shrink;
    }
  }

  /// The cells of places [first, last), counted from `first` or, the other way round, from the last.
  void piece(int first, int last, bool reversed = false) {
    Chain chain;
    for (int i = first; i < last; ++i) {
      const int cell = reversed ? first + last - 1 - i : i;
      chain.links.push_back({cell, i - first});
    }
    chain.width = 16;
    chains_.push_back(chain);
  }

  /// The rows that were joined of the pieces.
  std::vector<Chain> join() {
    const std::size_t before = chains_.size();
    RowJoiner().join(cells_, min_cells, chains_);
    return {chains_.begin() + static_cast<std::ptrdiff_t>(before), chains_.end()};
  }

  /// Positions count the places, from either end.
  static bool counts_places(const Chain& row) {
    const int direction = row.links.back().cell > row.links.front().cell ? 1 : -1;
    for (const Chain::Link& l : row.links)
      if (l.cell != row.links.front().cell + direction * l.position) return false;
    return true;
  }

  std::vector<Cell> cells_;
  std::vector<Chain> chains_;
};

TEST_F(Joining, CountsTheCellsUnderACover) {
  draw(1);
  piece(1, 5);
  piece(11, 15);
  const std::vector<Chain> rows = join();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].links.size(), 8U);
  EXPECT_TRUE(counts_places(rows[0]));
  EXPECT_EQ(rows[0].joints, std::vector<int>{4});
}

TEST_F(Joining, PerspectiveChangesTheSpacing) {
  for (const double shrink : {0.97, 1.03}) {
    cells_.clear();
    chains_.clear();
    draw(shrink);
    piece(0, 4);
    piece(12, 18);
    const std::vector<Chain> rows = join();
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), counts_places)) << shrink;
  }
}

// As where a finger covers half of a piece's first cell, and the other piece ends in a disc.
TEST_F(Joining, AShortPieceMayBeFalselySpaced) {
  draw(1);
  piece(0, 6);
  piece(15, 18);
  cells_[0].centre -= 8 * heading(0.4);
  cells_[15].centre += 3 * heading(0.4);
  const std::vector<Chain> rows = join();
  EXPECT_GT(rows.size(), 1U);
  EXPECT_LE(rows.size(), 4U);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), counts_places), 1);
}

TEST_F(Joining, PiecesMayRunEitherWay) {
  draw(1);
  piece(1, 5, true);
  piece(9, 14);
  const std::vector<Chain> rows = join();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(counts_places(rows[0]));
}

TEST_F(Joining, TwoFingersLeaveThreePieces) {
  draw(1);
  piece(0, 3);
  piece(7, 10);
  piece(15, 18);
  const std::vector<Chain> rows = join();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].links.size(), 9U);
  EXPECT_TRUE(counts_places(rows[0]));
  EXPECT_EQ(rows[0].joints, (std::vector<int>{3, 6}));
}

TEST_F(Joining, WhatLiesOffTheLineIsAnother) {
  draw(1);
  piece(0, 4);
  piece(10, 14);
  for (std::size_t i = 10; i < 14; ++i) cells_[i].centre += 25 * heading(0.4 + 1.57);
  EXPECT_TRUE(join().empty());
}

TEST_F(Joining, WhatIsMuchThickerIsAnother) {
  draw(1);
  piece(0, 4);
  piece(10, 14);
  chains_[1].width *= 2;
  EXPECT_TRUE(join().empty());
}

TEST_F(Joining, FewCellsAreNoRow) {
  draw(1);
  piece(0, 3);
  piece(10, 13);
  EXPECT_TRUE(join().empty());
}

}  // namespace
}  // namespace onestroke::test

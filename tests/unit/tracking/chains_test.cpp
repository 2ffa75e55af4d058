#include "tracking/chains.h"

#include "row_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace onestroke::test {
namespace {

/// A row of cells of inks R G B R G B ..., shuffled afterwards; tags give each cell's place in the row it came from.
class Rows {
 public:
  struct Tag {
    int row, place;
  };

  /// bend: how much each step turns, rad; shrink: each step's length against the last one's, as perspective does.
  void add(Eigen::Vector2d at, double angle, int count, const std::set<int>& missing = {}, double bend = 0,
           double shrink = 1) {
    double pitch = 10, width = 15;
    for (int i = 0; i < count; ++i) {
      if (!missing.contains(i)) {
        cells.push_back(bar(at, heading(angle), 0.9 * pitch, width, i % 3));
        tags.push_back({rows_, i});
      }
      at += pitch * heading(angle + bend / 2);
      angle += bend;
      pitch *= shrink;
      width *= shrink;
    }
    ++rows_;
  }

  void shuffle(unsigned seed) {
    std::mt19937 random(seed);
    for (std::size_t i = cells.size(); i > 1; --i) {
      const std::size_t k = random() % i;
      std::swap(cells[i - 1], cells[k]);
      std::swap(tags[i - 1], tags[k]);
    }
  }

  /// Every link is of one row and the positions count its places, from either end.
  void expect_places(const Chain& chain) const {
    const Tag first = tag(chain.links.front()), last = tag(chain.links.back());
    const int direction = last.place > first.place ? 1 : -1;
    for (const Chain::Link& l : chain.links) {
      EXPECT_EQ(tag(l).row, first.row);
      EXPECT_EQ(tag(l).place, first.place + direction * l.position);
    }
  }
  /// The most links in sequence that a chain has of each row, at the places that their positions say.
  void stretches(const Chain& chain, std::array<int, 2>& longest) const {
    int run = 0;
    for (std::size_t i = 0; i < chain.links.size(); ++i) {
      const Tag here = tag(chain.links[i]);
      if (i > 0) {
        const Tag before = tag(chain.links[i - 1]);
        const int steps = chain.links[i].position - chain.links[i - 1].position;
        if (here.row != before.row || std::abs(here.place - before.place) != steps) run = 0;
      }
      int& best = longest[static_cast<std::size_t>(here.row)];
      best = std::max(best, ++run);
    }
  }
  Tag tag(const Chain::Link& l) const { return tags[static_cast<std::size_t>(l.cell)]; }

  std::vector<Cell> cells;
  std::vector<Tag> tags;

 private:
  int rows_ = 0;
};

TEST(Chains, AStraightRowIsOneChainInWhateverOrderAndDirection) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    Rows rows;
    rows.add({400, 300}, 0.55 * seed, 18);
    rows.shuffle(seed);
    const std::vector<Chain> chains = chains_in(rows.cells);
    ASSERT_EQ(chains.size(), 1u) << seed;
    ASSERT_EQ(chains[0].links.size(), 18u) << seed;
    EXPECT_EQ(chains[0].links.front().position, 0);
    EXPECT_EQ(chains[0].length(), 18);
    EXPECT_NEAR(chains[0].width, 15, 0.5);
    rows.expect_places(chains[0]);
  }
}

TEST(Chains, GapsAreCounted) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    Rows rows;
    rows.add({200, 200}, 0.3, 18, {5, 10, 11});
    rows.shuffle(seed);
    const std::vector<Chain> chains = chains_in(rows.cells);
    ASSERT_EQ(chains.size(), 1u) << seed;
    EXPECT_EQ(chains[0].links.size(), 15u) << seed;
    EXPECT_EQ(chains[0].length(), 18) << seed;
    rows.expect_places(chains[0]);
  }
}

TEST(Chains, AGapAsWideAsAFingerParts) {
  Rows rows;
  rows.add({200, 200}, 0, 18, {7, 8, 9, 10});
  const std::vector<Chain> chains = chains_in(rows.cells);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].links.size() + chains[1].links.size(), 14u);
}

TEST(Chains, PerspectiveAndAGentleBendAreFollowed) {
  Rows rows;
  rows.add({100, 100}, 0.2, 18, {}, 0.04, 0.96);
  rows.shuffle(3);
  const std::vector<Chain> chains = chains_in(rows.cells);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].links.size(), 18u);
  rows.expect_places(chains[0]);
}

TEST(Chains, ASharpCornerEndsARow) {
  Rows rows;
  rows.add({300, 100}, std::numbers::pi / 2, 18);
  rows.add({305, 285}, 0, 18);
  rows.shuffle(5);
  const std::vector<Chain> chains = chains_in(rows.cells);
  ASSERT_EQ(chains.size(), 2u);
  for (const Chain& c : chains) {
    EXPECT_GE(c.links.size(), 17u);
    rows.expect_places(c);
  }
}

// Where one row hides cells of another a chain may take the wrong turning; long stretches of both must still be read
// along themselves, for a reading is made of its best stretch.
TEST(Chains, TwoThatCrossAreReadInLongStretches) {
  for (const double angle : {0.6, 1.0, 1.57}) {
    for (unsigned seed = 0; seed < 10; ++seed) {
      Rows rows;
      const Eigen::Vector2d crossing(400, 300);
      rows.add(crossing - 85 * heading(0.1), 0.1, 18);
      rows.add(crossing - 85 * heading(0.1 + angle), 0.1 + angle, 18, {7, 8, 9});
      rows.shuffle(seed);
      std::array<int, 2> longest{};
      for (const Chain& c : chains_in(rows.cells)) rows.stretches(c, longest);
      EXPECT_GE(longest[0], 9) << "angle " << angle << " seed " << seed;
      EXPECT_GE(longest[1], 7) << "angle " << angle << " seed " << seed;
    }
  }
}

TEST(Chains, ThreeCellsAreNoRow) {
  Rows rows;
  rows.add({100, 100}, 0, 3);
  EXPECT_TRUE(chains_in(rows.cells).empty());
}

TEST(Chains, NeighboursOfOneInkAreNoRow) {
  std::vector<Cell> cells;
  for (int i = 0; i < 10; ++i) cells.push_back(bar({100 + 10.0 * i, 100}, {1, 0}, 9, 15, 1));
  // One link may jump a gap, but no two neighbours may touch.
  for (const Chain& c : chains_in(cells))
    for (std::size_t i = 1; i < c.links.size(); ++i) EXPECT_GT(c.links[i].position, c.links[i - 1].position + 1);
}

TEST(Chains, BarsAlongTheRowAreNoRings) {
  std::vector<Cell> cells;
  for (int i = 0; i < 10; ++i) cells.push_back(bar({100 + 24.0 * i, 100}, {1, 0}, 22, 9, i % 3));
  EXPECT_TRUE(chains_in(cells).empty());
}

TEST(Chains, CellsScatteredFarApartAreNoRow) {
  std::mt19937 random(2);
  std::vector<Cell> cells;
  for (int y = 40; y < picture_height; y += 60)
    for (int x = 40; x < picture_width; x += 60)
      cells.push_back(
          bar({x, y}, heading(static_cast<double>(random() % 60) / 10), 8, 14, static_cast<int>(random() % 3)));
  EXPECT_TRUE(chains_in(cells).empty());
}

TEST(Chains, NoCellsAndCellsAtTheRimAreTakenCalmly) {
  EXPECT_TRUE(chains_in({}).empty());
  std::vector<Cell> cells;
  for (int i = 0; i < 8; ++i)
    cells.push_back(bar({picture_width - 1.0 - 10 * i, picture_height - 0.5}, {1, 0}, 9, 15, i % 3));
  const std::vector<Chain> chains = chains_in(cells);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].links.size(), 8u);
}

}  // namespace
}  // namespace onestroke::test

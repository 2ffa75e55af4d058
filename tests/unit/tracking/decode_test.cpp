#include "tracking/decode.h"

#include "marker_fixture.h"
#include "row_fixture.h"

#include <gtest/gtest.h>

namespace onestroke::test {
namespace {

/// Part of a code as the picture would show it, in reading order or against it.
struct Seen {
  std::vector<Cell> cells;
  std::vector<Chain> chains;

  void add(const Cells& code, int first, int count, bool backward, const std::vector<int>& gaps = {}) {
    Chain chain;
    for (int i = 0; i < count; ++i) {
      if (std::find(gaps.begin(), gaps.end(), i) != gaps.end()) continue;
      const int from = backward ? first + count - 1 - i : first + i;
      chain.links.push_back({static_cast<int>(cells.size()), i});
      const Eigen::Vector2d place(100 + 10 * i, 100);
      cells.push_back(bar(place, {1, 0}, 9, 15, static_cast<int>(code[static_cast<std::size_t>(from)])));
    }
    chains.push_back(chain);
  }
  void spoil(std::size_t cell) { cells[cell].ink = static_cast<std::uint8_t>((cells[cell].ink + 1) % 3); }
};

const Cells& code(const Catalog& catalog, std::size_t marker) {
  return catalog.markers[marker].cells;
}

/// The best reading must put every link on the cell that it is.
void expect_read(const Reading& r, int marker, int first, int count, bool backward) {
  EXPECT_EQ(r.marker, marker);
  EXPECT_EQ(r.direction, backward ? -1 : 1);
  EXPECT_EQ(r.cell_of(0), backward ? first + count - 1 : first);
  EXPECT_EQ(r.cell_of(count - 1), backward ? first : first + count - 1);
}

TEST(CodeWindows, AlignAsAllAlignmentsDo) {
  const Catalog catalog = catalog_of(8);
  QuickReader reader(catalog);
  std::vector<Reading> quick;
  for (const bool backward : {false, true})
    for (const std::vector<int>& gaps : {std::vector<int>{}, {4}, {3, 9, 10}, {2, 5, 8, 11}}) {
      Seen seen;
      seen.add(code(catalog, 5), 7, 15, backward, gaps);
      reader.read(seen.cells, seen.chains, quick);
      ASSERT_FALSE(quick.empty());
      expect_read(quick.front(), 5, 7, 15, backward);
      EXPECT_EQ(quick.front().score(), read_chains(catalog, seen.cells, seen.chains).front().score());
    }
}

TEST(CodeWindows, ShortRunsAlignWithNothing) {
  const Catalog catalog = catalog_of(8);
  Seen seen;
  seen.add(code(catalog, 2), 3, 5, false);
  std::vector<Reading> alignments(3);
  CodeWindows(catalog).align(seen.cells, seen.chains.front(), alignments);
  EXPECT_TRUE(alignments.empty());
}

TEST(Decode, WindowsAreReadFromBothEnds) {
  const Catalog catalog = catalog_of(8);
  for (std::size_t m = 0; m < 8; ++m)
    for (const int first : {0, 9, 18})
      for (const bool backward : {false, true}) {
        Seen seen;
        seen.add(code(catalog, m), first, 18, backward);
        const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
        ASSERT_FALSE(readings.empty());
        expect_read(readings[0], static_cast<int>(m), first, 18, backward);
        EXPECT_EQ(readings[0].agree, 18);
        EXPECT_EQ(readings[0].contradict, 0);
        EXPECT_EQ(readings[0].begin, 0);
        EXPECT_EQ(readings[0].end, 18);
      }
}

TEST(Decode, OneWrongColourCostsThreeButReadsOn) {
  const Catalog catalog = catalog_of(8);
  for (std::size_t wrong = 4; wrong < 14; ++wrong)
    for (const bool backward : {false, true}) {
      Seen seen;
      seen.add(code(catalog, 5), 3, 18, backward);
      seen.spoil(wrong);
      const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
      ASSERT_FALSE(readings.empty());
      expect_read(readings[0], 5, 3, 18, backward);
      EXPECT_EQ(readings[0].agree, 17);
      EXPECT_EQ(readings[0].contradict, 1);
      EXPECT_EQ(readings[0].score(), 14);
    }
}

TEST(Decode, GapsKeepTheirPlaces) {
  const Catalog catalog = catalog_of(8);
  Seen seen;
  seen.add(code(catalog, 2), 0, 18, true, {4, 9, 10});
  const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
  ASSERT_FALSE(readings.empty());
  expect_read(readings[0], 2, 0, 18, true);
  EXPECT_EQ(readings[0].agree, 15);
}

// What one piece alone says is said by its own chain already.
TEST(Decode, JoinedRowsAreReadForWhatTheirPiecesSayTogether) {
  const Catalog catalog = catalog_of(8);
  Seen seen;
  seen.add(code(catalog, 3), 2, 14, false, {5, 6, 7, 8});
  seen.chains[0].joints = {5};
  const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
  ASSERT_FALSE(readings.empty());
  expect_read(readings.front(), 3, 2, 14, false);
  for (const Reading& r : readings) EXPECT_TRUE(r.begin < 5 && r.end > 5);
}

TEST(Decode, ARowThatRunsPastTheTipIsReadAsFarAsItGoes) {
  const Catalog catalog = catalog_of(4);
  const Cells& whole = code(catalog, 1);
  Cells longer(whole.begin() + 22, whole.end());
  // Three coloured things of the room lie in line with the rod.
  for (int i = 0; i < 3; ++i) longer.push_back(static_cast<CellColor>((static_cast<int>(longer.back()) + 1) % 3));
  Seen seen;
  seen.add(longer, 0, static_cast<int>(longer.size()), false);
  const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(readings[0].marker, 1);
  EXPECT_EQ(readings[0].cell_of(0), 22);
  EXPECT_EQ(readings[0].begin, 0);
  EXPECT_EQ(readings[0].end, 14);
}

TEST(Decode, EachChainIsReadForItself) {
  const Catalog catalog = catalog_of(8);
  Seen seen;
  seen.add(code(catalog, 3), 0, 18, false);
  seen.add(code(catalog, 6), 18, 18, true);
  const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
  const auto best_of = [&](int chain) {
    const auto at = std::find_if(readings.begin(), readings.end(), [&](const Reading& r) { return r.chain == chain; });
    return at == readings.end() ? Reading{} : *at;
  };
  expect_read(best_of(0), 3, 0, 18, false);
  expect_read(best_of(1), 6, 18, 18, true);
}

TEST(Decode, ReadingsComeBestFirstAndAClearOneStandsAlone) {
  const Catalog catalog = catalog_of(8);
  Seen seen;
  seen.add(code(catalog, 0), 0, 18, false);
  seen.add(code(catalog, 4), 5, 9, false);
  const std::vector<Reading> readings = read_chains(catalog, seen.cells, seen.chains);
  for (std::size_t i = 1; i < readings.size(); ++i) EXPECT_GE(readings[i - 1].score(), readings[i].score());
  for (std::size_t i = 1; i < readings.size(); ++i)
    EXPECT_NE(readings[i].chain, 0) << "chance agreement on part of a row that is read in full";
}

TEST(Decode, NothingIsReadFromNothing) {
  EXPECT_TRUE(read_chains(catalog_of(8), {}, {}).empty());
  const Catalog catalog = catalog_of(2);
  Seen seen;
  seen.add(code(catalog, 0), 0, 18, false);
  EXPECT_TRUE(read_chains({}, seen.cells, seen.chains).empty());
}

}  // namespace
}  // namespace onestroke::test

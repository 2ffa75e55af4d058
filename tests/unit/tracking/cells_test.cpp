// Regions and their moments against a flood fill that looks at every pixel.

#include "tracking/cells.h"

#include "tracking/segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace onestroke::test {
namespace {

struct Labels {
  int width, height;
  std::vector<std::uint8_t> at;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// From letters: R, G, B and anything else for no ink.
Labels labels_of(const std::vector<std::string>& rows) {
  Labels labels{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
  for (const std::string& row : rows)
    for (const char c : row) {
      const std::size_t ink = std::string("RGB").find(c);
      labels.at.push_back(ink == std::string::npos ? no_ink : static_cast<std::uint8_t>(ink));
    }
  return labels;
}

Labels random_labels(std::mt19937& random, int width, int height, int block, double ink_share) {
  Labels labels{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height))};
  std::bernoulli_distribution inked(ink_share);
  std::uniform_int_distribution<int> ink(0, 2);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool first = x % block == 0 && y % block == 0;
      labels.at[labels.index(x, y)] = first ? (inked(random) ? static_cast<std::uint8_t>(ink(random)) : no_ink)
                                            : labels.at[labels.index(x - x % block, y - y % block)];
    }
  return labels;
}

/// Four-connected, moments summed pixel by pixel over squares of side 1.
Cell flood(const Labels& labels, int x, int y, std::vector<bool>& done, int& span) {
  Cell cell;
  cell.ink = labels.at[labels.index(x, y)];
  std::vector<std::pair<int, int>> open{{x, y}}, all;
  done[labels.index(x, y)] = true;
  int x0 = x, x1 = x, y0 = y, y1 = y;
  while (!open.empty()) {
    const auto [px, py] = open.back();
    open.pop_back();
    all.emplace_back(px, py);
    x0 = std::min(x0, px), x1 = std::max(x1, px), y0 = std::min(y0, py), y1 = std::max(y1, py);
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int qx = px + dx, qy = py + dy;
      if (qx < 0 || qy < 0 || qx >= labels.width || qy >= labels.height) continue;
      const std::size_t k = labels.index(qx, qy);
      if (done[k] || labels.at[k] != cell.ink) continue;
      done[k] = true;
      open.emplace_back(qx, qy);
    }
  }
  cell.area = static_cast<double>(all.size());
  cell.centre.setZero();
  cell.covariance = Eigen::Matrix2d::Identity() / 12;
  for (const auto& [px, py] : all) cell.centre += Eigen::Vector2d(px + 0.5, py + 0.5) / cell.area;
  for (const auto& [px, py] : all) {
    const Eigen::Vector2d d = Eigen::Vector2d(px + 0.5, py + 0.5) - cell.centre;
    cell.covariance += d * d.transpose() / cell.area;
  }
  span = std::max(x1 - x0, y1 - y0) + 1;
  return cell;
}

std::vector<Cell> brute_force(const Labels& labels, const CellOptions& options) {
  std::vector<Cell> cells;
  std::vector<bool> done(labels.at.size(), false);
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      if (done[labels.index(x, y)] || labels.at[labels.index(x, y)] == no_ink) continue;
      int span = 0;
      const Cell cell = flood(labels, x, y, done, span);
      if (cell.area >= options.min_area && span <= options.max_size * labels.width) cells.push_back(cell);
    }
  return cells;
}

std::vector<Cell> found(const Labels& labels, const CellOptions& options) {
  CellFinder finder;
  std::vector<Cell> cells;
  finder.find(labels.at, labels.width, labels.height, options, cells);
  return cells;
}

void sort(std::vector<Cell>& cells) {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return std::tuple(std::lround(1e6 * a.centre.y()), std::lround(1e6 * a.centre.x()), a.area, a.ink) <
           std::tuple(std::lround(1e6 * b.centre.y()), std::lround(1e6 * b.centre.x()), b.area, b.ink);
  });
}

constexpr CellOptions everything{1, 10};

TEST(Cells, RandomPicturesGiveWhatAFloodFillGives) {
  std::mt19937 random(11);
  CellFinder finder;
  std::vector<Cell> cells;
  for (int i = 0; i < 60; ++i) {
    const int width = 1 + static_cast<int>(random() % 70), height = 1 + static_cast<int>(random() % 50);
    const Labels labels = random_labels(random, width, height, 1 + i % 4, i % 2 ? 0.9 : 0.6);
    const CellOptions options = i % 3 ? everything : CellOptions{4, 0.3};
    finder.find(labels.at, width, height, options, cells);
    std::vector<Cell> expected = brute_force(labels, options);
    sort(cells);
    sort(expected);
    ASSERT_EQ(cells.size(), expected.size()) << "picture " << i;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      EXPECT_EQ(cells[k].ink, expected[k].ink);
      EXPECT_EQ(cells[k].area, expected[k].area);
      EXPECT_LT((cells[k].centre - expected[k].centre).norm(), 1e-9);
      EXPECT_LT((cells[k].covariance - expected[k].covariance).norm(), 1e-8);
    }
  }
}

TEST(Cells, BranchesThatMeetLateAreOneCell) {
  const Labels labels = labels_of({"R.R.R.R",  //
                                   "R.R.R.R",  //
                                   "RRR.RRR",  //
                                   "..R.R..",  //
                                   "..RRR.."});
  const std::vector<Cell> cells = found(labels, everything);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].area, 19);
  EXPECT_NEAR(cells[0].centre.x(), 3.5, 1e-12);
}

TEST(Cells, CornersDoNotConnectAndInksDoNotMix) {
  EXPECT_EQ(found(labels_of({"R.", ".R"}), everything).size(), 2u);
  const std::vector<Cell> cells = found(labels_of({"RRGGB"}), everything);
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0].ink, 0);
  EXPECT_EQ(cells[1].ink, 1);
  EXPECT_EQ(cells[2].ink, 2);
}

TEST(Cells, ABlockHasTheExtentOfItsSides) {
  const std::vector<Cell> cells = found(labels_of({".......", ".BBBBB.", ".BBBBB.", "......."}), everything);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].centre, Eigen::Vector2d(3.5, 2));
  EXPECT_NEAR(cells[0].extent({1, 0}), 5, 1e-9);
  EXPECT_NEAR(cells[0].extent({0, 1}), 2, 1e-9);
}

TEST(Cells, SpecksAndBackgroundsAreLeftOut) {
  CellOptions options;
  options.min_area = 3;
  options.max_size = 0.5;
  const Labels labels = labels_of({"GG......", "........", "BBBBB...", "........", "RRR....."});
  const std::vector<Cell> cells = found(labels, options);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].ink, 0);
}

TEST(Cells, TheLastPictureIsForgotten) {
  CellFinder finder;
  std::vector<Cell> cells;
  const Labels full = labels_of({"RGB", "RGB"}), empty = labels_of({"...", "..."}), small = labels_of({"G"});
  finder.find(full.at, 3, 2, everything, cells);
  EXPECT_EQ(cells.size(), 3u);
  finder.find(empty.at, 3, 2, everything, cells);
  EXPECT_TRUE(cells.empty());
  finder.find(small.at, 1, 1, everything, cells);
  EXPECT_EQ(cells.size(), 1u);
}

}  // namespace
}  // namespace onestroke::test

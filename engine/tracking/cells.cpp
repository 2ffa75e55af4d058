#include "tracking/cells.h"

#include "tracking/segmentation.h"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>
#include <bit>
#include <utility>

namespace onestroke {
namespace {

// Where runs of equal labels end in a row, sixteen labels at a time.
void find_ends(const std::uint8_t* row, int width, std::vector<int>& ends) {
  ends.clear();
  int x = 1;
  for (; x + 16 <= width; x += 16) {
    auto differ = static_cast<unsigned>(cv::v_signmask(cv::v_load(row + x) != cv::v_load(row + x - 1)));
    for (; differ != 0; differ &= differ - 1) ends.push_back(x + std::countr_zero(differ));
  }
  for (; x < width; ++x)
    if (row[x] != row[x - 1]) ends.push_back(x);
  ends.push_back(width);
}

}  // namespace

int CellFinder::root(int region) {
  while (regions_[static_cast<std::size_t>(region)].parent != region) {
    Region& r = regions_[static_cast<std::size_t>(region)];
    r.parent = regions_[static_cast<std::size_t>(r.parent)].parent;
    region = r.parent;
  }
  return region;
}

void CellFinder::merge(int a, int b) {
  a = root(a);
  b = root(b);
  if (a == b) return;
  if (a > b) std::swap(a, b);
  Region& to = regions_[static_cast<std::size_t>(a)];
  Region& from = regions_[static_cast<std::size_t>(b)];
  from.parent = a;
  to.area += from.area;
  to.x0 = std::min(to.x0, from.x0);
  to.y0 = std::min(to.y0, from.y0);
  to.x1 = std::max(to.x1, from.x1);
  to.y1 = std::max(to.y1, from.y1);
}

// Runs of one ink in this row join the runs of the same ink that overlap them in the row above.
void CellFinder::scan_row(const std::uint8_t* row, int y, int width) {
  const std::size_t here = runs_.size();
  std::size_t above = row_above_;
  find_ends(row, width, ends_);
  int next = 0;
  for (const int end : ends_) {
    const int x = std::exchange(next, end);
    const std::uint8_t ink = row[x];
    if (ink == no_ink) continue;
    int region = -1;
    while (above < here && runs_[above].end <= x) ++above;
    for (std::size_t k = above; k < here && runs_[k].begin < end; ++k) {
      if (regions_[static_cast<std::size_t>(runs_[k].region)].ink != ink) continue;
      if (region >= 0) merge(region, runs_[k].region);
      region = root(runs_[k].region);
    }
    if (region < 0) {
      region = static_cast<int>(regions_.size());
      regions_.push_back({region, ink, x, y, end, y + 1, end - x, -1});
    } else {
      Region& r = regions_[static_cast<std::size_t>(region)];
      r.area += end - x;
      r.x0 = std::min(r.x0, x);
      r.x1 = std::max(r.x1, end);
      r.y1 = y + 1;
    }
    runs_.push_back({x, end, y, region});
  }
  row_above_ = here;
}

void CellFinder::Moments::add(const Run& run) {
  // The sum of squares of n consecutive numbers is n * (mean^2 + (n^2 - 1) / 12).
  const double n = run.end - run.begin, mean = 0.5 * (run.begin + run.end), cy = run.y + 0.5;
  x += n * mean;
  y += n * cy;
  xx += n * (mean * mean + (n * n - 1) / 12);
  xy += n * mean * cy;
  yy += n * cy * cy;
}

// The regions that are cells.
void CellFinder::choose(double limit, int min_area, std::vector<Cell>& cells) {
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    Region& r = regions_[i];
    if (r.parent != static_cast<int>(i) || r.area < min_area || r.x1 - r.x0 > limit || r.y1 - r.y0 > limit) continue;
    r.cell = static_cast<int>(cells.size());
    Cell& c = cells.emplace_back();
    c.area = r.area;
    c.ink = r.ink;
  }
}

void CellFinder::find(const std::vector<std::uint8_t>& labels, int width, int height, const CellOptions& options,
                      std::vector<Cell>& cells) {
  runs_.clear();
  row_above_ = 0;
  regions_.clear();
  cells.clear();
  for (int y = 0; y < height; ++y)
    scan_row(labels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width), y, width);
  choose(options.max_size * width, options.min_area, cells);
  // Most runs are of backgrounds: only those of cells are summed.
  moments_.assign(cells.size(), {});
  for (const Run& run : runs_) {
    const int cell = regions_[static_cast<std::size_t>(root(run.region))].cell;
    if (cell >= 0) moments_[static_cast<std::size_t>(cell)].add(run);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Cell& c = cells[i];
    const Moments& m = moments_[i];
    c.centre = {m.x / c.area, m.y / c.area};
    // A pixel is a square, not a point: its own spread is 1/12.
    c.covariance(0, 0) = m.xx / c.area - c.centre.x() * c.centre.x() + 1.0 / 12;
    c.covariance(1, 1) = m.yy / c.area - c.centre.y() * c.centre.y() + 1.0 / 12;
    c.covariance(0, 1) = c.covariance(1, 0) = m.xy / c.area - c.centre.x() * c.centre.y();
  }
}

}  // namespace onestroke

#include "tracking/cells.h"

#include "tracking/segmentation.h"

#include <algorithm>

namespace onestroke {

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
  to.n += from.n;
  to.sx += from.sx;
  to.sy += from.sy;
  to.sxx += from.sxx;
  to.sxy += from.sxy;
  to.syy += from.syy;
  to.x0 = std::min(to.x0, from.x0);
  to.y0 = std::min(to.y0, from.y0);
  to.x1 = std::max(to.x1, from.x1);
  to.y1 = std::max(to.y1, from.y1);
}

int CellFinder::new_region(std::uint8_t ink) {
  const int index = static_cast<int>(regions_.size());
  regions_.push_back({index, ink, 1 << 30, 1 << 30, -1, -1, 0, 0, 0, 0, 0, 0});
  return index;
}

// Runs of one ink in this row join the runs of the same ink that overlap them in the row above.
void CellFinder::scan_row(const std::uint8_t* row, int y, int width) {
  current_.clear();
  std::size_t above = 0;
  for (int x = 0; x < width;) {
    const std::uint8_t ink = row[x];
    int end = x + 1;
    while (end < width && row[end] == ink) ++end;
    if (ink != no_ink) {
      int region = -1;
      while (above < previous_.size() && previous_[above].end <= x) ++above;
      for (std::size_t k = above; k < previous_.size() && previous_[k].begin < end; ++k) {
        if (regions_[static_cast<std::size_t>(previous_[k].region)].ink != ink) continue;
        if (region < 0)
          region = root(previous_[k].region);
        else
          merge(region, previous_[k].region);
        region = root(region);
      }
      if (region < 0) region = new_region(ink);
      Region& r = regions_[static_cast<std::size_t>(region)];
      const double n = end - x, first = x + 0.5, last = end - 0.5, cy = y + 0.5;
      // The sum of squares of n consecutive numbers is n * (mean^2 + (n^2 - 1) / 12).
      const double mean = (first + last) / 2, sx = n * mean;
      r.n += n;
      r.sx += sx;
      r.sy += n * cy;
      r.sxx += n * (mean * mean + (n * n - 1) / 12);
      r.sxy += sx * cy;
      r.syy += n * cy * cy;
      r.x0 = std::min(r.x0, x);
      r.x1 = std::max(r.x1, end);
      r.y0 = std::min(r.y0, y);
      r.y1 = std::max(r.y1, y + 1);
      current_.push_back({x, end, region});
    }
    x = end;
  }
  previous_.swap(current_);
}

void CellFinder::find(const std::vector<std::uint8_t>& labels, int width, int height, const CellOptions& options,
                      std::vector<Cell>& cells) {
  previous_.clear();
  regions_.clear();
  cells.clear();
  for (int y = 0; y < height; ++y)
    scan_row(labels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width), y, width);
  const double limit = options.max_size * width;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const Region& r = regions_[i];
    if (r.parent != static_cast<int>(i) || r.n < options.min_area) continue;
    if (r.x1 - r.x0 > limit || r.y1 - r.y0 > limit) continue;
    Cell c;
    c.centre = {r.sx / r.n, r.sy / r.n};
    // A pixel is a square, not a point: its own spread is 1/12.
    c.covariance(0, 0) = r.sxx / r.n - c.centre.x() * c.centre.x() + 1.0 / 12;
    c.covariance(1, 1) = r.syy / r.n - c.centre.y() * c.centre.y() + 1.0 / 12;
    c.covariance(0, 1) = c.covariance(1, 0) = r.sxy / r.n - c.centre.x() * c.centre.y();
    c.area = r.n;
    c.ink = r.ink;
    cells.push_back(c);
  }
}

}  // namespace onestroke

#pragma once

#include "tracking/image_view.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace onestroke {

/// A connected region of one ink, perhaps a marker's cell.
struct Cell {
  Eigen::Vector2d centre;      ///< Gravity centre, pixels, pixel centres at half-integers.
  Eigen::Matrix2d covariance;  ///< Second central moments, square pixels.
  double area = 0;             ///< Pixels.
  std::uint8_t ink = 0;        ///< 0 red, 1 green, 2 blue.

  /// Width of the uniform strip that has this cell's spread along the unit direction.
  double extent(const Eigen::Vector2d& direction) const {
    return std::sqrt(12 * std::max(0.0, direction.dot(covariance * direction)));
  }
};

struct CellOptions {
  int min_area = 5;
  /// Cells longer or wider than this share of the picture's width are background.
  double max_size = 0.12;
};

/// Finds the 4-connected regions of each ink. Keeps its memory between pictures.
class CellFinder {
 public:
  void find(const std::vector<std::uint8_t>& labels, int width, int height, const CellOptions& options,
            std::vector<Cell>& cells);

 private:
  struct Run {
    int begin, end, y;
    int region;
  };
  struct Region {
    int parent;
    std::uint8_t ink;
    int x0, y0, x1, y1;
    int area;
    int cell;  // Its place among the cells, or -1.
  };
  // Sums over a cell's pixels.
  struct Moments {
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    void add(const Run& run);
  };
  int root(int region);
  void merge(int a, int b);
  void scan_row(const std::uint8_t* row, int y, int width);
  void choose(double limit, int min_area, std::vector<Cell>& cells);

  std::vector<int> ends_;
  std::vector<Run> runs_;
  std::size_t row_above_ = 0;  // Where the runs of the row above begin.
  std::vector<Region> regions_;
  std::vector<Moments> moments_;
};

}  // namespace onestroke

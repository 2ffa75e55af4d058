#pragma once

#include "tracking/cells.h"
#include "tracking/chains.h"

#include <random>
#include <vector>

namespace onestroke::test {

/// A ring cell as a bar: `length` along the unit direction, `width` across it, pixels.
inline Cell bar(const Eigen::Vector2d& centre, const Eigen::Vector2d& along, double length, double width, int ink) {
  Cell cell;
  const Eigen::Vector2d across(-along.y(), along.x());
  cell.centre = centre;
  cell.covariance = (length * length * along * along.transpose() + width * width * across * across.transpose()) / 12;
  cell.area = length * width;
  cell.ink = static_cast<std::uint8_t>(ink);
  return cell;
}

inline Eigen::Vector2d heading(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

inline constexpr int picture_width = 800, picture_height = 600;

inline std::vector<Chain> chains_in(const std::vector<Cell>& cells) {
  ChainFinder finder;
  std::vector<Chain> chains;
  finder.find(cells, picture_width, picture_height, {}, chains);
  return chains;
}

}  // namespace onestroke::test

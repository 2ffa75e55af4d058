#include "tracking/rod_raster.h"

#include "core/srgb.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

constexpr double working_thickness = 14, full_thickness = 40;
// Left around the rod, working pixels.
constexpr int working_room = 13, full_room = 22;
// No cell.
constexpr std::uint8_t nothing = 255;

const std::array<float, 256>& linear_light() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double v = static_cast<double>(i) / 255;
      t[i] = static_cast<float>(linear_from_srgb(v));
    }
    return t;
  }();
  return table;
}

}  // namespace

bool RodRaster::crop(const EigenPose& about, Detail detail) {
  const double depth = (about * rod_.centre()).z();
  if (depth < 10) return false;
  detail_ = detail;
  const bool full = detail == Detail::full;
  factor_ =
      std::max(1, static_cast<int>(2 * rod_.radius() * k_.fx / depth / (full ? full_thickness : working_thickness)));
  const int room = full ? full_room : working_room;
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
  for (int e = 0; e <= rod_.cell_count(); ++e) {
    Vec2d p;
    if (!project(k_, about * rod_.edge(e).centre, p)) return false;
    x0 = std::min(x0, p.x()), x1 = std::max(x1, p.x());
    y0 = std::min(y0, p.y()), y1 = std::max(y1, p.y());
  }
  const double margin = 1.5 * rod_.radius() * k_.fx / depth + (room + 1.0) * factor_;
  left_ = std::max(0, static_cast<int>((x0 - margin) / factor_));
  top_ = std::max(0, static_cast<int>((y0 - margin) / factor_));
  const int right = std::min(image_.width / factor_, static_cast<int>((x1 + margin) / factor_) + 1);
  const int bottom = std::min(image_.height / factor_, static_cast<int>((y1 + margin) / factor_) + 1);
  if (right - left_ < 8 || bottom - top_ < 8) return false;
  reduce(right - left_, bottom - top_);
  find_spots(about, room);
  return true;
}

void RodRaster::reduce(int width, int height) {
  coded_.create(height, width, CV_32FC3);
  linear_.create(height, width, CV_32FC3);
  rays_.resize(static_cast<std::size_t>(width * height));
  const auto& light = linear_light();
  const float share = 1.0F / static_cast<float>(factor_ * factor_);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Pixel3 coded(0, 0, 0), linear(0, 0, 0);
      for (int j = 0; j < factor_; ++j) {
        const std::uint8_t* p = image_.at((left_ + x) * factor_, (top_ + y) * factor_ + j);
        for (int i = 0; i < factor_; ++i, p += 3)
          for (int c = 0; c < 3; ++c) {
            coded[c] += static_cast<float>(p[c]);
            linear[c] += light[p[c]];
          }
      }
      coded_.at<Pixel3>(y, x) = coded * share;
      linear_.at<Pixel3>(y, x) = linear * share;
      const Vec2d n = unproject(k_, {(left_ + x + 0.5) * factor_, (top_ + y + 0.5) * factor_});
      rays_[static_cast<std::size_t>(y * width + x)] = {n.x(), n.y(), 1};
    }
}

void RodRaster::find_spots(const EigenPose& about, int room) {
  std::vector<cv::Point> line;
  double thickness = 0;
  for (int e = 0; e <= rod_.cell_count(); ++e) {
    Vec2d p;
    const Vec3d centre = about * rod_.edge(e).centre;
    if (!project(k_, centre, p)) continue;
    line.emplace_back(static_cast<int>(std::clamp(p.x() / factor_ - left_, -1e4, 1e4)),
                      static_cast<int>(std::clamp(p.y() / factor_ - top_, -1e4, 1e4)));
    thickness = std::max(thickness, 2 * rod_.radius() * k_.fx / factor_ / std::max(1.0, centre.z()));
  }
  cv::Mat mask(linear_.rows, linear_.cols, CV_8U, cv::Scalar(0));
  cv::polylines(mask, line, false, cv::Scalar(1), std::min(static_cast<int>(1.3 * thickness) + 2 * room, 250));
  spots_.clear();
  runs_.clear();
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (!mask.at<std::uint8_t>(y, x)) continue;
      spots_.push_back({y, x, static_cast<std::size_t>(y * mask.cols + x)});
      if (runs_.empty() || runs_.back().y != y || runs_.back().x1 != x) runs_.push_back({y, x, x});
      ++runs_.back().x1;
    }
}

bool RodRaster::cast(const EigenPose& pose, double reach) {
  points_.resize(rays_.size());
  near_.assign(rays_.size(), 0);
  cell_.resize(rays_.size());
  shown_.assign(rays_.size(), nothing);
  const Mat3d back = pose.R.transpose();
  const Vec3d eye = -back * pose.t;
  const double scale = k_.fx / factor_;
  int inside = 0;
  for (const auto& [y, x, i] : spots_) {
    const RodCaster::Hit hit = caster_.cast(eye, back * rays_[i]);
    const Vec3d point = pose * hit.point;
    const double gap = hit.gap * scale / std::max(1.0, point.z());
    if (gap > reach) continue;
    near_[i] = 1;
    points_[i] = point;
    cell_[i] = cell_at(hit.s);
    if (hit.hit) shown_[i] = cell_[i];
    inside += hit.hit;
  }
  cast_edges(eye, back);
  return inside > 30;
}

// Pixels that the outline or a ring edge may cross are cast in four parts.
void RodRaster::cast_edges(const Vec3d& eye, const Mat3d& back) {
  const int width = linear_.cols, height = linear_.rows;
  const auto w = static_cast<std::size_t>(width);
  mix_.create(height, width, CV_32FC4);
  mix_.setTo(0);
  for (const auto& [y, x, i] : spots_) {
    if (y == 0 || x == 0 || y + 1 == height || x + 1 == width) continue;
    auto& m = mix_.at<Pixel4>(y, x);
    const std::uint8_t c = shown_[i];
    if (c == shown_[i - 1] && c == shown_[i + 1] && c == shown_[i - w] && c == shown_[i + w] &&
        c == shown_[i - w - 1] && c == shown_[i - w + 1] && c == shown_[i + w - 1] && c == shown_[i + w + 1]) {
      if (c != nothing) m[rod_.ink(c)] = m[3] = 1;
      continue;
    }
    const double h = 0.25 * factor_ / k_.fx;
    for (const auto& [dx, dy] : {std::pair{-h, -h}, {h, -h}, {-h, h}, {h, h}}) {
      const RodCaster::Hit part = caster_.cast(eye, back * (rays_[i] + Vec3d(dx, dy, 0)));
      if (!part.hit) continue;
      m[rod_.ink(cell_at(part.s))] += 0.25F;
      m[3] += 0.25F;
    }
  }
}

std::uint8_t RodRaster::cell_at(double s) const {
  return static_cast<std::uint8_t>(std::clamp(static_cast<int>(s / rod_.pitch()), 0, rod_.cell_count() - 1));
}

}  // namespace onestroke

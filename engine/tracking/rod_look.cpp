#include "tracking/rod_look.h"

#include <opencv2/imgproc.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

// A blur wider than this, working pixels, is defocus, which spreads a point over a disc.
constexpr double widest_sharp = 2, widest_sharp_in_full = 1;
// Of layers that are blurred each by its own, working pixels.
constexpr double layer_gap = 0.7;
constexpr int max_layers = 6;

// Of what the arm that shows most of each ink shows of it: what less shows is mixed from narrow rings.
constexpr double enough_to_tell = 0.08;

// Where this share of a pixel is rod, the pixel tells the rod's colour.
constexpr float mostly_rod = 0.7F;

// The mean over a square: where it need not be smooth, only local.
void local_mean(const cv::Mat& from, cv::Mat& to, double sigma) {
  const int side = 2 * static_cast<int>(std::lround(1.7 * sigma)) + 1;
  cv::blur(from, to, cv::Size(side, side), cv::Point(-1, -1), cv::BORDER_REPLICATE);
}

// 0..255 of linear light.
float coded(float linear) {
  constexpr int steps = 1024;
  static const std::array<float, steps + 1> table = [] {
    std::array<float, steps + 1> t;
    for (int i = 0; i <= steps; ++i)
      t[static_cast<std::size_t>(i)] =
          255 * std::pow(std::max(1e-5F, static_cast<float>(i * i) / static_cast<float>(steps * steps)), 1 / 2.2F);
    return t;
  }();
  // Even in the square root: dark colours are told apart as well as bright ones.
  return table[static_cast<std::size_t>(steps * std::sqrt(std::clamp(linear, 0.0F, 1.0F)) + 0.5F)];
}

float sum(const Pixel3& p) {
  return p[0] + p[1] + p[2];
}

// How far the inks of an arm are told apart: the smallest lead of an ink's own channel over the other inks' share of
// it; 0 where the arm shows too little of an ink.
double purity_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  constexpr double enough = 15;  // Pixels.
  if (a.diagonal().minCoeff() < enough) return 0;
  Eigen::Matrix3d inks = a.ldlt().solve(b).cwiseMax(1e-6);
  for (int i = 0; i < 3; ++i) inks.row(i) /= inks.row(i).sum();
  double least = 1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) least = std::min(least, inks(i, i) - inks(j, i));
  return least;
}

}  // namespace

Color chroma_of(const cv::Vec3f& linear) {
  return chromaticity({coded(linear[0]), coded(linear[1]), coded(linear[2])});
}

void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
  cv::GaussianBlur(from, to, cv::Size(2 * reach + 1, 2 * reach + 1), sigma, sigma, cv::BORDER_REPLICATE);
}

void RodLook::blur_evenly(const cv::Mat& mix, double camera_blur, cv::Mat& to) {
  if (camera_blur < (raster_.detail() == RodRaster::Detail::full ? widest_sharp_in_full : widest_sharp)) {
    gaussian_blur(mix, to, std::hypot(camera_blur, extra_blur_));
    return;
  }
  disc_.blur(mix, camera_blur, raster_.runs(), spread_);
  gaussian_blur(spread_, to, extra_blur_);
}

double RodLook::blur_as_camera(const CameraBlur& camera_blur) {
  if (camera_blur.by_nearness != 0) return blur_by_depth(camera_blur);
  blur_evenly(raster_.mix(), camera_blur.sigma, mix_);
  return camera_blur.sigma;
}

// Layers of one blur each; what lies between two is shared out to both.
double RodLook::blur_by_depth(const CameraBlur& camera_blur) {
  double least = 1e9, most = 0;
  for (const auto& [y, x, i] : raster_.spots()) {
    if (raster_.mix().at<Pixel4>(y, x)[3] == 0 || !raster_.within_reach(i)) continue;
    const double b = camera_blur.at(raster_.point(i).z());
    least = std::min(least, b);
    most = std::max(most, b);
  }
  if (most - least < 0.1) {
    blur_evenly(raster_.mix(), most, mix_);
    return most;
  }
  const int gaps = std::clamp(static_cast<int>(std::lround((most - least) / layer_gap)), 1, max_layers - 1);
  const double gap = (most - least) / gaps;
  cv::Mat blurred;
  for (int l = 0; l <= gaps; ++l) {
    layer_.create(seen_.rows, seen_.cols, CV_32FC4);
    layer_.setTo(0);
    for (const auto& [y, x, i] : raster_.spots()) {
      const Pixel4& m = raster_.mix().at<Pixel4>(y, x);
      if (m[3] == 0 || !raster_.within_reach(i)) continue;
      const double place = (camera_blur.at(raster_.point(i).z()) - least) / gap;
      const double share = 1 - std::abs(place - l);
      if (share > 0) layer_.at<Pixel4>(y, x) = m * static_cast<float>(share);
    }
    blur_evenly(layer_, least + l * gap, blurred);
    if (l == 0)
      blurred.copyTo(mix_);
    else
      mix_ += blurred;
  }
  return most;
}

void RodLook::see(const cv::Mat& seen, double extra_blur) {
  seen_ = seen;
  extra_blur_ = extra_blur;
  seen_.copyTo(picture_);
}

bool RodLook::compose(const cv::Mat& weight, const CameraBlur& camera_blur) {
  weight_ = weight;
  const double widest = blur_as_camera(camera_blur);
  find_surroundings(std::max(3.0, 1.2 * std::hypot(widest, extra_blur_)));
  if (!find_inks()) return false;
  find_veils();
  find_shading();
  known_.create(seen_.rows, seen_.cols, CV_8U);
  known_.setTo(0);
  for (const auto& [y, x, i] : raster_.spots()) {
    const Pixel4& m = mix_.at<Pixel4>(y, x);
    const cv::Vec2f& l = shading_.at<cv::Vec2f>(y, x);
    const bool surrounded = 1 - m[3] < 0.03F || outside_.at<Pixel4>(y, x)[3] > 1e-3F;
    const bool lit = m[3] < 0.03F || l[1] > 1e-5F;
    known_.at<std::uint8_t>(y, x) = surrounded && lit && raster_.within_reach(i);
    const float shading = l[1] > 1e-5F ? l[0] / l[1] : 1.0F;
    picture_.at<Pixel3>(y, x) = paint(y, x) * shading + behind(y, x);
  }
  return true;
}

void RodLook::find_surroundings(double sigma) {
  uncovered_.create(seen_.rows, seen_.cols, CV_32FC4);
  for (int y = 0; y < seen_.rows; ++y) {
    const auto* seen = seen_.ptr<Pixel3>(y);
    const auto* mix = mix_.ptr<Pixel4>(y);
    auto* to = uncovered_.ptr<Pixel4>(y);
    for (int x = 0; x < seen_.cols; ++x)
      to[x] = mix[x][3] < 0.02F ? Pixel4(seen[x][0], seen[x][1], seen[x][2], 1) : Pixel4(0, 0, 0, 0);
  }
  gaussian_blur(uncovered_, outside_, sigma);
  rod_light_.create(seen_.rows, seen_.cols, CV_32FC3);
  for (const auto& [y, x, i] : raster_.spots()) rod_light_.at<Pixel3>(y, x) = seen_.at<Pixel3>(y, x) - behind(y, x);
}

// What the surroundings add to a pixel.
cv::Vec3f RodLook::behind(int y, int x) const {
  const Pixel4& o = outside_.at<Pixel4>(y, x);
  const float gone = 1 - mix_.at<Pixel4>(y, x)[3];
  return o[3] > 1e-3F ? Pixel3(o[0], o[1], o[2]) * (gone / o[3]) : Pixel3(0, 0, 0);
}

// Least squares for the inks in linear light. Gloss washes out the inks of an arm seen at a grazing angle: the arm that
// shows them purest tells them, the others hardly count.
bool RodLook::find_inks() {
  struct Normal {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero(), b = Eigen::Matrix3d::Zero();
  };
  std::array<Normal, arms> by_arm;
  for (const auto& [y, x, i] : raster_.spots()) {
    const Pixel4& m = mix_.at<Pixel4>(y, x);
    const double w = weight_.at<float>(y, x);
    if (m[3] < mostly_rod || w == 0) continue;
    const Pixel3& c = rod_light_.at<Pixel3>(y, x);
    const Eigen::Vector3d v(m[0], m[1], m[2]);
    Normal& n = by_arm[arm_at(y, x)];
    n.a += w * v * v.transpose();
    n.b += w * v * Eigen::RowVector3d(c[0], c[1], c[2]);
  }
  std::size_t purest = 0;
  double purity = 0, most = 0;
  for (std::size_t i = 1; i < arms; ++i) most = std::max(most, by_arm[i].a.diagonal().minCoeff());
  for (std::size_t i = 1; i < arms; ++i) {
    if (by_arm[i].a.diagonal().minCoeff() < enough_to_tell * most) continue;
    const double here = purity_of(by_arm[i].a, by_arm[i].b);
    if (here > purity) {
      purity = here;
      purest = i;
    }
  }
  Eigen::Matrix3d a = 1e-3 * Eigen::Matrix3d::Identity(), b = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < arms; ++i) {
    const double share = purest == 0 || i == purest ? 1 : 0.02;
    a += share * by_arm[i].a;
    b += share * by_arm[i].b;
  }
  const Eigen::Matrix3d solved = a.ldlt().solve(b);
  if (!solved.allFinite()) return false;
  for (int ink = 0; ink < 3; ++ink)
    for (int c = 0; c < 3; ++c)
      inks_[static_cast<std::size_t>(ink)][c] = static_cast<float>(std::max(0.0, solved(ink, c)));
  veil_.fill(0);
  white_ = Pixel3(0, 0, 0);
  for (const Pixel3& ink : inks_) white_ += ink * (1 / (3 * std::max(1e-6F, sum(ink))));
  return true;
}

// What the rod shows where nothing is behind it. Gloss veils an arm seen at a grazing angle with the light's own
// colour.
cv::Vec3f RodLook::paint(int y, int x) const {
  const Pixel4& m = mix_.at<Pixel4>(y, x);
  const Pixel3 p = m[0] * inks_[0] + m[1] * inks_[1] + m[2] * inks_[2];
  const float veil = veil_[arm_at(y, x)];
  if (veil == 0) return p;
  return p * (1 - veil) + white_ * (veil * sum(p));
}

std::size_t RodLook::arm_at(int y, int x) const {
  const int arm = raster_.rod().arm_of(raster_.cell(static_cast<std::size_t>(y * seen_.cols + x)));
  return static_cast<std::size_t>(std::clamp(arm + 1, 0, static_cast<int>(arms) - 1));
}

// The share of white in each arm's look, by least squares over chromaticities.
void RodLook::find_veils() {
  std::array<double, arms> along{}, square{};
  for (const auto& [y, x, i] : raster_.spots()) {
    const double w = weight_.at<float>(y, x);
    if (mix_.at<Pixel4>(y, x)[3] < mostly_rod || w == 0) continue;
    const Pixel3& seen = rod_light_.at<Pixel3>(y, x);
    Pixel3 expected = paint(y, x);
    const float a = sum(seen), b = sum(expected);
    if (a < 1e-3F || b < 1e-3F) continue;
    expected *= 1 / b;
    const Pixel3 towards = white_ - expected;
    along[arm_at(y, x)] += w * (seen * (1 / a) - expected).dot(towards);
    square[arm_at(y, x)] += w * towards.dot(towards);
  }
  for (std::size_t i = 0; i < arms; ++i)
    // As if some pixels had been seen without.
    veil_[i] = static_cast<float>(std::clamp(along[i] / (square[i] + 0.5), 0.0, 0.8));
}

// Brightness against the inks, smooth over a few pixels: shade, highlights, and the two arms' own light.
void RodLook::find_shading() {
  ratio_.create(seen_.rows, seen_.cols, CV_32FC2);
  ratio_.setTo(0);
  for (const auto& [y, x, i] : raster_.spots()) {
    if (mix_.at<Pixel4>(y, x)[3] <= mostly_rod) continue;
    const float w = weight_.at<float>(y, x) + 0.01F;
    ratio_.at<cv::Vec2f>(y, x) = {w * sum(rod_light_.at<Pixel3>(y, x)), w * sum(paint(y, x))};
  }
  local_mean(ratio_, shading_, 3.0);
}

}  // namespace onestroke

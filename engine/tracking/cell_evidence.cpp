#include "tracking/cell_evidence.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

constexpr double samples_per_cell = 2;
// Working pixels: so many tell as much as a cell seen in full, however many that one has. Those that the camera blurs
// into one another tell the same: times its variance.
constexpr double pixels_of_a_cell = 250, pixels_of_a_blur = 25;
// How common plain things are where a rod may be, and the square over which they are plain: working pixels, and rods'
// thicknesses where a thick rod is not reduced.
constexpr float plain_share = 0.2F;
constexpr int plain_side = 21;
constexpr double plain_thicknesses = 1.5;
// Of the sensor, linear light.
constexpr float sensor_noise = 0.004F, black = 0.003F;

// The mean of what is seen on the rod around each pixel; the fourth component is not used.
cv::Mat plain_picture(const RodRaster& raster, const cv::Mat& seen, int side) {
  cv::Mat part(seen.rows, seen.cols, CV_32FC4, cv::Scalar(0, 0, 0, 0)), mean;
  for (const auto& [y, x, i] : raster.spots()) {
    if (!raster.on_rod(y, x)) continue;
    const Pixel3& c = seen.at<Pixel3>(y, x);
    part.at<Pixel4>(y, x) = Pixel4(c[0], c[1], c[2], 1);
  }
  cv::blur(part, mean, cv::Size(side, side), cv::Point(-1, -1), cv::BORDER_CONSTANT);
  return mean;
}

}  // namespace

void CellEvidence::see(const cv::Mat& seen, Plain plain_over) {
  samples_.clear();
  const double thickness = 2 * raster_.rod().radius() * around_.pixels_per_mm() / raster_.factor();
  const int rings = 2 * static_cast<int>(plain_thicknesses * thickness / 2) + 1;
  const cv::Mat plain =
      plain_picture(raster_, seen, plain_over == Plain::close_by ? plain_side : std::max(plain_side, rings));
  for (const auto& [y, x, i] : raster_.spots()) {
    if (!raster_.on_rod(y, x)) continue;
    const Pixel3& c = seen.at<Pixel3>(y, x);
    const Pixel4& p = plain.at<Pixel4>(y, x);
    const Color chroma = chroma_of(c);
    samples_.push_back({y, x, static_cast<std::size_t>(raster_.cell(i)), chroma,
                        chroma_of(Pixel3(p[0], p[1], p[2]) * (1 / std::max(p[3], 1e-6F))),
                        sensor_noise / (c[0] + c[1] + c[2] + black), around_.density(chroma)});
  }
}

void CellEvidence::weigh(float spread, float any_ring) {
  std::array<double, max_cells> share;
  share.fill(samples_per_cell / pixels_in_full());
  weigh(spread, any_ring, share);
}

void CellEvidence::weigh_parts(float spread, const EigenPose& pose, const CameraBlur& blur) {
  std::array<double, max_cells> share;
  const RodModel& rod = raster_.rod();
  for (int c = 0; c < rod.cell_count(); ++c) {
    const double sigma = blur.at((pose * rod.middle(c).centre).z());
    const double enough = std::max(pixels_of_a_cell, pixels_of_a_blur * sigma * sigma);
    share[static_cast<std::size_t>(c)] = samples_per_cell / std::min(pixels_in_full(), enough);
  }
  weigh(spread, 0, share);
}

double CellEvidence::pixels_in_full() const {
  const RodModel& rod = raster_.rod();
  const double scale = around_.pixels_per_mm() / raster_.factor();
  return 2 * rod.radius() * rod.pitch() * scale * scale;
}

void CellEvidence::weigh(float spread, float any_ring, const std::array<double, max_cells>& share) {
  std::array<double, max_cells> pixels{};
  surroundings_.fill(0);
  plain_.fill(0);
  for (const Sample& s : samples_) {
    if (!look_.known(s.y, s.x)) continue;
    const float variance = spread * spread + s.noise * s.noise;
    float as_rod = (1 - any_ring) * chroma_density(s.seen - chroma_of(look_.picture().at<Pixel3>(s.y, s.x)), variance);
    if (any_ring > 0)
      for (const Color& ink : inks_.chroma) as_rod += any_ring / 3 * chroma_density(s.seen - ink, variance);
    ++pixels[s.cell];
    surroundings_[s.cell] += share[s.cell] * log_ratio(as_rod, s.around);
    plain_[s.cell] +=
        share[s.cell] * log_ratio(as_rod, s.around + plain_share * chroma_density(s.seen - s.plain, variance));
  }
  for (std::size_t c = 0; c < pixels.size(); ++c) {
    // A rod that is taken for nearer than it is does not see more.
    const double excess = std::max(1.0, share[c] / samples_per_cell * pixels[c]);
    surroundings_[c] /= excess;
    plain_[c] /= excess;
  }
}

double CellEvidence::weakest_arm() const {
  double weakest = 1e9;
  const RodModel& rod = raster_.rod();
  for (int first = 0, last = 0; first < rod.cell_count(); first = last) {
    while (last < rod.cell_count() && rod.arm_of(last) == rod.arm_of(first)) ++last;
    if (rod.arm_of(first) < 0) continue;
    const auto from = static_cast<std::size_t>(first), count = static_cast<std::size_t>(last - first);
    weakest = std::min(weakest, visible_or_covered(against_surroundings().subspan(from, count)));
  }
  return weakest;
}

}  // namespace onestroke

#include "tracking/photometric_fit.h"

#include "tracking/cell_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

// Blur of both pictures beyond the camera's own, from wide, which draws a far start in, to narrow. Working pixels.
constexpr std::array<double, 12> extra_blur{2.5, 2.0, 1.5, 1.0, 0.7, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
// Blurs of the camera that are tried, working pixels, what it is taken for until one is chosen, and at which steps that
// is.
constexpr std::array<double, 9> camera_blurs{0.35, 0.6, 0.9, 1.3, 1.9, 2.7, 3.8, 4.6, 5.5};
constexpr double usual_blur = 0.6;
constexpr std::array<std::size_t, 2> blur_chosen_at{1, 4};
// Times the blur chosen, what is tried near by once it is sure to be the right one, and at which step that is.
constexpr std::array<double, 5> blurs_near_by{0.84, 0.92, 1, 1.09, 1.19};
constexpr std::size_t blur_measured_at = 7;
constexpr double momentum = 0.8;
// From afar no more steps than these are taken: what little an arm at the camera shows draws no further.
constexpr std::size_t steps_from_afar = 10;
// The rod may look thicker than it is, as the brighter one of two things does: standard deviation, mm.
constexpr double growth_sigma = 0.1;
// Information that holds the growth at none.
constexpr double no_growth = 1e12;

// An ink shows more of its own channel than any other ink does, by this share at least.
constexpr float min_ink_lead = 0.06F;

// Standard deviations of a chromaticity about what is predicted that are tried.
constexpr std::array<float, 4> spreads{0.02F, 0.035F, 0.06F, 0.1F};

// While the pose is not fitted yet, what shows on the rod may be another ring than predicted.
constexpr float may_be_any_ring = 0.3F;

// What a blur is worth with which nothing shows.
constexpr double nowhere = -1e9;

class Fitter {
 public:
  Fitter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks, const Surroundings& around)
      : inks_(inks), raster_(image, k, rod), look_(raster_), evidence_(raster_, look_, inks, around) {}

  PhotometricFit run(const EigenPose& start, const PhotometricOptions& options) {
    result_.pose = start;
    near_ = options.near;
    if (!raster_.crop(start)) return result_;
    camera_blur_ = options.blur > 0 ? options.blur / raster_.factor() : usual_blur;
    result_.valid = (options.fit ? fit(options.blur == 0) : look()) && score();
    return result_;
  }

 private:
  // Measures the pose as it is.
  bool look() {
    blur_picture(extra_blur.back());
    if (!cast() || !first_weights()) return false;
    // Once for the inks, and once more for what they show to be covered.
    return reweigh() && reweigh();
  }

  bool fit(bool find_blur) {
    EigenPose& pose = result_.pose;
    Vector6d last = Vector6d::Zero();
    const std::size_t steps = near_ ? extra_blur.size() : steps_from_afar;
    for (std::size_t i = 0; i < steps; ++i) {
      blur_picture(extra_blur[i]);
      if (!cast()) return false;
      if (i == 0 && !first_weights()) return false;
      if (find_blur && std::find(blur_chosen_at.begin(), blur_chosen_at.end(), i) != blur_chosen_at.end())
        choose_blur(camera_blurs);
      if (find_blur && near_ && i == blur_measured_at) measure_blur();
      if (!reweigh()) return false;
      Vector6d step;
      if (!solve(step)) return false;
      // Shading and weights follow the pose a step behind, so that steps come out short.
      if (near_ && i > 4 && step.head<3>().dot(last.head<3>()) > 0) step += momentum * last;
      last = step;
      const double turn = step.head<3>().norm(), shift = step.tail<3>().norm() / pose.t.norm();
      step *= std::min({1.0, 0.15 / std::max(turn, 1e-12), 0.05 / std::max(shift, 1e-12)});
      pose = perturbed(pose, step);
      if (pose.t.z() < 10) return false;
      if (i > 5 && turn < 2e-5 && shift < 2e-6) break;
    }
    return cast() && reweigh() && result_.covariance.allFinite();
  }

  // Free to choose its inks the fit may explain anything of one colour: they have to differ as inks do.
  bool inks_differ() const {
    std::array<Color, 3> found;
    for (std::size_t i = 0; i < 3; ++i) found[i] = chroma_of(look_.inks()[i]);
    const auto told = [&](std::size_t ink) { return cv::sum(look_.inks()[ink])[0] > 0.005; };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const auto own = static_cast<Eigen::Index>(i);
        if (i != j && told(i) && told(j) && found[i][own] < found[j][own] + min_ink_lead) return false;
      }
    return true;
  }

  // How far colours scatter about what is predicted is the picture's own: the likeliest.
  bool score() {
    if (!inks_differ()) return false;
    result_.blur = camera_blur_ * raster_.factor();
    result_.likelihood = result_.proof = -1e9;
    evidence_.sample(seen_);
    for (const float spread : spreads) {
      evidence_.weigh(spread, 0);
      result_.proof = std::max(result_.proof, visible_or_covered(evidence_.against_plain()));
      const double here = visible_or_covered(evidence_.against_surroundings());
      if (here <= result_.likelihood) continue;
      result_.likelihood = here;
      result_.weakest_arm = evidence_.weakest_arm();
    }
    return true;
  }

  void blur_picture(double extra) {
    extra_ = extra;
    gaussian_blur(raster_.linear(), seen_, extra_);
  }

  bool cast() { return raster_.cast(result_.pose, 2 + 2.5 * std::hypot(camera_blur_, extra_)); }

  // Before inks are known in linear light: the pixels whose ink is the one expected.
  bool first_weights() {
    weight_.create(seen_.rows, seen_.cols, CV_32F);
    weight_.setTo(0);
    int agreeing = 0;
    for (const auto& [y, x, i] : raster_.spots()) {
      const Pixel4& m = raster_.mix().at<Pixel4>(y, x);
      const Pixel3& c = raster_.coded().at<Pixel3>(y, x);
      for (int ink = 0; ink < 3; ++ink)
        if (m[ink] > 0.7F && inks_.match({c[0], c[1], c[2]}, ink) == Inks::Match::agrees) {
          weight_.at<float>(y, x) = 1;
          ++agreeing;
        }
    }
    return agreeing >= 20;
  }

  bool reweigh() {
    if (!look_.compose(seen_, weight_, camera_blur_, extra_)) return false;
    weigh();
    return true;
  }

  // Tukey's biweight of each pixel's error, and what the errors come to.
  void weigh() {
    evidence_.sample(seen_);
    evidence_.weigh(inks_.spread(), may_be_any_ring);
    visible_probabilities(evidence_.against_plain(), visible_);
    errors_.clear();
    for (const auto& [y, x, i] : raster_.spots())
      if (raster_.on_rod(y, x) && visible(i) > 0.5F) errors_.push_back(look_.known(y, x) ? error(y, x) : 1.0F);
    cost_ = 1;
    if (errors_.empty()) return;
    const auto middle = errors_.begin() + static_cast<std::ptrdiff_t>(errors_.size() / 2);
    std::nth_element(errors_.begin(), middle, errors_.end());
    const float scale = std::max(0.06F, 1.2F * *middle);
    double sum = 0, square = 0, shown = 0;
    for (const auto& [y, x, i] : raster_.spots()) {
      float& w = weight_.at<float>(y, x);
      w = 0;
      if (!look_.known(y, x)) continue;
      const float e = error(y, x), u = e / (3.5F * scale);
      if (u < 1) w = (1 - u * u) * (1 - u * u) * visible(i);
      if (!raster_.on_rod(y, x)) continue;
      sum += w;
      square += w * e * e;
      ++shown;
    }
    result_.residual = std::sqrt(square / std::max(sum, 1e-9));
    result_.explained = sum / std::max(shown, 1.0);
    // A picture that looks nowhere as predicted fits no better for leaving everything out.
    cost_ = 0;
    for (const float e : errors_) cost_ += std::min(e, 0.6F);
    cost_ /= static_cast<double>(errors_.size());
  }

  float visible(std::size_t i) const { return static_cast<float>(visible_[static_cast<std::size_t>(raster_.cell(i))]); }

  float level(int y, int x) const {
    const Pixel3& m = look_.picture().at<Pixel3>(y, x);
    return 0.02F + (m[0] + m[1] + m[2]) / 3;
  }

  float error(int y, int x) const {
    const Pixel3 d = seen_.at<Pixel3>(y, x) - look_.picture().at<Pixel3>(y, x);
    return std::sqrt((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 3) / level(y, x);
  }

  // The blur with which the rod shows best, where it is sure to be there, or else the one with which it errs least.
  void choose_blur(std::span<const double> candidates) {
    const cv::Mat before = weight_.clone();
    double best = nowhere, chosen = camera_blur_;
    for (const double candidate : candidates) {
      // From afar it changes little once it is chosen.
      if (!near_ && chosen_ && (candidate < 0.6 * chosen || candidate > 1.6 * chosen)) continue;
      camera_blur_ = candidate;
      before.copyTo(weight_);
      if (!reweigh()) continue;
      const double worth = near_ ? visible_or_covered(evidence_.against_plain()) : -cost_;
      if (worth <= best) continue;
      best = worth;
      chosen = candidate;
    }
    camera_blur_ = chosen;
    chosen_ = true;
    before.copyTo(weight_);
  }

  void measure_blur() {
    std::array<double, blurs_near_by.size()> candidates;
    std::transform(blurs_near_by.begin(), blurs_near_by.end(), candidates.begin(),
                   [this](double times) { return times * camera_blur_; });
    choose_blur(candidates);
  }

  // Gauss-Newton on the pose and the growth, which is taken for linear: it is a tenth of a pixel.
  bool solve(Vector6d& step) {
    Matrix7d hessian = Matrix7d::Zero();
    Vector7d gradient = Vector7d::Zero();
    const cv::Mat& picture = look_.picture();
    double total = 0;
    for (const auto& [y, x, i] : raster_.spots()) {
      if (y == 0 || x == 0 || y + 1 == picture.rows || x + 1 == picture.cols) continue;
      const float w = weight_.at<float>(y, x);
      if (w == 0) continue;
      Vec2d pixel;
      Eigen::Matrix<double, 2, 3> by_point;
      if (!project(raster_.intrinsics(), raster_.point(i), pixel, by_point)) continue;
      const Pixel3 dx = (picture.at<Pixel3>(y, x + 1) - picture.at<Pixel3>(y, x - 1)) * 0.5F;
      const Pixel3 dy = (picture.at<Pixel3>(y + 1, x) - picture.at<Pixel3>(y - 1, x)) * 0.5F;
      const Pixel3 r = seen_.at<Pixel3>(y, x) - picture.at<Pixel3>(y, x);
      const double norm = 1 / level(y, x);
      const Vec3d arm = raster_.point(i) - result_.pose.t, out = outwards(i);
      total += w;
      for (int c = 0; c < 3; ++c) {
        if (std::abs(dx[c]) + std::abs(dy[c]) < 1e-5F) continue;
        const Vec3d g = -norm / raster_.factor() * (by_point.transpose() * Vec2d(dx[c], dy[c]));
        Vector7d j;
        j << arm.cross(g), g, out.dot(g);
        hessian.selfadjointView<Eigen::Lower>().rankUpdate(j, w);
        gradient += w * norm * r[c] * j;
      }
    }
    if (total < 30) return false;
    hessian = Matrix7d(hessian.selfadjointView<Eigen::Lower>());
    // Neighbouring pixels err alike within the blur.
    const double alike = std::max(1.0, 4 * std::numbers::pi * extra_ * extra_);
    const double variance = std::max(alike * result_.residual * result_.residual, 1e-12);
    hessian(6, 6) += near_ ? variance / (growth_sigma * growth_sigma) : no_growth;
    Matrix7d damped = hessian;
    damped.diagonal() *= 1 + 1e-4;
    step = damped.ldlt().solve(gradient).head<6>();
    if (!step.allFinite()) return false;
    const Vector6d mixed = hessian.block<6, 1>(0, 6);
    const Matrix6d pose = hessian.topLeftCorner<6, 6>() - mixed * mixed.transpose() / hessian(6, 6);
    result_.covariance = covariance_of(pose / variance);
    return true;
  }

  // How a point of the surface, camera axes, moves as the rod grows.
  Vec3d outwards(std::size_t i) const {
    const RodModel& rod = raster_.rod();
    const RodModel::Section& section = rod.middle(raster_.cell(i));
    const Vec3d from = raster_.point(i) - result_.pose * section.centre, along = result_.pose.R * section.tangent;
    return (from - from.dot(along) * along) / rod.radius();
  }

  const Inks& inks_;
  RodRaster raster_;
  RodLook look_;
  CellEvidence evidence_;
  PhotometricFit result_;
  double camera_blur_ = usual_blur, extra_ = 0, cost_ = 0;
  bool near_ = false;
  bool chosen_ = false;
  cv::Mat seen_, weight_;
  std::vector<float> errors_;
  std::array<double, max_cells> visible_{};  // Probability, by cell.
};

}  // namespace

PhotometricFit fit_photometric(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                               const Inks& inks, const Surroundings& surroundings, const EigenPose& start,
                               const PhotometricOptions& options) {
  return Fitter(image, intrinsics, rod, inks, surroundings).run(start, options);
}

}  // namespace onestroke

#include "tracking/photometric_fit.h"

#include "tracking/blur_search.h"
#include "tracking/cell_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

// Blur of both pictures beyond the camera's own, from wide, which draws a far start in, to narrow. Working pixels.
constexpr std::array<double, 12> extra_from_near{2.0, 2.0, 1.5, 1.0, 0.7, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
constexpr std::array<double, 12> extra_from_afar{2.5, 2.0, 1.5, 1.0, 0.7, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
// Blurs of the camera that are tried, working pixels.
constexpr std::array<double, 9> camera_blurs{0.35, 0.6, 0.9, 1.3, 1.9, 2.7, 3.8, 4.6, 5.5};
// Of the rod's nearest and farthest ends, and times what they are, as the fit draws in.
constexpr std::array<double, 12> end_blurs{-5.5, -3.8, -2.7, -1.9, -1.2, -0.6, 0.6, 1.2, 1.9, 2.7, 3.8, 5.5};
constexpr std::array<double, 6> ends_about{0.5, 0.7, 0.85, 1.2, 1.4, 2}, ends_near_by{0.7, 0.84, 0.92, 1.09, 1.19, 1.4};
// Times an even blur.
constexpr std::array<double, 5> blurs_near_by{0.84, 0.92, 1, 1.09, 1.19};
// The steps at which the blur is looked for; the last twice where there are fewer.
constexpr std::array<std::size_t, 3> afar_at{1, 4, 4}, near_at{1, 4, 7}, by_depth_at{0, 3, 6};
// Of what near fits search, working pixels.
constexpr double widest_near = 9;
// The share of the camera's own blur by which both pictures of a near fit are blurred once more, at the least.
constexpr double noise_in_blur = 0.25;
constexpr double momentum = 0.8;
// From afar no more steps than these are taken: what little an arm at the camera shows draws no further.
constexpr std::size_t steps_from_afar = 10;
// The rod may look thicker than it is, as the brighter one of two things does: standard deviation, mm.
constexpr double growth_sigma = 0.1;
// Information that holds the growth at none.
constexpr double no_growth = 1e12;

// Free to choose its inks a fit may explain anything of one colour: they have to differ as inks do. An ink shows more
// of its own channel than any other ink does, by this share at least; where a fit starts from, in the mean of all inks.
constexpr float min_ink_lead = 0.06F, min_mean_lead_at_start = 0.05F;

// Standard deviations of a chromaticity about what is predicted that are tried.
constexpr std::array<float, 4> spreads{0.02F, 0.035F, 0.06F, 0.1F};

// While the pose is not fitted yet, what shows on the rod may be another ring than predicted.
constexpr float may_be_any_ring = 0.3F;

class Fitter {
 public:
  Fitter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks, const Surroundings& around)
      : inks_(inks), raster_(image, k, rod), look_(raster_), evidence_(raster_, look_, inks, around) {}

  PhotometricFit run(const EigenPose& start, const PhotometricOptions& options, bool by_depth) {
    by_depth_ = by_depth;
    result_.pose = start;
    near_ = options.near;
    if (!raster_.crop(start, near_ ? RodRaster::Detail::full : RodRaster::Detail::enough)) return result_;
    camera_blur_.middle = (start * raster_.rod().centre()).z();
    if (options.blur) camera_blur_ = options.blur->scaled(1.0 / raster_.factor());
    result_.valid = (options.fit ? fit(!options.blur) : look()) && score();
    return result_;
  }

 private:
  // Measures the pose as it is.
  bool look() {
    blur_picture(std::max(extra_from_afar.back(), least_extra()));
    if (!cast() || !first_weights()) return false;
    // Once for the inks, and once more for what they show to be covered.
    return reweigh() && reweigh();
  }

  bool fit(bool blur_unknown) {
    EigenPose& pose = result_.pose;
    Vector6d last = Vector6d::Zero();
    const auto& extra = by_depth_ ? extra_from_near : extra_from_afar;
    const std::size_t steps = near_ ? extra.size() : steps_from_afar;
    for (std::size_t i = 0; i < steps; ++i) {
      blur_picture(std::max(extra[i], least_extra()));
      if (!cast()) return false;
      if (i == 0 && !first_weights()) return false;
      if (blur_unknown) find_blur(i);
      if (!reweigh()) return false;
      if (i == 0 && ink_lead().mean < min_mean_lead_at_start) return false;
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

  struct InkLead {
    float least = 1, mean = 1;
  };
  // How much more of its own channel each ink shows than another does, of those that were told.
  InkLead ink_lead() const {
    std::array<Color, 3> found;
    for (std::size_t i = 0; i < 3; ++i) found[i] = chroma_of(look_.inks()[i]);
    const auto told = [&](std::size_t ink) { return cv::sum(look_.inks()[ink])[0] > 0.005; };
    InkLead lead;
    float sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (i == j || !told(i) || !told(j)) continue;
        const auto own = static_cast<Eigen::Index>(i);
        const float here = found[i][own] - found[j][own];
        lead.least = std::min(lead.least, here);
        sum += here;
        ++count;
      }
    if (count > 0) lead.mean = sum / static_cast<float>(count);
    return lead;
  }

  // How far colours scatter about what is predicted is the picture's own: the likeliest.
  bool score() {
    if (ink_lead().least < min_ink_lead) return false;
    result_.blur = camera_blur_.scaled(raster_.factor());
    result_.likelihood = result_.proof = -1e9;
    evidence_.see(seen_, CellEvidence::Plain::some_rings);
    for (const float spread : spreads) {
      evidence_.weigh_parts(spread, result_.pose, camera_blur_);
      result_.proof = std::max(result_.proof, visible_or_covered(evidence_.against_plain()));
      const double here = visible_or_covered(evidence_.against_surroundings());
      if (here <= result_.likelihood) continue;
      result_.likelihood = here;
      result_.weakest_arm = evidence_.weakest_arm();
    }
    return true;
  }

  // Noise within the blur tells nothing, and what is far off in it would be taken for a cover.
  double least_extra() const { return by_depth_ ? noise_in_blur * std::abs(camera_blur_.sigma) : 0; }

  void blur_picture(double extra) {
    extra_ = extra;
    gaussian_blur(raster_.linear(), seen_, extra_);
    look_.see(seen_, extra_);
  }

  // What lies out of the widest blur's reach counts for nothing.
  bool cast() {
    const double widest = near_ ? widest_near : std::abs(camera_blur_.sigma);
    if (!raster_.cast(result_.pose, 2 + 2.5 * std::hypot(widest, extra_))) return false;
    evidence_.see(seen_, CellEvidence::Plain::close_by);
    return true;
  }

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
    if (!look_.compose(weight_, camera_blur_)) return false;
    weigh();
    return true;
  }

  // Tukey's biweight of each pixel's error, and what the errors come to.
  void weigh() {
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

  // What a blur is worth: how well the rod shows with it, where it is sure to be there, or else how little it errs. It
  // is measured from the same weights each time.
  double worth(const cv::Mat& weight, const CameraBlur& blur) {
    camera_blur_ = blur;
    weight.copyTo(weight_);
    if (!reweigh()) return std::numeric_limits<double>::lowest();
    return near_ ? visible_or_covered(evidence_.against_plain()) : -cost_;
  }

  // Looks for the camera's blur at the steps that are meant for it; the weights stay as they are.
  void find_blur(std::size_t step) {
    const auto at = by_depth_ ? by_depth_at : near_ ? near_at : afar_at;
    if (std::find(at.begin(), at.end(), step) == at.end()) return;
    const cv::Mat weight = weight_.clone();
    const auto measure = [&](const CameraBlur& blur) { return worth(weight, blur); };
    const CameraBlur now = camera_blur_;
    camera_blur_ = by_depth_ ? blur_by_depth(step, now, measure)
                   : near_   ? blur_near(step, now, measure)
                             : blur_afar(step, now, measure);
    weight.copyTo(weight_);
  }

  static CameraBlur blur_afar(std::size_t step, const CameraBlur& now, const BlurWorth& measure) {
    return step == afar_at.front() ? best_even_blur(now, camera_blurs, measure)
                                   : best_even_blur_near_by(now, camera_blurs, measure);
  }

  static CameraBlur blur_near(std::size_t step, const CameraBlur& now, const BlurWorth& measure) {
    if (step != near_at.back()) return best_even_blur(now, camera_blurs, measure);
    std::array<double, blurs_near_by.size()> sigmas;
    std::transform(blurs_near_by.begin(), blurs_near_by.end(), sigmas.begin(),
                   [&](double times) { return times * now.sigma; });
    return best_even_blur(now, sigmas, measure);
  }

  CameraBlur blur_by_depth(std::size_t step, const CameraBlur& now, const BlurWorth& measure) const {
    const DepthRange range = depth_range();
    if (step == by_depth_at[0])
      return best_blur_by_depth(best_even_blur(now, camera_blurs, measure), range, {end_blurs}, measure);
    return best_blur_by_depth(now, range, {step == by_depth_at[1] ? ends_about : ends_near_by, true}, measure);
  }

  DepthRange depth_range() const {
    DepthRange range{std::numeric_limits<double>::max(), 0};
    const RodModel& rod = raster_.rod();
    for (int e = 0; e <= rod.cell_count(); ++e) {
      const double z = (result_.pose * rod.edge(e).centre).z();
      range = {std::min(range.near, z), std::max(range.far, z)};
    }
    return range;
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
  CameraBlur camera_blur_;
  double extra_ = 0, cost_ = 0;
  bool near_ = false, by_depth_ = false;
  cv::Mat seen_, weight_;
  std::vector<float> errors_;
  std::array<double, max_cells> visible_{};  // Probability, by cell.
};

}  // namespace

PhotometricFit fit_photometric(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                               const Inks& inks, const Surroundings& surroundings, const EigenPose& start,
                               const PhotometricOptions& options) {
  Fitter fitter(image, intrinsics, rod, inks, surroundings);
  if (!options.near || !options.fit) return fitter.run(start, options, options.near);
  const PhotometricFit even = fitter.run(start, options, false);
  const PhotometricFit by_depth = Fitter(image, intrinsics, rod, inks, surroundings).run(start, options, true);
  if (!even.valid || !by_depth.valid) return even.valid ? even : by_depth;
  return likelier(even, by_depth) ? even : by_depth;
}

}  // namespace onestroke

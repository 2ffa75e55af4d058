#include "tracking/photometric_fit.h"

#include <opencv2/imgproc.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Pixel3 = cv::Vec3f;
using Pixel4 = cv::Vec4f;

// The picture is reduced until the rod is about this many pixels thick: more tell nothing that the ring edges do not.
constexpr double working_thickness = 14;
// Blur of both pictures beyond the camera's own, from wide, which draws a far start in, to narrow. Working pixels.
constexpr std::array<double, 10> extra_blur{2.5, 2.0, 1.5, 1.0, 0.7, 0.5, 0.5, 0.5, 0.5, 0.5};
// Blurs of the camera that are tried, working pixels.
constexpr std::array<double, 7> camera_blurs{0.35, 0.6, 0.9, 1.3, 1.9, 2.7, 3.8};
constexpr std::array<std::size_t, 2> blur_chosen_at{1, 4};

// Where this share of a pixel is rod, the pixel tells the rod's colour.
constexpr float mostly_rod = 0.7F;

// Arms told apart, and the bends.
constexpr std::size_t arms = 8;
// No cell.
constexpr std::uint8_t nothing = 255;

const std::array<float, 256>& linear_light() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double v = static_cast<double>(i) / 255;
      t[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table;
}

void blur(const cv::Mat& from, cv::Mat& to, double sigma) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
  cv::GaussianBlur(from, to, cv::Size(2 * reach + 1, 2 * reach + 1), sigma, sigma, cv::BORDER_REPLICATE);
}

// The mean over a square: where it need not be smooth, only local.
void local_mean(const cv::Mat& from, cv::Mat& to, double sigma) {
  const int side = 2 * static_cast<int>(std::lround(1.7 * sigma)) + 1;
  cv::blur(from, to, cv::Size(side, side), cv::Point(-1, -1), cv::BORDER_REPLICATE);
}

class Fitter {
 public:
  Fitter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks, const Surroundings& around)
      : image_(image), k_(k), rod_(rod), inks_(inks), around_(around), caster_(rod) {}

  PhotometricFit run(const EigenPose& start, const PhotometricOptions& options) {
    PhotometricFit fit;
    fit.pose = start;
    if (!crop(start)) return fit;
    camera_blur_ = options.blur > 0 ? options.blur / factor_ : 0.6;
    if (!options.fit) return look(fit);
    for (std::size_t i = 0; i < extra_blur.size(); ++i) {
      extra_ = extra_blur[i];
      blur(linear_, smoothed_, extra_);
      if (!render(fit.pose)) return fit;
      if (i == 0 && !first_weights()) return fit;
      if (options.blur == 0 && std::find(blur_chosen_at.begin(), blur_chosen_at.end(), i) != blur_chosen_at.end())
        choose_blur();
      if (!compose()) return fit;
      weigh();
      Vector6d step;
      if (!solve(fit.pose, step)) return fit;
      const double turn = step.head<3>().norm(), shift = step.tail<3>().norm() / fit.pose.t.norm();
      step *= std::min({1.0, 0.15 / std::max(turn, 1e-12), 0.05 / std::max(shift, 1e-12)});
      fit.pose = perturbed(fit.pose, step);
      if (fit.pose.t.z() < 10) return fit;
      if (i > 5 && turn < 2e-5 && shift < 2e-6) break;
    }
    if (!render(fit.pose) || !compose()) return fit;
    weigh();
    fit.likelihood = likelihood();
    fit.covariance = covariance_;
    fit.residual = residual_;
    fit.explained = explained_;
    fit.blur = camera_blur_ * factor_;
    fit.valid = fit.covariance.allFinite();
    return fit;
  }

 private:
  // Measures the pose as it is.
  PhotometricFit look(PhotometricFit fit) {
    extra_ = extra_blur.back();
    blur(linear_, smoothed_, extra_);
    if (!render(fit.pose) || !first_weights()) return fit;
    // Once for the colours, and once more for what they show to be covered.
    for (int i = 0; i < 2; ++i) {
      if (!compose()) return fit;
      weigh();
    }
    fit.likelihood = likelihood();
    fit.residual = residual_;
    fit.explained = explained_;
    fit.blur = camera_blur_ * factor_;
    fit.valid = true;
    return fit;
  }

  // Cuts out what the rod may move in, reduced to working pixels.
  bool crop(const EigenPose& pose) {
    const double depth = (pose * rod_.centre()).z();
    if (depth < 10) return false;
    factor_ = std::max(1, static_cast<int>(2 * rod_.radius() * k_.fx / depth / working_thickness));
    double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
    for (int e = 0; e <= rod_.cell_count(); ++e) {
      Vec2d p;
      if (!project(k_, pose * rod_.edge(e).centre, p)) return false;
      x0 = std::min(x0, p.x()), x1 = std::max(x1, p.x());
      y0 = std::min(y0, p.y()), y1 = std::max(y1, p.y());
    }
    const double margin = 1.5 * rod_.radius() * k_.fx / depth + 14.0 * factor_;
    left_ = std::max(0, static_cast<int>((x0 - margin) / factor_));
    top_ = std::max(0, static_cast<int>((y0 - margin) / factor_));
    const int right = std::min(image_.width / factor_, static_cast<int>((x1 + margin) / factor_) + 1);
    const int bottom = std::min(image_.height / factor_, static_cast<int>((y1 + margin) / factor_) + 1);
    if (right - left_ < 8 || bottom - top_ < 8) return false;
    reduce(right - left_, bottom - top_);
    find_active(pose);
    return true;
  }

  void reduce(int width, int height) {
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

  // Which ink each pixel would show, and the surface point that it would show or that is nearest to it.
  bool render(const EigenPose& pose) {
    const int width = linear_.cols, height = linear_.rows;
    mix_.create(height, width, CV_32FC4);
    mix_.setTo(0);
    points_.resize(rays_.size());
    near_.assign(rays_.size(), 0);
    cell_.resize(rays_.size());
    shown_.resize(rays_.size());
    const Mat3d back = pose.R.transpose();
    const Vec3d eye = -back * pose.t;
    const double scale = k_.fx / factor_;
    const double reach = 2 + 2.5 * std::hypot(camera_blur_, extra_);
    int inside = 0;
    std::fill(shown_.begin(), shown_.end(), nothing);
    for (const auto& [y, x, i] : active_) {
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
    const auto w = static_cast<std::size_t>(width);
    for (const auto& [y, x, i] : active_) {
      if (y == 0 || x == 0 || y + 1 == height || x + 1 == width) continue;
      Pixel4& m = mix_.at<Pixel4>(y, x);
      const std::uint8_t c = shown_[i];
      if (c == shown_[i - 1] && c == shown_[i + 1] && c == shown_[i - w] && c == shown_[i + w] &&
          c == shown_[i - w - 1] && c == shown_[i - w + 1] && c == shown_[i + w - 1] && c == shown_[i + w + 1]) {
        if (c != nothing) m[rod_.ink(c)] = m[3] = 1;
        continue;
      }
      // The outline or a ring edge may cross the pixel.
      const double h = 0.25 / scale;
      for (const auto& [dx, dy] : {std::pair{-h, -h}, {h, -h}, {-h, h}, {h, h}}) {
        const RodCaster::Hit part = caster_.cast(eye, back * (rays_[i] + Vec3d(dx, dy, 0)));
        if (!part.hit) continue;
        m[rod_.ink(cell_at(part.s))] += 0.25F;
        m[3] += 0.25F;
      }
    }
    return inside > 30;
  }

  // The pixels that the rod may come to cover or touch; the rest is surroundings.
  void find_active(const EigenPose& pose) {
    std::vector<cv::Point> line;
    double thickness = 0;
    for (int e = 0; e <= rod_.cell_count(); ++e) {
      Vec2d p;
      const Vec3d centre = pose * rod_.edge(e).centre;
      if (!project(k_, centre, p)) continue;
      line.emplace_back(static_cast<int>(std::clamp(p.x() / factor_ - left_, -1e4, 1e4)),
                        static_cast<int>(std::clamp(p.y() / factor_ - top_, -1e4, 1e4)));
      thickness = std::max(thickness, 2 * rod_.radius() * k_.fx / factor_ / std::max(1.0, centre.z()));
    }
    cv::Mat mask(linear_.rows, linear_.cols, CV_8U, cv::Scalar(0));
    cv::polylines(mask, line, false, cv::Scalar(1), std::min(static_cast<int>(1.3 * thickness) + 26, 250));
    active_.clear();
    for (int y = 0; y < mask.rows; ++y)
      for (int x = 0; x < mask.cols; ++x)
        if (mask.at<std::uint8_t>(y, x)) active_.push_back({y, x, static_cast<std::size_t>(y * mask.cols + x)});
  }

  std::uint8_t cell_at(double s) const {
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(s / rod_.pitch()), 0, rod_.cell_count() - 1));
  }

  // Before colours are known: the pixels whose ink is the one expected.
  bool first_weights() {
    weight_.create(linear_.rows, linear_.cols, CV_32F);
    weight_.setTo(0);
    int agreeing = 0;
    for (const auto& [y, x, i] : active_) {
      const Pixel4& m = mix_.at<Pixel4>(y, x);
      const Pixel3& c = coded_.at<Pixel3>(y, x);
      for (int ink = 0; ink < 3; ++ink)
        if (m[ink] > 0.7F && inks_.match({c[0], c[1], c[2]}, ink) == Inks::Match::agrees) {
          weight_.at<float>(y, x) = 1;
          ++agreeing;
        }
    }
    return agreeing >= 20;
  }

  // The surroundings and the rod's shading by local means, the rod's colours by least squares over what is trusted;
  // then the picture that the camera should have taken.
  bool compose() {
    blur(mix_, blurred_, std::hypot(camera_blur_, extra_));
    surround();
    Eigen::Matrix3d a = 1e-3 * Eigen::Matrix3d::Identity(), b = Eigen::Matrix3d::Zero();
    for (const auto& [y, x, i] : active_) {
      const Pixel4& m = blurred_.at<Pixel4>(y, x);
      const double w = weight_.at<float>(y, x);
      if (m[3] < mostly_rod || w == 0) continue;
      const Pixel3 c = rod_light_.at<Pixel3>(y, x);
      const Eigen::Vector3d v(m[0], m[1], m[2]);
      a += w * v * v.transpose();
      b += w * v * Eigen::RowVector3d(c[0], c[1], c[2]);
    }
    const Eigen::Matrix3d solved = a.ldlt().solve(b);
    if (!solved.allFinite()) return false;
    for (int ink = 0; ink < 3; ++ink)
      for (int c = 0; c < 3; ++c)
        colours_[static_cast<std::size_t>(ink)][c] = static_cast<float>(std::max(0.0, solved(ink, c)));
    find_veils();
    shade();
    smoothed_.copyTo(model_);
    usable_.create(linear_.rows, linear_.cols, CV_8U);
    usable_.setTo(0);
    for (const auto& [y, x, i] : active_) {
      const Pixel4& m = blurred_.at<Pixel4>(y, x);
      const Pixel4& o = outside_.at<Pixel4>(y, x);
      const Pixel4& l = light_.at<Pixel4>(y, x);
      const bool known = 1 - m[3] < 0.03F || o[3] > 1e-3F;
      const bool lit = m[3] < 0.03F || l[1] > 1e-5F;
      usable_.at<std::uint8_t>(y, x) = known && lit && near_[i];
      const float shading = l[1] > 1e-5F ? l[0] / l[1] : 1.0F;
      model_.at<Pixel3>(y, x) = paint(y, x) * shading + behind(y, x);
    }
    return true;
  }

  // What the surroundings add to a pixel.
  Pixel3 behind(int y, int x) const {
    const Pixel4& o = outside_.at<Pixel4>(y, x);
    const float gone = 1 - blurred_.at<Pixel4>(y, x)[3];
    return o[3] > 1e-3F ? Pixel3(o[0], o[1], o[2]) * (gone / o[3]) : Pixel3(0, 0, 0);
  }

  void surround() {
    cv::Mat outside;
    cv::merge(std::array<cv::Mat, 2>{smoothed_, cv::Mat(linear_.rows, linear_.cols, CV_32F, cv::Scalar(1))}, outside);
    for (const auto& [y, x, i] : active_) {
      if (blurred_.at<Pixel4>(y, x)[3] >= 0.02F) outside.at<Pixel4>(y, x) = Pixel4(0, 0, 0, 0);
    }
    blur(outside, outside_, std::max(3.0, 1.2 * std::hypot(camera_blur_, extra_)));
    rod_light_.create(linear_.rows, linear_.cols, CV_32FC3);
    for (const auto& [y, x, i] : active_) rod_light_.at<Pixel3>(y, x) = smoothed_.at<Pixel3>(y, x) - behind(y, x);
  }

  // What the rod shows where nothing is behind it. Gloss veils an arm seen at a grazing angle with the light's own
  // colour.
  Pixel3 paint(int y, int x) const {
    const Pixel4& m = blurred_.at<Pixel4>(y, x);
    const Pixel3 p = m[0] * colours_[0] + m[1] * colours_[1] + m[2] * colours_[2];
    const float veil = veil_[arm_at(y, x)];
    if (veil == 0) return p;
    return p * (1 - veil) + white_ * (veil * (p[0] + p[1] + p[2]));
  }

  std::size_t arm_at(int y, int x) const {
    const int arm = rod_.arm_of(cell_[static_cast<std::size_t>(y * linear_.cols + x)]);
    return static_cast<std::size_t>(std::clamp(arm + 1, 0, static_cast<int>(veil_.size()) - 1));
  }

  // The share of white in each arm's look, by least squares over chromaticities.
  void find_veils() {
    veil_.fill(0);
    white_ = Pixel3(0, 0, 0);
    for (const Pixel3& ink : colours_) white_ += ink * (1 / (3 * std::max(1e-6F, ink[0] + ink[1] + ink[2])));
    std::array<double, arms> along{}, square{};
    for (const auto& [y, x, i] : active_) {
      const double w = weight_.at<float>(y, x);
      if (blurred_.at<Pixel4>(y, x)[3] < mostly_rod || w == 0) continue;
      Pixel3 seen = rod_light_.at<Pixel3>(y, x), expected = paint(y, x);
      const float a = seen[0] + seen[1] + seen[2], b = expected[0] + expected[1] + expected[2];
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

  // Brightness against the mean colours, smooth over a few pixels: shade, highlights, and the two arms' own light.
  void shade() {
    cv::Mat ratio(linear_.rows, linear_.cols, CV_32FC4, cv::Scalar(0, 0, 0, 0));
    for (const auto& [y, x, i] : active_) {
      const Pixel4& m = blurred_.at<Pixel4>(y, x);
      const Pixel3& c = rod_light_.at<Pixel3>(y, x);
      const float w = m[3] > mostly_rod ? weight_.at<float>(y, x) + 0.01F : 0.0F;
      const Pixel3 p = paint(y, x);
      ratio.at<Pixel4>(y, x) = Pixel4(w * (c[0] + c[1] + c[2]), w * (p[0] + p[1] + p[2]), 0, 0);
    }
    local_mean(ratio, light_, 3.0);
  }

  void weigh() {
    scratch_.clear();
    for (const auto& [y, x, i] : active_)
      if (mix_.at<Pixel4>(y, x)[3] > 0.5F) scratch_.push_back(usable_.at<std::uint8_t>(y, x) ? error(y, x) : 1.0F);
    cost_ = 1;
    if (scratch_.empty()) return;
    const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    scale_ = std::max(0.06F, 1.2F * *middle);
    double sum = 0, square = 0, shown = 0;
    for (const auto& [y, x, i] : active_) {
      float& w = weight_.at<float>(y, x);
      w = 0;
      if (!usable_.at<std::uint8_t>(y, x)) continue;
      const float u = error(y, x) / (3.5F * scale_);
      if (u < 1) w = (1 - u * u) * (1 - u * u);
      if (mix_.at<Pixel4>(y, x)[3] <= 0.5F) continue;
      sum += w;
      square += w * error(y, x) * error(y, x);
      ++shown;
    }
    residual_ = std::sqrt(square / std::max(sum, 1e-9));
    explained_ = sum / std::max(shown, 1.0);
    // A picture that looks nowhere as predicted fits no better for leaving everything out.
    cost_ = 0;
    for (const float e : scratch_) cost_ += std::min(e, 0.6F);
    cost_ /= static_cast<double>(scratch_.size());
  }

  float level(int y, int x) const {
    const Pixel3& m = model_.at<Pixel3>(y, x);
    return 0.02F + (m[0] + m[1] + m[2]) / 3;
  }

  float error(int y, int x) const {
    const Pixel3 d = smoothed_.at<Pixel3>(y, x) - model_.at<Pixel3>(y, x);
    return std::sqrt((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 3) / level(y, x);
  }

  static Color chroma_of(const Pixel3& linear) {
    const auto code = [](float v) { return std::pow(std::max(v, 1e-5F), 1 / 2.2F); };
    return chromaticity({255 * code(linear[0]), 255 * code(linear[1]), 255 * code(linear[2])});
  }

  double likelihood() const {
    // A cell seen in full tells as much as this many independent samples.
    constexpr double samples_per_cell = 2;
    const double scale = around_.pixels_per_mm() / factor_;
    const double share = samples_per_cell / (2 * rod_.radius() * rod_.pitch() * scale * scale);
    const float spread = std::max(0.02F, 0.18F * inks_.separation);
    std::array<double, max_cells> shows{}, pixels{};
    for (const auto& [y, x, i] : active_) {
      const float cover = mix_.at<Pixel4>(y, x)[3];
      if (cover < 0.5F || !usable_.at<std::uint8_t>(y, x)) continue;
      const Pixel3& linear = smoothed_.at<Pixel3>(y, x);
      const float sum = linear[0] + linear[1] + linear[2];
      const Color seen = chroma_of(linear), expected = chroma_of(model_.at<Pixel3>(y, x));
      const float noise = 0.004F / (sum + 0.003F);
      const float variance = spread * spread + noise * noise;
      const Color d = seen - expected;
      const float density = std::exp(-0.5F * (d[0] * d[0] + d[1] * d[1]) / variance) / (6.2832F * variance);
      const std::size_t cell = cell_[i];
      ++pixels[cell];
      shows[cell] += share * std::max(-4.0, static_cast<double>(std::log(density / around_.density(seen) + 1e-9F)));
    }
    // A rod that is taken for nearer than it is does not see more.
    for (std::size_t c = 0; c < shows.size(); ++c) shows[c] /= std::max(1.0, share / samples_per_cell * pixels[c]);
    return visible_or_covered({shows.data(), static_cast<std::size_t>(rod_.cell_count())});
  }

  void choose_blur() {
    double best = 1e9, chosen = camera_blur_;
    const cv::Mat before = weight_.clone();
    for (const double candidate : camera_blurs) {
      // Once chosen it changes little.
      if (chosen_ && (candidate < 0.6 * chosen || candidate > 1.6 * chosen)) continue;
      camera_blur_ = candidate;
      before.copyTo(weight_);
      if (!compose()) continue;
      weigh();
      if (cost_ < best) {
        best = cost_;
        chosen = candidate;
      }
    }
    camera_blur_ = chosen;
    chosen_ = true;
    before.copyTo(weight_);
  }

  bool solve(const EigenPose& pose, Vector6d& step) {
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    const int width = model_.cols;
    double total = 0;
    for (const auto& [y, x, i] : active_) {
      if (y == 0 || x == 0 || y + 1 == model_.rows || x + 1 == width) continue;
      const float w = weight_.at<float>(y, x);
      if (w == 0) continue;
      const Vec3d& point = points_[i];
      Vec2d pixel;
      Eigen::Matrix<double, 2, 3> by_point;
      if (!project(k_, point, pixel, by_point)) continue;
      const Pixel3 dx = (model_.at<Pixel3>(y, x + 1) - model_.at<Pixel3>(y, x - 1)) * 0.5F;
      const Pixel3 dy = (model_.at<Pixel3>(y + 1, x) - model_.at<Pixel3>(y - 1, x)) * 0.5F;
      const Pixel3 r = smoothed_.at<Pixel3>(y, x) - model_.at<Pixel3>(y, x);
      const double norm = 1 / level(y, x);
      const Vec3d arm = point - pose.t;
      total += w;
      for (int c = 0; c < 3; ++c) {
        if (std::abs(dx[c]) + std::abs(dy[c]) < 1e-5F) continue;
        const Vec3d g = -norm / factor_ * (by_point.transpose() * Vec2d(dx[c], dy[c]));
        Vector6d j;
        j << arm.cross(g), g;
        hessian.selfadjointView<Eigen::Lower>().rankUpdate(j, w);
        gradient += w * norm * r[c] * j;
      }
    }
    hessian = Matrix6d(hessian.selfadjointView<Eigen::Lower>());
    if (total < 30) return false;
    Matrix6d damped = hessian;
    damped.diagonal() *= 1 + 1e-4;
    step = damped.ldlt().solve(gradient);
    if (!step.allFinite()) return false;
    Matrix6d information = hessian;
    information.diagonal() += 1e-9 * hessian.diagonal() + Vector6d::Constant(1e-12);
    // Neighbouring pixels err alike within the blur.
    const double alike = std::max(1.0, 4 * 3.14159 * extra_ * extra_);
    covariance_ = alike * residual_ * residual_ * information.inverse();
    return true;
  }

  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  const Inks& inks_;
  const Surroundings& around_;
  RodCaster caster_;
  int factor_ = 1, left_ = 0, top_ = 0;
  double camera_blur_ = 0.6, extra_ = 0, residual_ = 0, explained_ = 0, cost_ = 0;
  float scale_ = 0;
  std::array<float, arms> veil_{};  // By arm, the bends first.
  Pixel3 white_;
  std::array<Pixel3, 3> colours_;
  bool chosen_ = false;
  cv::Mat coded_, linear_, smoothed_, rod_light_, mix_, blurred_, outside_, light_, model_, weight_, usable_;
  std::vector<Vec3d> rays_, points_;
  std::vector<std::uint8_t> near_, cell_, shown_;
  struct Spot {
    int y, x;
    std::size_t i;  // In the planes of one value a pixel.
  };
  std::vector<Spot> active_;
  std::vector<float> scratch_;
  Matrix6d covariance_ = Matrix6d::Zero();
};

}  // namespace

PhotometricFit fit_photometric(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                               const Inks& inks, const Surroundings& surroundings, const EigenPose& start,
                               const PhotometricOptions& options) {
  return Fitter(image, intrinsics, rod, inks, surroundings).run(start, options);
}

}  // namespace onestroke

#include "tracking/head_calibration.h"

#include "core/error.h"
#include "tracking/hand_eye.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace onestroke {
namespace {

constexpr double degree = std::numbers::pi / 180;
// More add nothing but time.
constexpr std::size_t most_sights = 150;
// Normalised error squared of 6 degrees of freedom, which one of a thousand exceeds.
constexpr double agreement = 22.46;
// Of three components each of a deviation 1, the median length.
constexpr double median_length = 1.538;
// A first look for outliers: so many deviations, and never less than this.
constexpr double first_look = 5, least_rad = 1e-4, least_mm = 0.1;
constexpr int most_looks = 8;
constexpr int concentrations = 4, rough = 6;
// More outliers than that are no outliers.
constexpr double most_outliers = 0.4;
// What is less certain than this is of no use.
constexpr double worst_deg = 2, worst_mm = 30;
// More is no noise of a tracker's.
constexpr double worst_residual_deg = 3, worst_residual_mm = 30;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(why +
              ": nod, look left and right and tilt the head, 20 degrees each way, slowly and with the marker in sight");
}

[[noreturn]] void refuse_misfit() {
  throw Error(
      "what the head and the camera say does not fit together: the marker must stand still in the room and the lens be "
      "known (--fov or --calibration), and the head's poses must be of the pictures' times");
}

std::string degrees(double value) {
  return std::to_string(std::lround(value)) + " degrees";
}

void check_turn(const HeadTurn& turn) {
  if (turn.second_deg >= least_head_turn_deg) return;
  refuse("the head turned by " + degrees(turn.first_deg) + " about one axis and by " + degrees(turn.second_deg) +
         " about any other, which does not tell how it carries its camera");
}

std::vector<HeadSight> unlike(std::span<const HeadSight> sights) {
  std::vector<HeadSight> kept;
  for (const HeadSight& sight : sights)
    if (std::ranges::none_of(kept, [&](const HeadSight& k) { return heads_alike(k.T_world_head, sight.T_world_head); }))
      kept.push_back(sight);
  if (kept.size() <= most_sights) return kept;
  std::vector<HeadSight> some;
  for (std::size_t i = 0; i < most_sights; ++i) some.push_back(kept[i * kept.size() / most_sights]);
  return some;
}

std::vector<EigenSight> to_eigen(const std::vector<HeadSight>& sights) {
  std::vector<EigenSight> all;
  for (const HeadSight& sight : sights) all.push_back(to_eigen(sight));
  return all;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

template <typename Chosen>
std::vector<EigenSight> chosen(const std::vector<EigenSight>& sights, const Chosen& is) {
  std::vector<EigenSight> some;
  std::ranges::copy_if(sights, std::back_inserter(some), is);
  return some;
}

/// From a start to the half of the sights that agree best, and to what they say (least trimmed squares by
/// concentration: Rousseeuw, Van Driessen 2006).
void concentrate(const std::vector<EigenSight>& sights, HandEyeFit& fit) {
  std::vector<EigenSight> sorted = sights;
  const std::size_t half = std::min(sights.size(), sights.size() / 2 + 4);
  for (int round = 0; round < concentrations; ++round) {
    std::ranges::sort(sorted, {}, [&](const EigenSight& sight) { return hand_eye_disagreement(fit.found, sight); });
    fit.found = fit_hand_eye(fit, {sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(half)}, rough).found;
  }
}

void guess_noise(const std::vector<EigenSight>& sights, double rad, double mm, HandEyeNoise& noise) {
  const bool known =
      std::ranges::all_of(sights, [](const EigenSight& s) { return s.covariance.diagonal().minCoeff() > 0; });
  const std::size_t shares = known ? 2 : 4;
  for (std::size_t k = 0; k < HandEyeNoise::parts; ++k) {
    noise.estimated[k] = k < shares;
    if (k < shares) noise.variance[k] = (k % 2 == 0 ? rad * rad : mm * mm) / 2;
  }
}

/// The start, a guess of the noise, and who agrees with it.
std::vector<EigenSight> first_agreeing(const std::vector<EigenSight>& sights, HandEyeFit& fit) {
  fit.found = start_hand_eye(sights);
  guess_noise(sights, degree, 1, fit.noise);
  concentrate(sights, fit);
  std::vector<double> turned, moved;
  for (const EigenSight& sight : sights) {
    const Vector6d r = hand_eye_residual(fit.found, sight);
    turned.push_back(r.head<3>().norm());
    moved.push_back(r.tail<3>().norm());
  }
  const double rad = std::max(median(turned) / median_length, least_rad),
               mm = std::max(median(moved) / median_length, least_mm);
  guess_noise(sights, rad, mm, fit.noise);
  return chosen(sights, [&](const EigenSight& sight) {
    const Vector6d r = hand_eye_residual(fit.found, sight);
    return r.head<3>().norm() < first_look * median_length * rad &&
           r.tail<3>().norm() < first_look * median_length * mm;
  });
}

bool agrees(const HandEyeFit& fit, const EigenSight& sight) {
  const Vector6d r = hand_eye_residual(fit.found, sight);
  return r.dot(hand_eye_covariance(fit.found, sight, fit.noise).ldlt().solve(r)) < agreement;
}

/// Fits those that agree, until they stay the same.
std::vector<EigenSight> fit_agreeing(const std::vector<EigenSight>& sights, HandEyeFit& fit) {
  std::vector<EigenSight> agreeing = first_agreeing(sights, fit);
  for (int look = 0; look < most_looks; ++look) {
    if (static_cast<double>(agreeing.size()) < (1 - most_outliers) * static_cast<double>(sights.size()))
      refuse_misfit();
    fit = fit_hand_eye(fit, agreeing);
    std::vector<EigenSight> again = chosen(sights, [&](const EigenSight& s) { return agrees(fit, s); });
    if (again.size() == agreeing.size()) break;
    agreeing = std::move(again);
  }
  return agreeing;
}

HeadResiduals residuals_of(const HandEyeFit& fit, const std::vector<EigenSight>& sights, double focal_px) {
  HeadResiduals sum;
  const auto count = [](double value, double& squares, double& worst) {
    squares += value * value;
    worst = std::max(worst, value);
  };
  for (const EigenSight& sight : sights) {
    const Vector6d r = hand_eye_residual(fit.found, sight);
    const Vec3d &is = sight.T_camera_marker.t, expected = is - r.tail<3>();
    count(r.head<3>().norm() / degree, sum.rms_deg, sum.worst_deg);
    count(r.tail<3>().norm(), sum.rms_mm, sum.worst_mm);
    count(focal_px * (is.head<2>() / is.z() - expected.head<2>() / expected.z()).norm(), sum.rms_px, sum.worst_px);
  }
  for (double* squares : {&sum.rms_deg, &sum.rms_mm, &sum.rms_px})
    *squares = std::sqrt(*squares / static_cast<double>(sights.size()));
  return sum;
}

void say_how_certain(const HandEyeFit& fit, HeadCalibration& result) {
  const Matrix12d all = fit.information.ldlt().solve(Matrix12d::Identity());
  const Matrix6d covariance = all.topLeftCorner<6, 6>();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(result.covariance.data()) = covariance;
  const Vector6d deviation = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  result.deviation_deg = Vec3{deviation[0], deviation[1], deviation[2]} / degree;
  result.deviation_mm = {deviation[3], deviation[4], deviation[5]};
}

void check_certain(const HeadCalibration& result) {
  if (result.residuals.rms_deg > worst_residual_deg || result.residuals.rms_mm > worst_residual_mm) refuse_misfit();
  const double deg = norm(result.deviation_deg), mm = norm(result.deviation_mm);
  if (deg < worst_deg && mm < worst_mm) return;
  refuse("the camera's place in the head is known to " + degrees(deg) + " and " + std::to_string(std::lround(mm)) +
         " mm only");
}

// Rotation vectors from the mean of all; their scatter tells the axes.
HeadTurn turn_of(const std::vector<Mat3d>& heads) {
  if (heads.empty()) return {};
  const auto from = [](const Mat3d& mean, const Mat3d& head) {
    return perturbation({mean, Vec3d::Zero()}, {head, Vec3d::Zero()}).head<3>().eval();
  };
  Mat3d mean = heads.front();
  Mat3d scatter;
  for (int round = 0; round < 4; ++round) {
    Vec3d sum = Vec3d::Zero();
    scatter.setZero();
    for (const Mat3d& head : heads) {
      const Vec3d w = from(mean, head);
      sum += w;
      scatter += w * w.transpose();
    }
    Vector6d step = Vector6d::Zero();
    step.head<3>() = sum / static_cast<double>(heads.size());
    if (round < 3) mean = perturbed({mean, Vec3d::Zero()}, step).R;
  }
  const Mat3d axes = Eigen::SelfAdjointEigenSolver<Mat3d>(scatter).eigenvectors();
  Eigen::Array3d low = Eigen::Array3d::Constant(10), high = -low;
  for (const Mat3d& head : heads) {
    const Eigen::Array3d along = axes.transpose() * from(mean, head);
    low = low.min(along);
    high = high.max(along);
  }
  return {.first_deg = (high[2] - low[2]) / degree, .second_deg = (high[1] - low[1]) / degree};
}

HeadTurn turn_of(const std::vector<EigenSight>& sights) {
  std::vector<Mat3d> heads;
  for (const EigenSight& sight : sights) heads.push_back(sight.T_world_head.R);
  return turn_of(heads);
}

}  // namespace

HeadTurn head_turn(std::span<const HeadSight> sights) {
  return turn_of(to_eigen({sights.begin(), sights.end()}));
}

bool heads_alike(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation) < head_sights_apart_deg * degree &&
         norm(a.translation - b.translation) < head_sights_apart_mm;
}

HeadCalibration calibrate_head(std::span<const HeadSight> given, double focal_px) {
  const std::vector<EigenSight> sights = to_eigen(unlike(given));
  if (sights.size() < fewest_head_sights)
    refuse("there are only " + std::to_string(sights.size()) + " sights of the marker from different places");
  check_turn(turn_of(sights));
  HandEyeFit fit;
  const std::vector<EigenSight> agreeing = fit_agreeing(sights, fit);
  HeadCalibration result;
  result.turn = turn_of(agreeing);
  // Outliers may have made up what seemed a turn.
  check_turn(result.turn);
  say_how_certain(fit, result);
  result.T_head_camera = from_eigen(fit.found.T_head_camera);
  result.T_world_marker = from_eigen(fit.found.T_world_marker);
  result.residuals = residuals_of(fit, agreeing, focal_px);
  result.used = agreeing.size();
  result.outliers = sights.size() - agreeing.size();
  result.alike = given.size() - sights.size();
  check_certain(result);
  return result;
}

}  // namespace onestroke

#include "tracking/hand_eye.h"

#include "core/error.h"

#include <opencv2/calib3d.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <random>

namespace onestroke {
namespace {

// Draws of so few sights that one of them is free of outliers even where a third of all are such: all but surely so
// after so many.
constexpr std::size_t draw = 5;
constexpr int draws = 80;

Mat3d cross_matrix(const Vec3d& v) {
  Mat3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

EigenPose inverse(const EigenPose& p) {
  return {p.R.transpose(), -(p.R.transpose() * p.t)};
}

/// The marker's origin as the head sees it.
Vec3d marker_from_head(const HandEye& guess, const EigenSight& sight) {
  return inverse(sight.T_world_head) * guess.T_world_marker.t;
}

EigenPose predicted(const HandEye& guess, const EigenSight& sight) {
  const Mat3d R_camera_head = guess.T_head_camera.R.transpose();
  return {R_camera_head * sight.T_world_head.R.transpose() * guess.T_world_marker.R,
          R_camera_head * (marker_from_head(guess, sight) - guess.T_head_camera.t)};
}

struct CvPose {
  cv::Mat R = cv::Mat(3, 3, CV_64F), t = cv::Mat(3, 1, CV_64F);

  explicit CvPose(const EigenPose& p) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) R.at<double>(i, j) = p.R(i, j);
      t.at<double>(i) = p.t[i];
    }
  }
};

EigenPose from_cv(const cv::Mat& R, const cv::Mat& t) {
  EigenPose p;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) p.R(i, j) = R.at<double>(i, j);
    p.t[i] = t.at<double>(i);
  }
  // A rotation up to rounding becomes one.
  return to_eigen(from_eigen(p));
}

std::optional<HandEye> solve(const std::vector<EigenSight>& sights, const std::vector<std::size_t>& which) {
  std::vector<cv::Mat> R_camera_marker, t_camera_marker, R_head_world, t_head_world;
  for (const std::size_t i : which) {
    const CvPose marker(sights[i].T_camera_marker), world(inverse(sights[i].T_world_head));
    R_camera_marker.push_back(marker.R);
    t_camera_marker.push_back(marker.t);
    R_head_world.push_back(world.R);
    t_head_world.push_back(world.t);
  }
  cv::Mat R_marker_world, t_marker_world, R_camera_head, t_camera_head;
  try {
    cv::calibrateRobotWorldHandEye(R_camera_marker, t_camera_marker, R_head_world, t_head_world, R_marker_world,
                                   t_marker_world, R_camera_head, t_camera_head);
  } catch (const cv::Exception&) {
    // Sights that tell nothing.
    return std::nullopt;
  }
  if (!cv::checkRange(R_marker_world) || !cv::checkRange(t_marker_world) || !cv::checkRange(R_camera_head) ||
      !cv::checkRange(t_camera_head))
    return std::nullopt;
  return HandEye{.T_head_camera = inverse(from_cv(R_camera_head, t_camera_head)),
                 .T_world_marker = inverse(from_cv(R_marker_world, t_marker_world))};
}

double median_disagreement(const HandEye& guess, const std::vector<EigenSight>& sights) {
  std::vector<double> off;
  off.reserve(sights.size());
  for (const EigenSight& sight : sights) off.push_back(hand_eye_disagreement(guess, sight));
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::ranges::nth_element(off, middle);
  return *middle;
}

}  // namespace

EigenSight to_eigen(const HeadSight& sight) {
  return {.T_world_head = to_eigen(sight.T_world_head),
          .T_camera_marker = to_eigen(sight.T_camera_marker),
          .covariance = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(sight.covariance.data())};
}

Vector6d hand_eye_residual(const HandEye& guess, const EigenSight& sight) {
  return perturbation(predicted(guess, sight), sight.T_camera_marker);
}

double hand_eye_disagreement(const HandEye& guess, const EigenSight& sight) {
  const Vector6d r = hand_eye_residual(guess, sight);
  return r.head<3>().norm() * sight.T_camera_marker.t.norm() + r.tail<3>().norm();
}

Eigen::Matrix<double, 6, 12> hand_eye_jacobian(const HandEye& guess, const EigenSight& sight) {
  const Mat3d R_camera_head = guess.T_head_camera.R.transpose();
  const Mat3d R_camera_world = R_camera_head * sight.T_world_head.R.transpose();
  const Vec3d arm = marker_from_head(guess, sight) - guess.T_head_camera.t;
  Eigen::Matrix<double, 6, 12> J = Eigen::Matrix<double, 6, 12>::Zero();
  J.block<3, 3>(0, 0) = R_camera_head;
  J.block<3, 3>(3, 0) = -R_camera_head * cross_matrix(arm);
  J.block<3, 3>(3, 3) = R_camera_head;
  J.block<3, 3>(0, 6) = -R_camera_world;
  J.block<3, 3>(3, 9) = -R_camera_world;
  return J;
}

// A head that is elsewhere than it is said to be, in its own axes, is to the camera as a camera that sits elsewhere.
std::array<Matrix6d, HandEyeNoise::parts> hand_eye_noise_shapes(const HandEye& guess, const EigenSight& sight) {
  Matrix6d M = Matrix6d::Identity();
  M.block<3, 3>(3, 0) = -cross_matrix(guess.T_head_camera.t);
  const Matrix6d J = hand_eye_jacobian(guess, sight).leftCols<6>() * M;
  std::array<Matrix6d, HandEyeNoise::parts> shapes;
  shapes[HandEyeNoise::head_rotation] = J.leftCols<3>() * J.leftCols<3>().transpose();
  shapes[HandEyeNoise::head_translation] = J.rightCols<3>() * J.rightCols<3>().transpose();
  shapes[HandEyeNoise::marker_rotation].setZero();
  shapes[HandEyeNoise::marker_rotation].diagonal().head<3>().setOnes();
  shapes[HandEyeNoise::marker_translation].setZero();
  shapes[HandEyeNoise::marker_translation].diagonal().tail<3>().setOnes();
  return shapes;
}

Matrix6d hand_eye_covariance(const HandEye& guess, const EigenSight& sight, const HandEyeNoise& noise) {
  const auto shapes = hand_eye_noise_shapes(guess, sight);
  Matrix6d covariance = sight.covariance;
  for (std::size_t k = 0; k < shapes.size(); ++k) covariance += noise.variance[k] * shapes[k];
  return covariance;
}

HandEye start_hand_eye(const std::vector<EigenSight>& sights) {
  std::vector<std::size_t> all(sights.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::optional<HandEye> best;
  double least = 0;
  const auto offer = [&](const std::optional<HandEye>& guess) {
    if (!guess) return;
    const double off = median_disagreement(*guess, sights);
    if (best && !(off < least)) return;
    best = guess;
    least = off;
  };
  offer(solve(sights, all));
  std::mt19937 random(1);
  for (int i = 0; i < draws && sights.size() > draw; ++i) {
    std::vector<std::size_t> some;
    std::ranges::sample(all, std::back_inserter(some), draw, random);
    offer(solve(sights, some));
  }
  if (!best)
    throw Error("the sights do not tell how the head carries its camera: move the head more, and record again");
  return *best;
}

}  // namespace onestroke

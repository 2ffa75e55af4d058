#include "camera/rig_file.h"

#include "core/error.h"

#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* remedy = "; give what cv::stereoCalibrate found, in OpenCV's YAML";
// Of two eyes' cameras; what is outside is in another unit.
constexpr double least_apart = 5, most_apart = 1000;  // mm
// What a polynomial may be off the rational model within the picture, pixels.
constexpr double most_lens_error = 0.25;

cv::FileStorage open_storage(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw Error("rig " + file.string() + " is not there" + remedy);
  try {
    cv::FileStorage storage(file.string(), cv::FileStorage::READ);
    if (storage.isOpened()) return storage;
  } catch (const cv::Exception&) {
    // Said below in the program's own words.
  }
  throw Error("rig " + file.string() + " cannot be read" + remedy);
}

/// The first matrix of these names; empty where there is none.
cv::Mat find_matrix(const cv::FileStorage& storage, std::initializer_list<const char*> names) {
  cv::Mat m;
  for (const char* name : names) {
    try {
      if (m.empty()) storage[name] >> m;
    } catch (const cv::Exception&) {
      m.release();
    }
  }
  if (!m.empty()) m.convertTo(m, CV_64F);
  return m.channels() == 1 ? m : cv::Mat();
}

Pose read_place(const cv::FileStorage& storage, const fs::path& file) {
  const cv::Mat r = find_matrix(storage, {"R"}), t = find_matrix(storage, {"T"});
  if (r.rows != 3 || r.cols != 3 || t.total() != 3)
    throw Error("rig " + file.string() + " has no rotation R and translation T" + remedy);
  const cv::Mat off = r * r.t() - cv::Mat::eye(3, 3, CV_64F);
  if (cv::norm(off) > 1e-3 || cv::determinant(r) < 0)
    throw Error("rig " + file.string() + ": R is no rotation" + remedy);
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = r.at<double>(i, j);
  const cv::Mat flat = t.reshape(1, 1);
  const Pose T_second_first{to_quat(m), {flat.at<double>(0), flat.at<double>(1), flat.at<double>(2)}};
  const double apart = norm(T_second_first.translation);
  if (!(apart >= least_apart && apart <= most_apart))
    throw Error("rig " + file.string() + ": its cameras are " + std::to_string(apart) +
                " mm apart, which two eyes are not; T must be in millimetres, so calibrate with the size of the "
                "board's squares in millimetres");
  return inverse(T_second_first);
}

/// k1, k2 and k3 with which the polynomial bends rays as the rational model does, up to the radius r in the plane
/// z = 1: least squares. `error` is the most that it is off.
std::array<double, 3> polynomial_of(const std::array<double, 8>& d, double r, double& error) {
  constexpr int samples = 100;
  cv::Mat a(samples, 3, CV_64F), b(samples, 1, CV_64F), k;
  for (int i = 0; i < samples; ++i) {
    const double x = r * (i + 1) / samples, x2 = x * x;
    const double bent = (1 + x2 * (d[0] + x2 * (d[1] + x2 * d[4]))) / (1 + x2 * (d[5] + x2 * (d[6] + x2 * d[7])));
    b.at<double>(i) = x * (bent - 1);
    for (int j = 0; j < 3; ++j) a.at<double>(i, j) = x * std::pow(x2, j + 1);
  }
  cv::solve(a, b, k, cv::DECOMP_SVD);
  error = cv::norm(a * k - b, cv::NORM_INF);
  return {k.at<double>(0), k.at<double>(1), k.at<double>(2)};
}

std::array<double, 5> read_distortion(const cv::Mat& given, const Intrinsics& k, const std::string& name,
                                      const fs::path& file) {
  std::array<double, 8> d{};
  for (std::size_t i = 0; i < given.total(); ++i) {
    const double value = given.reshape(1, 1).at<double>(static_cast<int>(i));
    if (i < d.size()) d[i] = value;
    if (!std::isfinite(value) || (i >= d.size() && value != 0))
      throw Error("rig " + file.string() + ": " + name +
                  " has coefficients of a thin prism or a tilted sensor; calibrate without them");
  }
  std::array<double, 5> plain{d[0], d[1], d[2], d[3], d[4]};
  if (d[5] == 0 && d[6] == 0 && d[7] == 0) return plain;
  double error = 0;
  const auto radial = polynomial_of(d, std::hypot(k.cx / k.fx, k.cy / k.fy), error);
  if (!(error * k.fx < most_lens_error))
    throw Error("rig " + file.string() + ": " + name +
                " bends more than k1 k2 p1 p2 k3 can say; calibrate without CALIB_RATIONAL_MODEL");
  return {radial[0], radial[1], d[2], d[3], radial[2]};
}

LensSource read_lens(const cv::FileStorage& storage, const fs::path& file, const std::string& number) {
  const std::string matrix_name = "M" + number, bend_name = "D" + number;
  const cv::Mat m = find_matrix(storage, {matrix_name.c_str(), ("cameraMatrix" + number).c_str()});
  const cv::Mat bend = find_matrix(storage, {bend_name.c_str(), ("distCoeffs" + number).c_str()});
  if (m.rows != 3 || m.cols != 3 || !(m.at<double>(0, 0) > 0) || !(m.at<double>(1, 1) > 0) || bend.empty())
    throw Error("rig " + file.string() + " has no lens " + matrix_name + " and " + bend_name + remedy);
  // OpenCV counts from the centre of the first pixel, this program from its corner.
  Intrinsics k{m.at<double>(0, 0), m.at<double>(1, 1), m.at<double>(0, 2) + 0.5, m.at<double>(1, 2) + 0.5};
  k.distortion = read_distortion(bend, k, bend_name, file);
  const auto size = [&](const char* name) { return std::max(0, static_cast<int>(storage[name].real())); };
  const int width = storage["image_width"].isInt() ? size("image_width") : 0;
  const int height = storage["image_height"].isInt() ? size("image_height") : 0;
  return {file, k, height > 0 ? width : 0, width > 0 ? height : 0};
}

std::array<LensSource, 2> read_lenses(const cv::FileStorage& storage, const fs::path& file) {
  return {read_lens(storage, file, "1"), read_lens(storage, file, "2")};
}

bool has_lenses(const cv::FileStorage& storage) {
  return !find_matrix(storage, {"M1", "cameraMatrix1"}).empty();
}

}  // namespace

Rig read_rig(const fs::path& file) {
  const cv::FileStorage storage = open_storage(file);
  Rig rig{.T_first_second = read_place(storage, file)};
  const fs::path beside = file.parent_path() / "intrinsics.yml";
  if (has_lenses(storage))
    rig.lenses = read_lenses(storage, file);
  else if (fs::is_regular_file(beside))
    rig.lenses = read_lenses(open_storage(beside), beside);
  return rig;
}

Rig parallel_rig(double baseline_mm) {
  return {.T_first_second = {{}, {baseline_mm, 0, 0}}};
}

}  // namespace onestroke

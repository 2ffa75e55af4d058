#include "camera/lens_source.h"

#include "core/error.h"

#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>

namespace onestroke {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

bool near_middle(double place, int size) {
  return place > 0.3 * size && place < 0.7 * size;
}

cv::FileStorage open_storage(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error("calibration " + file.string() + " is not there; give a file that `onestroke calibrate camera` wrote");
  }
  try {
    cv::FileStorage storage(file.string(), cv::FileStorage::READ);
    if (storage.isOpened()) return storage;
  } catch (const cv::Exception&) {
    // Said below in the program's own words.
  }
  throw Error("calibration " + file.string() + " cannot be read; it must be OpenCV's YAML");
}

cv::Mat read_matrix(const cv::FileStorage& storage, const char* name, const std::filesystem::path& file) {
  cv::Mat m;
  try {
    storage[name] >> m;
  } catch (const cv::Exception&) {
    m.release();
  }
  if (m.empty() || m.channels() != 1) {
    throw Error("calibration " + file.string() + " has no matrix " + name + "; calibrate the camera again");
  }
  m.convertTo(m, CV_64F);
  return m;
}

}  // namespace

LensSource::LensSource(const std::filesystem::path& calibration, std::optional<double> fov_rad)
    : file_(calibration), fov_rad_(fov_rad) {
  if (file_.empty()) return;
  const cv::FileStorage storage = open_storage(file_);
  width_ = static_cast<int>(storage["image_width"].real());
  height_ = static_cast<int>(storage["image_height"].real());
  if (!storage["image_width"].isInt() || !storage["image_height"].isInt() || width_ <= 0 || height_ <= 0) {
    throw Error("calibration " + file_.string() +
                " does not say image_width and image_height; calibrate the camera again");
  }
  const cv::Mat matrix = read_matrix(storage, "camera_matrix", file_);
  const cv::Mat bend = read_matrix(storage, "distortion_coefficients", file_);
  if (matrix.rows != 3 || matrix.cols != 3 || !(matrix.at<double>(0, 0) > 0) || !(matrix.at<double>(1, 1) > 0)) {
    throw Error("calibration " + file_.string() + ": camera_matrix is no camera's; calibrate the camera again");
  }
  Intrinsics k;
  if (bend.total() != 4 && bend.total() != 5) {
    throw Error("calibration " + file_.string() + " has " + std::to_string(bend.total()) +
                " distortion_coefficients; calibrate with 4 or 5 (k1 k2 p1 p2 k3)");
  }
  for (std::size_t i = 0; i < bend.total(); ++i) k.distortion[i] = bend.reshape(1, 1).at<double>(static_cast<int>(i));
  k.fx = matrix.at<double>(0, 0);
  k.fy = matrix.at<double>(1, 1);
  // OpenCV counts from the centre of the first pixel, this program from its corner.
  k.cx = matrix.at<double>(0, 2) + 0.5;
  k.cy = matrix.at<double>(1, 2) + 0.5;
  calibrated_ = k;
}

Intrinsics LensSource::intrinsics(int width, int height, const std::string& pictures) const {
  if (!calibrated_) return Intrinsics::from_fov(width, height, fov_rad_.value());
  if (width_ == 0) {
    if (!near_middle(calibrated_->cx, width) || !near_middle(calibrated_->cy, height)) {
      throw Error("calibration " + file_.string() + " is for pictures of another size than " + pictures + " has, " +
                  size_text(width, height) +
                  ": its principal point lies far from their middle; calibrate at that size");
    }
    return *calibrated_;
  }
  if (width != width_ || height != height_) {
    throw Error("calibration " + file_.string() + " is for pictures of " + size_text(width_, height_) + ", but " +
                pictures + " has " + size_text(width, height) + "; calibrate at that size");
  }
  return *calibrated_;
}

}  // namespace onestroke

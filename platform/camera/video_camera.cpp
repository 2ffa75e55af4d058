#include "camera/video_camera.h"

#include "camera/picture_bytes.h"
#include "core/error.h"
#include "core/picture_pool.h"

#include <opencv2/videoio.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace onestroke {
namespace {

constexpr std::size_t buffers = 7;
constexpr std::size_t name_length = 32;

cv::VideoCapture open_capture(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw Error("video " + file.string() + " is not there; give a video file");
  try {
    cv::VideoCapture capture(file.string(), cv::CAP_FFMPEG);
    if (capture.isOpened()) return capture;
  } catch (const cv::Exception&) {
    // Said below in the program's own words.
  }
  throw Error("video " + file.string() + " is cut short, damaged or no video; give one that FFmpeg can play");
}

class VideoCamera : public Camera {
 public:
  VideoCamera(const std::filesystem::path& file, const LensSource& lens, Duration readout)
      : file_(file), capture_(open_capture(file)), readout_(readout) {
    rate_ = std::max(0.0, capture_.get(cv::CAP_PROP_FPS));
    length_ = static_cast<std::size_t>(std::max(0.0, capture_.get(cv::CAP_PROP_FRAME_COUNT)));
    if (!read()) throw Error("video " + file.string() + " holds no picture that can be decoded; give another");
    intrinsics_ = lens.intrinsics(bgr_.cols, bgr_.rows, file.string());
    width_ = bgr_.cols;
    height_ = bgr_.rows;
    pool_.emplace(buffers, 3 * bgr_.total());
    ahead_ = true;
  }

  Status next(PictureHandle& picture) override {
    if (over_) return Status::end;
    PictureHandle::Loan* loan = pool_->acquire();
    if (!loan) return Status::busy;
    if ((!ahead_ && !read()) || !same_size()) {
      over_ = true;
      pool_->give_back(*loan);
      return Status::end;
    }
    ahead_ = false;
    swap_to_rgb(bgr_.data, bgr_.step, width_, height_, pool_->bytes(*loan).data());
    fill(*loan);
    picture = PictureHandle(*loan);
    ++next_;
    return Status::ok;
  }

  std::string message() const override { return message_; }
  bool live() const override { return false; }
  double rate() const override { return rate_; }
  std::size_t length() const override { return length_; }

 private:
  bool read() {
    bool good = false;
    try {
      good = capture_.read(bgr_) && bgr_.type() == CV_8UC3;
      if (good) time_ms_ = capture_.get(cv::CAP_PROP_POS_MSEC);
    } catch (const std::exception&) {
      good = false;
    }
    // Some containers only estimate how many pictures they hold.
    constexpr std::size_t estimate_error = 2;
    if (!good && next_ + estimate_error < length_) {
      message_ = "video " + file_.string() + " ends after " + std::to_string(next_) + " of " + std::to_string(length_) +
                 " pictures: it is cut short or damaged";
    }
    return good;
  }

  bool same_size() {
    if (bgr_.cols == width_ && bgr_.rows == height_) return true;
    message_ = "video " + file_.string() + " changes its size after " + std::to_string(next_) + " pictures; split it";
    return false;
  }

  void fill(PictureHandle::Loan& loan) {
    Picture& p = loan.picture;
    p.width = width_;
    p.height = height_;
    p.format = PixelFormat::rgb8;
    p.planes[0] = pool_->bytes(loan).data();
    p.strides[0] = 3 * static_cast<std::size_t>(width_);
    p.sequence = next_;
    p.exposure = {Time{Duration::from_ms(time_ms_).ns}, {}, readout_};
    p.intrinsics = intrinsics_;
    std::array<char, name_length>& name = names_[pool_->index(loan)];
    std::snprintf(name.data(), name.size(), "frame_%06llu", static_cast<unsigned long long>(next_));
    p.source = name.data();
  }

  std::filesystem::path file_;
  cv::VideoCapture capture_;
  Duration readout_;
  cv::Mat bgr_;
  double time_ms_ = 0, rate_ = 0;
  Intrinsics intrinsics_;
  int width_ = 0, height_ = 0;
  std::size_t length_ = 0, next_ = 0;
  bool ahead_ = false, over_ = false;
  std::optional<PicturePool> pool_;
  std::array<std::array<char, name_length>, buffers> names_{};
  std::string message_;
};

}  // namespace

std::unique_ptr<Camera> open_video(const std::filesystem::path& file, const LensSource& lens, Duration readout) {
  return std::make_unique<VideoCamera>(file, lens, readout);
}

}  // namespace onestroke

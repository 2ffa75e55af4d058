#pragma once

#include "core/camera.h"
#include "core/picture_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>

namespace onestroke {

/// Numbered pictures of 32 x 24 pixels, 10 ms apart, as fast as they are taken; then the end. A recording that can be
/// entered anywhere.
class CountingCamera : public Camera {
 public:
  explicit CountingCamera(std::size_t count, std::size_t buffers = 6, std::string message = {})
      : pool_(buffers, 3 * width * height), count_(count), message_(std::move(message)) {}

  Status next(PictureHandle& picture) override {
    if (const std::int64_t wanted = wanted_.exchange(-1); wanted >= 0)
      made_ = std::min<std::size_t>(count_, static_cast<std::size_t>(wanted + 9'999'999) / 10'000'000);
    if (made_ == count_) return Status::end;
    PictureHandle::Loan* loan = pool_.acquire();
    if (!loan) return Status::busy;
    Picture& p = loan->picture;
    p.width = width;
    p.height = height;
    p.planes[0] = pool_.bytes(*loan).data();
    p.strides[0] = 3 * width;
    p.intrinsics = Intrinsics::from_fov(width, height, 1);
    p.sequence = made_;
    p.exposure.start = {static_cast<std::int64_t>(made_) * 10'000'000};
    ++made_;
    picture = PictureHandle(*loan);
    return Status::ok;
  }
  std::string message() const override { return made_ == count_ ? message_ : std::string(); }
  bool live() const override { return false; }
  double rate() const override { return 100; }
  std::size_t length() const override { return count_; }
  bool seek(Duration after_start) override {
    wanted_.store(std::max<std::int64_t>(after_start.ns, 0));
    return true;
  }

 private:
  static constexpr int width = 32, height = 24;
  PicturePool pool_;
  std::size_t count_, made_ = 0;
  std::atomic<std::int64_t> wanted_{-1};
  std::string message_;
};

}  // namespace onestroke

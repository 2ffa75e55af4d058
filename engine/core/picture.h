#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace onestroke {

enum class PixelFormat { rgb8, gray8, nv12, yuyv };

/// Pinhole camera with OpenCV's distortion (k1 k2 p1 p2 k3, all zero for an ideal lens). Pixels; pixel centres lie at
/// half-integers, so the centre of an uncalibrated picture is exactly (width/2, height/2).
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 5> distortion{};

  /// The uncalibrated camera of a horizontal field of view: f = (W/2) / tan(fov/2), square pixels (the paper's eq.
  /// 1-5).
  static Intrinsics from_fov(int width, int height, double horizontal_fov_rad);
  bool distorted() const { return distortion != std::array<double, 5>{}; }
  friend bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

/// A picture as far as it must be known to stand in for it.
struct PictureLens {
  int width = 0, height = 0;  ///< Pixels; 0 before the first picture.
  Intrinsics intrinsics;

  friend bool operator==(const PictureLens&, const PictureLens&) = default;
};

/// When the light of a picture was gathered. Row v of height H is exposed from start + v/(H-1) * readout to that +
/// length.
struct Exposure {
  Time start;
  Duration length;
  Duration readout;  ///< First row to last row, top first; 0 for a global shutter.

  /// Mid-exposure of the middle row: the time that a pose measured in this picture belongs to.
  Time middle() const { return start + (length + readout) / 2; }
};

/// One camera picture. Planes: rgb8, gray8 and yuyv use plane 0; nv12 has Y in plane 0 and interleaved UV in plane 1.
/// Row stride in bytes per plane. The memory belongs to whoever made the picture (see PictureHandle).
struct Picture {
  int width = 0, height = 0;
  PixelFormat format = PixelFormat::rgb8;
  std::array<const std::uint8_t*, 2> planes{};
  std::array<std::size_t, 2> strides{};
  std::uint64_t sequence = 0;
  Exposure exposure;
  Intrinsics intrinsics;
  /// Head's camera in the world at exposure.middle(). Identity where no head is tracked.
  Pose T_world_camera;
  /// Where the picture came from, for messages and records: a file name, or empty. Lives as long as the picture.
  const char* source = "";
  /// The same picture as JPEG, where the camera sent it so; lives as long as the picture.
  std::span<const std::uint8_t> jpeg{};
  /// What the right eye's camera of a pair saw at about the same time; this is the left one's then. Lives as long as
  /// this picture, and its T_world_camera says where the one camera is from the other.
  const Picture* second = nullptr;
};

/// A borrowed picture. Copies share it (any thread); the last one to go gives the buffer back to its owner through
/// Lender::give_back, on whichever thread that happens, without lock or allocation.
class PictureHandle {
 public:
  class Lender;
  /// One buffer of a lender. The lender keeps it alive as long as any handle may exist.
  struct Loan {
    Picture picture;
    Lender* lender = nullptr;
    Picture* second = nullptr;  ///< What picture.second points to, where the lender has filled a pair.
    std::atomic<int> holders{0};
  };
  class Lender {
   public:
    virtual ~Lender() = default;
    virtual void give_back(Loan& loan) noexcept = 0;
  };

  PictureHandle() = default;
  /// Starts a loan: the loan must have no holders.
  explicit PictureHandle(Loan& loan) noexcept : loan_(&loan) { loan.holders.store(1, std::memory_order_relaxed); }
  PictureHandle(const PictureHandle& o) noexcept : loan_(o.loan_) {
    if (loan_) loan_->holders.fetch_add(1, std::memory_order_relaxed);
  }
  PictureHandle(PictureHandle&& o) noexcept : loan_(std::exchange(o.loan_, nullptr)) {}
  PictureHandle& operator=(PictureHandle o) noexcept {
    std::swap(loan_, o.loan_);
    return *this;
  }
  ~PictureHandle() { reset(); }

  void reset() noexcept {
    Loan* loan = std::exchange(loan_, nullptr);
    if (loan && loan->holders.fetch_sub(1, std::memory_order_acq_rel) == 1) loan->lender->give_back(*loan);
  }
  /// Says where the picture was taken; the second of a pair goes along. For whoever took it from the camera, before
  /// anyone shares it.
  void set_T_world_camera(const Pose& pose) {
    const Pose T_first_world = inverse(loan_->picture.T_world_camera);
    loan_->picture.T_world_camera = pose;
    if (loan_->second) loan_->second->T_world_camera = pose * (T_first_world * loan_->second->T_world_camera);
  }
  /// The same for the second of a pair alone; nothing where there is none.
  void set_T_world_second(const Pose& pose) {
    if (loan_->second) loan_->second->T_world_camera = pose;
  }

  explicit operator bool() const { return loan_ != nullptr; }
  const Picture& operator*() const { return loan_->picture; }
  const Picture* operator->() const { return &loan_->picture; }

 private:
  Loan* loan_ = nullptr;
};

}  // namespace onestroke

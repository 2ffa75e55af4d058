#include "camera/side_by_side_camera.h"

#include "core/error.h"
#include "core/picture_planes.h"

namespace onestroke {
namespace {

// As many as a camera may have lent.
constexpr std::size_t most_pairs = 16;

/// Whether a picture may end after the column: where two pixels share their colour, not between them.
bool divides(PixelFormat format, int column) {
  return (format != PixelFormat::nv12 && format != PixelFormat::yuyv) || column % 2 == 0;
}

}  // namespace

SideBySideCamera::SideBySideCamera(std::unique_ptr<Camera> camera, const std::array<LensSource, 2>& lenses,
                                   const Pose& T_first_second)
    : CameraWrapper(std::move(camera)), lenses_(lenses), T_first_second_(T_first_second), pairs_(most_pairs) {}

Camera::Status SideBySideCamera::next(PictureHandle& picture) {
  if (!message_.empty()) return Status::end;
  PairPool::Pair* const pair = pairs_.acquire();
  if (!pair) return Status::busy;
  PictureHandle& whole = pair->held[0];
  Status status = wrapped().next(whole);
  if (status == Status::ok && !fits(*whole)) status = Status::end;
  if (status != Status::ok) {
    pairs_.give_back(*pair);
    return status;
  }
  Picture &left = pair->picture, &right = pair->right;
  left = *whole;
  left.width /= 2;
  left.jpeg = {};
  right = left;
  for (std::size_t plane = 0; plane < right.planes.size(); ++plane)
    if (right.planes[plane]) right.planes[plane] += plane_shape(left.format, left.width, left.height, plane).row_bytes;
  left.intrinsics = intrinsics_[0];
  right.intrinsics = intrinsics_[1];
  right.T_world_camera = left.T_world_camera * T_first_second_;
  pair->join();
  picture = PictureHandle(*pair);
  return Status::ok;
}

/// Whether it can be divided; where it can, intrinsics_ are its halves'.
bool SideBySideCamera::fits(const Picture& whole) {
  if (whole.width == width_ && whole.height == height_) return true;
  const int half = whole.width / 2;
  if (whole.width % 2 != 0 || !divides(whole.format, half)) {
    message_ = "pictures of " + std::to_string(whole.width) +
               " pixels across cannot be those of two eyes side by side: leave --side-by-side out, or choose another "
               "size";
    return false;
  }
  try {
    for (std::size_t eye = 0; eye < lenses_.size(); ++eye)
      intrinsics_[eye] = lenses_[eye].intrinsics(half, whole.height, "each eye's picture");
  } catch (const Error& error) {
    message_ = error.what();
    return false;
  }
  width_ = whole.width;
  height_ = whole.height;
  return true;
}

}  // namespace onestroke

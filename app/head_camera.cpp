#include "app/head_camera.h"

namespace onestroke {

Camera::Status HeadCamera::next(PictureHandle& picture) {
  const Status status = camera_.next(picture);
  if (status != Status::ok) return status;
  if (const auto T_world_head = head_.head_at(picture->exposure.middle()))
    T_world_camera_ = *T_world_head * T_head_camera_;
  picture.set_T_world_camera(T_world_camera_);
  return status;
}

}  // namespace onestroke

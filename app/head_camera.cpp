#include "app/head_camera.h"

namespace onestroke {

Camera::Status HeadCamera::next(PictureHandle& picture) {
  const Status status = wrapped().next(picture);
  if (status != Status::ok) return status;
  T_world_camera_ = mount_.T_world_camera(picture->exposure.middle()).value_or(T_world_camera_);
  picture.set_T_world_camera(T_world_camera_);
  return status;
}

}  // namespace onestroke

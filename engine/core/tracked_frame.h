#pragma once

#include "core/frame_record.h"
#include "core/picture.h"

namespace onestroke {

/// What travels from the tracking thread to the render loop: a picture and what was found in it, of the same exposure,
/// so that picture and model never slide on each other.
struct TrackedFrame {
  PictureHandle picture;
  FrameRecord record;
};

}  // namespace onestroke

#pragma once

#include "core/error.h"
#include "core/picture.h"
#include "library/onestroke.h"

namespace onestroke {

/// The caller gave something that cannot be used.
class ArgumentError : public Error {
 public:
  using Error::Error;
};

/// Throws ArgumentError where the numbers make no lens.
void check_lens(const CameraLens& lens);

/// The picture as the tracker takes it, over the same memory. Throws ArgumentError where it cannot be read safely.
Picture to_picture(const CameraPicture& picture, const CameraLens& lens);

}  // namespace onestroke

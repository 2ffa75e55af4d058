#pragma once

#include "core/time.h"

namespace onestroke {

/// The way of a picture to the eye, each counted from the middle of its exposure.
struct Latency {
  Duration tracked;  ///< When its markers were known.
  Duration drawn;    ///< When the frame that shows it was handed to the GPU.
  Duration seen;     ///< When the display expects that frame to be seen.
};

}  // namespace onestroke

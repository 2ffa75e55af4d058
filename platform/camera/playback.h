#pragma once

#include "core/time.h"

namespace onestroke {

/// How a recording is played.
struct Playback {
  bool loop = false;  ///< Begins again at its end; times and numbers go on growing.
  Duration from{};    ///< Where it begins, after the recording's first picture.
};

}  // namespace onestroke

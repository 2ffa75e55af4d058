#pragma once

#include "core/time.h"

#include <cstdint>
#include <optional>

namespace onestroke::usb {

/// What goes wrong, and when; pictures are counted from the first one that was sent, over all streams.
struct CameraScript {
  double rate = 30;  ///< Pictures a second, at most.
  bool loop = false;
  std::optional<std::uint64_t> cut_every;     ///< Half of every so manieth picture of a stream is sent.
  std::optional<std::uint64_t> unplug_after;  ///< After so many pictures, once.
  std::optional<Duration> replug_after;       ///< From then; never where it is not set.
  std::optional<std::uint64_t> hang_after;    ///< After so many pictures, once.
  std::optional<Duration> hang_for;           ///< Without end where it is not set.
};

}  // namespace onestroke::usb

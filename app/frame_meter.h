#pragma once

#include "core/frame_record.h"

#include <array>
#include <cstdint>
#include <optional>

namespace onestroke {

/// How the show goes, as its figures tell it.
struct FrameFigures {
  double tracker_ms = 0;  ///< A picture, smoothed.
  double pictures_a_second = 0, frames_a_second = 0;
  /// From the middle of a picture's exposure to when the frame that shows it is seen: the median of the last second.
  std::optional<Duration> age;
  std::uint64_t left_out = 0;  ///< Pictures, since the show began.
};

/// Counts pictures and frames. Figures are told anew every half second, so that they can be read; allocates nothing.
class FrameMeter {
 public:
  /// One frame.
  struct Moment {
    const FrameRecord& record;
    bool new_picture = false;
    std::uint64_t left_out = 0;
    std::optional<Duration> age{};  ///< None where the picture's time is not the clock's.
    Time now;                       ///< The clock on the wall.
  };
  void update(const Moment& moment);
  const FrameFigures& figures() const { return figures_; }

 private:
  struct Age {
    Time at;
    Duration age;
  };

  std::optional<Duration> median_age(Time now) const;

  FrameFigures figures_;
  Time since_;
  int pictures_ = 0, frames_ = 0;
  // The last second of any display; of a faster one a part.
  std::array<Age, 256> ages_{};
  std::size_t ages_count_ = 0;
};

}  // namespace onestroke

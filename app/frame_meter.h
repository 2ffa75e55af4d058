#pragma once

#include "core/frame_record.h"
#include "core/latency.h"

#include <array>
#include <cstdint>
#include <optional>

namespace onestroke {

/// How the show goes, as its figures tell it.
struct FrameFigures {
  double tracker_ms = 0;  ///< A picture, smoothed.
  double pictures_a_second = 0, frames_a_second = 0;
  std::optional<Latency> latency;  ///< The medians of the last second.
  std::uint64_t left_out = 0;      ///< Pictures, since the show began.
};

/// Counts pictures and frames. Figures are told anew every half second, so that they can be read; allocates nothing.
class FrameMeter {
 public:
  /// One frame.
  struct Moment {
    const FrameRecord& record;
    bool new_picture = false;
    std::uint64_t left_out = 0;
    std::optional<Latency> latency{};  ///< Of the frame before; none where the picture's time is not the clock's.
    Time now;                          ///< The clock on the wall.
  };
  void update(const Moment& moment);
  const FrameFigures& figures() const { return figures_; }

 private:
  struct Way {
    Time at;
    Latency latency;
  };

  std::optional<Latency> median_latency(Time now) const;

  FrameFigures figures_;
  Time since_;
  int pictures_ = 0, frames_ = 0;
  // The last second of any display; of a faster one a part.
  std::array<Way, 256> ways_{};
  std::size_t ways_count_ = 0;
};

}  // namespace onestroke

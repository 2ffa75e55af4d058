#pragma once

#include "core/frame_record.h"
#include "scene/text.h"

#include <string_view>

namespace onestroke {

/// The line at the foot of the screen: how long the tracker takes, and how many pictures and frames come a second.
/// Counts over half a second and more; allocates nothing.
class StatusLine {
 public:
  /// rates: false leaves them out, where frames come as fast as they can be drawn.
  explicit StatusLine(bool rates) : rates_(rates) {}

  /// Once a frame. `now` is the clock on the wall.
  std::string_view update(const FrameRecord& record, bool new_picture, std::uint64_t dropped, Time now);

 private:
  const bool rates_;
  Text line_;
  Time since_;
  int pictures_ = 0, frames_ = 0;
  double tracker_ms_ = 0, pictures_a_second_ = 0, frames_a_second_ = 0;
};

}  // namespace onestroke

#pragma once

#include "app/frame_meter.h"
#include "scene/text.h"

#include <string_view>

namespace onestroke {

/// The line at the foot of the screen where DesktopHud has no place: how long the tracker takes, and how many pictures
/// and frames come a second. Allocates nothing.
class StatusLine {
 public:
  /// rates: false leaves them out, where frames come as fast as they can be drawn.
  explicit StatusLine(bool rates) : rates_(rates) {}

  /// Once a frame.
  std::string_view update(const FrameFigures& figures);

 private:
  const bool rates_;
  Text line_;
};

}  // namespace onestroke

#include "core/frame_record.h"

#include <algorithm>

namespace onestroke {

void copy_record(const FrameRecord& from, FrameRecord& to) {
  to.sequence = from.sequence;
  to.time = from.time;
  to.T_world_camera = from.T_world_camera;
  to.cost = from.cost;
  to.tracked = from.tracked;
  to.marker_count = from.marker_count;
  std::ranges::copy(from.seen(), to.markers.begin());
}

}  // namespace onestroke

#pragma once

#include "core/frame_record.h"

#include <cstdio>
#include <initializer_list>

namespace onestroke {

/// A stick before the camera: image position by x, at the depth z, mm.
struct Stick {
  int id = 1;
  Vec3 place{-100, 0, 400};
  Quat rotation{};
  MarkerState state = MarkerState::measured;
};

inline FrameRecord record_of(std::initializer_list<Stick> sticks) {
  FrameRecord r;
  for (const Stick& s : sticks) {
    MarkerObservation& m = r.markers[static_cast<std::size_t>(r.marker_count++)];
    m.id = s.id;
    std::snprintf(m.name.data(), m.name.size(), "stick %d", s.id);
    m.state = s.state;
    m.T_camera_marker = {s.rotation, s.place};
  }
  return r;
}

}  // namespace onestroke

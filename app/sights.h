#pragma once

#include "core/frame_record.h"

#include <cstddef>
#include <string>

namespace onestroke {

/// What a calibration gathers: what a head's camera saw, and where the head was.
class Sights {
 public:
  virtual ~Sights() = default;

  /// A picture's markers, and where the head was in the middle of its exposure.
  virtual void add(const FrameRecord& record, const Pose& T_world_head) = 0;
  /// Pictures with a marker so far, used or not.
  virtual std::size_t seen() const = 0;
  /// 0 to 1.
  virtual double progress() const = 0;
  bool enough() const { return progress() >= 1; }
  /// What the wearer should do next, in a few words.
  virtual std::string advice() const = 0;
};

/// Measured, and known well enough about every axis to tell something.
bool tells_pose(const MarkerObservation& marker);

}  // namespace onestroke

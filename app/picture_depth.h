#pragma once

#include "app/model_shelf.h"
#include "core/frame_record.h"
#include "render/depth_surface.h"

#include <array>
#include <span>

namespace onestroke {

/// How deep the camera's picture lies where sticks are: along their axes. A stick that comes is eased in, one that is
/// lost is eased out where it was last. One thread; allocates nothing after the constructor.
class PictureDepth {
 public:
  static constexpr Duration eases = Duration::from_ms(150);

  /// The shelf outlives this.
  explicit PictureDepth(const ModelShelf& shelf) : shelf_(shelf) {}

  /// `now` does not go back. What is returned lives until the next call; camera frame of the record.
  std::span<const DepthSegment> update(const FrameRecord& record, Time now);

 private:
  static constexpr std::size_t most_corners = 32;

  struct Stick {
    int id = 0;
    double presence = 0;  // 0: the place is free
    bool seen = false;
    Pose T_camera_marker;
  };

  void see(const MarkerObservation& marker);
  void add_segments(const Stick& stick);

  const ModelShelf& shelf_;
  std::array<Stick, max_markers_per_frame> sticks_{};
  std::array<DepthSegment, DepthSurface::most_segments> segments_{};
  std::size_t count_ = 0;
  FrameSteps frames_;
};

}  // namespace onestroke

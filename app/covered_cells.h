#pragma once

#include "app/model_shelf.h"
#include "core/frame_record.h"
#include "render/finger_matte.h"

#include <array>
#include <bitset>
#include <span>

namespace onestroke {

/// The rings of the sticks in a picture that something else covers: what the tracker does not see there of a stick that
/// it has measured, where the stick does not hide itself. One thread; no allocation after the constructor.
class CoveredCells {
 public:
  /// The shelf outlives this.
  explicit CoveredCells(const ModelShelf& shelf) : shelf_(shelf) {}

  /// What is returned lives until the next call.
  std::span<const CoveredCell> find(const FrameRecord& record, const Picture& picture);
  /// In the second picture of a pair, in its camera's frame.
  std::span<const CoveredCell> find_in_second(const FrameRecord& record, const Picture& picture);

 private:
  static constexpr std::size_t most = 64;

  using CellSet = std::bitset<max_cells_per_marker>;

  /// Where a stick is in a picture's camera frame, and what is seen of it there.
  struct Stick {
    int id;
    Pose T_camera_marker;
    CellSet seen;
  };
  void add_covered(const Stick& stick, const Picture& picture);

  const ModelShelf& shelf_;
  std::array<CoveredCell, most> covered_{};
  std::size_t count_ = 0;
};

}  // namespace onestroke

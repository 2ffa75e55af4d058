#pragma once

#include "app/model_shelf.h"
#include "core/frame_record.h"
#include "render/finger_matte.h"

#include <array>
#include <span>

namespace onestroke {

/// The rings of the sticks in a picture that something else covers: what the tracker does not see of a stick that it
/// has measured, where the stick does not hide itself. One thread; no allocation after the constructor.
class CoveredCells {
 public:
  /// The shelf outlives this.
  explicit CoveredCells(const ModelShelf& shelf) : shelf_(shelf) {}

  /// What is returned lives until the next call.
  std::span<const CoveredCell> find(const FrameRecord& record, const Picture& picture);

 private:
  static constexpr std::size_t most = 64;

  void add_covered(const MarkerObservation& marker, const ShelfEntry& entry, const Picture& picture);

  const ModelShelf& shelf_;
  std::array<CoveredCell, most> covered_{};
  std::size_t count_ = 0;
};

}  // namespace onestroke

#pragma once

#include "marker/catalog.h"
#include "tracking/line_proof.h"
#include "tracking/proposals.h"

#include <vector>

namespace onestroke {

/// Finds the markers that stand in plain view, in a small part of the time of a Detector: one pixel in many is looked
/// at, rows of cells on both arms propose poses, lines prove them. Used by one thread at a time.
class QuickSearch {
 public:
  /// Both borrowed.
  QuickSearch(const Catalog& catalog, const std::vector<RodModel>& rods)
      : catalog_(catalog), rods_(rods), windows_(catalog) {}

  /// Markers whose index is flagged in `skip` are not looked for; those among them that are in this picture are
  /// `known`. Appends the markers found.
  void find(const TimedView& view, const std::vector<bool>& skip, const std::vector<Detection>& known,
            std::vector<Detection>& found);
  /// Where in the last picture rows of cells are left that no detection explains, pixels: a thorough search may find
  /// more.
  const std::vector<Vec2d>& unexplained() const { return unexplained_; }

 private:
  void propose(const TimedView& view, const std::vector<bool>& skip);
  bool explained(const Chain& chain, const std::vector<Detection>& detections) const;

  const Catalog& catalog_;
  const std::vector<RodModel>& rods_;
  CodeWindows windows_;
  LineProof lines_;
  int factor_ = 1;
  std::vector<std::uint8_t> labels_;
  CellFinder cell_finder_;
  ChainFinder chain_finder_;
  std::vector<Cell> cells_;
  std::vector<Chain> chains_;
  std::vector<Reading> readings_;
  std::vector<Proposal> proposals_;
  std::vector<Vec2d> unexplained_;
};

}  // namespace onestroke

#pragma once

#include "marker/catalog.h"
#include "tracking/line_proof.h"
#include "tracking/proposals.h"

#include <span>
#include <vector>

namespace onestroke {

/// Finds the markers that stand in plain view, in a small part of the time of a Detector: one pixel in many is looked
/// at, rows of cells on both arms propose poses, lines prove them. Used by one thread at a time.
class QuickSearch {
 public:
  /// Both borrowed.
  QuickSearch(const Catalog& catalog, const std::vector<RodModel>& rods) : rods_(rods), reader_(catalog) {}
  QuickSearch(const QuickSearch&) = delete;
  QuickSearch& operator=(const QuickSearch&) = delete;

  enum class Detail { coarse, fine };

  /// Markers whose index is flagged in `skip` are not looked for; those among them that are in this picture are
  /// `known`. Appends the markers found. `fine` looks at four times as many pixels, for rings that are too short for
  /// the few.
  void find(const TimedView& view, Detail detail, const std::vector<bool>& skip, const std::vector<Detection>& known,
            std::vector<Detection>& found);
  /// Where in the last picture rows of cells are left that no detection explains, pixels: a thorough search may find
  /// more.
  const std::vector<Vec2d>& unexplained() const { return unexplained_; }

 private:
  void look(const TimedView& view, Detail detail, float margin);
  // `before`: how many of those found are not of this picture's search.
  void propose(const TimedView& view, const std::vector<bool>& skip, std::size_t before, std::vector<Detection>& found);
  bool prove(const TimedView& view, const Intrinsics& small, const ReadingPair& pair, Detection& detection);
  void note_explained(std::span<const Detection> detections);
  bool explained(const Chain& chain, const Detection& detection) const;

  const std::vector<RodModel>& rods_;
  QuickReader reader_;
  LineProof lines_;
  int factor_ = 1;
  std::vector<std::uint8_t> labels_;
  CellFinder cell_finder_;
  ChainFinder chain_finder_;
  std::vector<Cell> cells_;
  std::vector<Chain> chains_;
  std::vector<Reading> readings_;
  Proposer proposer_{rods_, cells_, chains_, readings_, {}};
  Proposer::Points points_;
  std::vector<ReadingPair> pairs_;
  std::vector<int> tries_;       // By marker.
  std::vector<bool> explained_;  // By chain.
  std::vector<Vec2d> unexplained_;
};

}  // namespace onestroke

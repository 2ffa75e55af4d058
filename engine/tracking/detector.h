#pragma once

#include "marker/catalog.h"
#include "tracking/detection.h"
#include "tracking/levels.h"
#include "tracking/line_proof.h"
#include "tracking/proposals.h"
#include "tracking/roll_search.h"
#include "tracking/row_joiner.h"
#include "tracking/segmentation.h"
#include "tracking/sharpen.h"

#include <vector>

namespace onestroke {

class WholeLook;

/// How far a search from cold goes where a marker does not come out at once.
struct Search {
  /// Rows standing alone that are completed, and rolls of each that are refined.
  std::size_t max_singles = 24, max_rolls = 14;
  double min_roll_likelihood = 0, min_arm_support = 0.2;
  /// Starts much like one tried before are left out. Of noisy pictures some come right only from one of several such
  /// starts.
  bool once = true;
  /// Rows across which something lies are joined.
  bool join_rows = false;
  /// Poses of a marker that are fitted to its whole look where no ring edges prove any.
  std::size_t max_fits = 0;
  Proposer::Limits limits;

  /// For pictures that stand alone, where no next one gives a second chance.
  static Search thorough() { return {1000, 1000, -1000, 0, false, true, 6, {8, 5}}; }
};

/// Finds markers from cold in a single picture: segment, cells, chains, readings, poses, refinement, proof. Used by one
/// thread at a time.
class Detector {
 public:
  explicit Detector(const Catalog& catalog, const Search& search = {});

  /// Markers whose index is flagged in `skip` (may be empty) are not looked for. One detection a marker at most, best
  /// first.
  void detect(const TimedView& view, const Levels& levels, const std::vector<bool>& skip,
              std::vector<Detection>& detections);
  /// Refines a marker from a pose near the true one and proves it; false where it is not believable there.
  bool prove(const Levels& levels, const Intrinsics& intrinsics, int marker, const EigenPose& start, const Inks& inks,
             Detection& detection) const;

  const std::vector<RodModel>& rods() const { return rods_; }
  const RodModel& rod(int marker) const { return rods_[static_cast<std::size_t>(marker)]; }
  std::size_t marker_count() const { return rods_.size(); }

 private:
  void propose(const ImageView& image, const SegmentationOptions& segmentation, const Intrinsics& intrinsics,
               const std::vector<bool>& skip);
  void find_chains(const ImageView& image);
  void weigh(const Levels& levels, const Intrinsics& intrinsics, const Proposal& proposal,
             std::vector<PoseCandidate>& candidates) const;
  static void relearn(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, Detection& detection);
  void complete_arm(const Levels& levels, const Intrinsics& intrinsics, const Proposal& single,
                    std::vector<PoseCandidate>& candidates, std::vector<Detection>& proven) const;
  std::vector<std::vector<PoseCandidate>> unproven(const Intrinsics& intrinsics, std::vector<PoseCandidate>& candidates,
                                                   const std::vector<Detection>& proven) const;
  void prove_by_look(const WholeLook& look, const Intrinsics& intrinsics, std::vector<PoseCandidate>& candidates,
                     std::vector<Detection>& proven) const;
  void thin_singles();
  void select(const Intrinsics& intrinsics, std::vector<Detection>& proven, std::vector<Detection>& detections) const;

  const Catalog& catalog_;
  Search search_;
  std::vector<RodModel> rods_;
  Sharpener sharpener_;
  CellFinder cell_finder_;
  ChainFinder chain_finder_;
  RowJoiner row_joiner_;
  std::vector<std::uint8_t> labels_;
  std::vector<Cell> cells_;
  std::vector<Chain> chains_;
  std::vector<Reading> readings_;
  std::vector<Proposal> pairs_, singles_;
};

}  // namespace onestroke

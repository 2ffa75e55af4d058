#pragma once

#include "marker/catalog.h"
#include "tracking/appearance.h"
#include "tracking/cells.h"
#include "tracking/chains.h"
#include "tracking/decode.h"
#include "tracking/initial_pose.h"
#include "tracking/refine.h"

#include <vector>

namespace onestroke {

/// One marker found in one picture.
struct Detection {
  int marker = 0;  ///< Index into the catalogue.
  Refinement refinement;
  Appearance appearance;
  Inks inks;
};

/// Whether a refined pose is believed: enough cells of the right inks, few of a wrong one, ring edges where they should
/// be.
bool believable(const RodModel& rod, const Refinement& refinement, const Appearance& appearance);

/// Finds markers from cold in a single picture: segment, cells, chains, readings, poses, refinement, proof. One thread.
class Detector {
 public:
  explicit Detector(const Catalog& catalog);

  /// Markers whose index is flagged in `skip` (may be empty) are not looked for.
  void detect(const ImageView& image, const Intrinsics& intrinsics, const std::vector<bool>& skip,
              std::vector<Detection>& detections);

  const RodModel& rod(int marker) const { return rods_[static_cast<std::size_t>(marker)]; }

 private:
  struct Hypothesis;
  struct Row;
  struct Candidate {
    int marker;
    EigenPose pose;
    Inks inks;
    double evidence;
  };
  void find_rows(const ImageView& image, float blue_gain);
  void propose(const Intrinsics& intrinsics, const std::vector<bool>& skip, std::vector<Hypothesis>& hypotheses) const;
  void propose_one(const Intrinsics& intrinsics, Hypothesis hypothesis, std::vector<Hypothesis>& hypotheses) const;
  void append_points(const Reading& reading, std::vector<CellPoint>& points) const;
  Row row_of(const Reading& reading) const;
  static bool meet(const RodModel& rod, const Row& a, const Row& b);
  void weigh(const ImageView& image, const Intrinsics& intrinsics, const Hypothesis& hypothesis,
             std::vector<Candidate>& candidates) const;
  bool prove(const ImageView& image, const Intrinsics& intrinsics, const Candidate& candidate,
             Detection& detection) const;
  bool overlap(const Intrinsics& intrinsics, const Detection& a, const Detection& b) const;
  void select(const Intrinsics& intrinsics, std::vector<Detection>& proven, std::vector<Detection>& detections) const;
  Inks inks_of(const ImageView& image, const Hypothesis& hypothesis) const;

  const Catalog& catalog_;
  std::vector<RodModel> rods_;
  CellFinder cell_finder_;
  ChainFinder chain_finder_;
  std::vector<std::uint8_t> labels_, smoothed_;
  std::vector<Cell> cells_;
  std::vector<Chain> chains_;
  std::vector<Reading> readings_;
};

}  // namespace onestroke

#pragma once

#include "tracking/cells.h"
#include "tracking/chains.h"
#include "tracking/decode.h"
#include "tracking/initial_pose.h"
#include "tracking/inks.h"

#include <vector>

namespace onestroke {

/// A marker that some of the cells found may be, with poses that would put it there.
struct Proposal {
  int marker = 0;  ///< Index into the rods.
  std::vector<CellPoint> points;
  std::vector<PoseGuess> guesses;  ///< Empty where one arm alone is known.
  int score = 0;
};

/// The inks as the cells of a proposal show them; its pixels count squares of `factor` by `factor` of the picture's.
Inks inks_of(const ImageView& image, const RodModel& rod, const Proposal& proposal, int factor = 1);

/// Turns readings of chains into proposals.
class Proposer {
 public:
  /// Readings that score less are left out: two together, and one alone.
  struct Limits {
    int min_pair_score = 10, min_single_score = 6;
  };
  Proposer(const std::vector<RodModel>& rods, const std::vector<Cell>& cells, const std::vector<Chain>& chains,
           const std::vector<Reading>& readings, const Limits& limits)
      : rods_(rods), cells_(cells), chains_(chains), readings_(readings), limits_(limits) {}

  /// Readings of one marker on two arms that meet where the arms do, and readings that go round a corner. Appends;
  /// markers flagged in skip (may be empty) are left out.
  void pairs(const Intrinsics& k, const std::vector<bool>& skip, std::vector<Proposal>& proposals) const;
  /// Readings that may have to stand alone: the other arm end-on, covered, or merged with the background. Appends.
  void singles(const std::vector<bool>& skip, std::vector<Proposal>& proposals) const;

 private:
  struct Row;
  void append_points(const Reading& reading, std::vector<CellPoint>& points) const;
  Row row_of(const Reading& reading) const;
  static bool meet(const RodModel& rod, const Row& a, const Row& b);
  bool compatible(const Reading& a, const Row& row_a, const Reading& b, const Row& row_b) const;
  void add(const Intrinsics& k, Proposal proposal, std::vector<Proposal>& proposals) const;

  const std::vector<RodModel>& rods_;
  const std::vector<Cell>& cells_;
  const std::vector<Chain>& chains_;
  const std::vector<Reading>& readings_;
  Limits limits_;
};

}  // namespace onestroke

#pragma once

#include "tracking/cells.h"
#include "tracking/chains.h"
#include "tracking/decode.h"
#include "tracking/initial_pose.h"
#include "tracking/inks.h"

#include <span>
#include <vector>

namespace onestroke {

/// A marker that some of the cells found may be, with poses that would put it there.
struct Proposal {
  int marker = 0;  ///< Index into the rods.
  std::vector<CellPoint> points;
  std::vector<PoseGuess> guesses;  ///< Empty where one arm alone is known.
  int score = 0;
};

/// The inks as cells show them; their pixels count squares of `factor` by `factor` of the picture's.
Inks inks_of(const ImageView& image, const RodModel& rod, std::span<const CellPoint> points, int factor = 1);
inline Inks inks_of(const ImageView& image, const RodModel& rod, const Proposal& proposal) {
  return inks_of(image, rod, proposal.points);
}

/// Readings that may be one marker's, by their indices: on two arms that meet where the arms do, or one that goes round
/// a corner, `second` being -1.
struct ReadingPair {
  int marker, first, second, score;
};

/// Turns readings of chains into proposals. Keeps its memory between pictures; used by one thread at a time.
class Proposer {
 public:
  /// Readings that score less are left out: two together, and one alone.
  struct Limits {
    int min_pair_score = 10, min_single_score = 6;
  };
  using Points = InlineVector<CellPoint, 2 * max_cells>;

  /// All borrowed.
  Proposer(const std::vector<RodModel>& rods, const std::vector<Cell>& cells, const std::vector<Chain>& chains,
           const std::vector<Reading>& readings, const Limits& limits)
      : rods_(rods), cells_(cells), chains_(chains), readings_(readings), limits_(limits) {}

  /// Appends the pairs of each marker; those flagged in skip (may be empty) are left out.
  void find(const std::vector<bool>& skip, std::vector<ReadingPair>& pairs) const;
  /// The cells of a pair, each once.
  void points_of(const ReadingPair& pair, Points& points) const;
  /// A pose that puts the cells of a pair where they are seen does so by less than this, pixels (rms).
  static double max_rms(const Intrinsics& k, const RodModel& rod, const EigenPose& pose);

  /// The pairs with their poses. Appends.
  void pairs(const Intrinsics& k, const std::vector<bool>& skip, std::vector<Proposal>& proposals) const;
  /// Readings that may have to stand alone: the other arm end-on, covered, or merged with the background. Appends.
  void singles(const std::vector<bool>& skip, std::vector<Proposal>& proposals) const;

 private:
  // A reading as a line in the picture: pixel = origin + slope * arc length.
  struct Row {
    int low = 0, high = 0;  // Cells.
    int arm = -1;
    double middle = 0;  // Arc length of the points' mean.
    Vec2d origin, slope;
  };
  template <typename Visit>
  void for_points(const Reading& reading, Visit visit) const;
  Row row_of(const Reading& reading) const;
  static bool meet(const RodModel& rod, const Row& a, const Row& b);
  bool compatible(const Reading& a, const Row& row_a, const Reading& b, const Row& row_b) const;

  const std::vector<RodModel>& rods_;
  const std::vector<Cell>& cells_;
  const std::vector<Chain>& chains_;
  const std::vector<Reading>& readings_;
  Limits limits_;
  // The readings that count, marker by marker, and their rows.
  mutable std::vector<int> order_;
  mutable std::vector<Row> rows_;
};

}  // namespace onestroke

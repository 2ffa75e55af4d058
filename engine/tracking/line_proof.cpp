#include "tracking/line_proof.h"

#include <algorithm>
#include <array>
#include <span>

namespace onestroke {
namespace {

// As far as a hand may have brought the marker off its prediction; then to the edges. What is nearer needs no more than
// the later ones, and what is not far off one wider look before the last. Where cells are long the first ones look
// along the middle of the rod only.
constexpr LineOptions far_along{10, 1000, 1, 1000, 2, 4, 2}, along{8, 1000, 1, 1000, 2, 4, 2},
    near_along{5, 1000, 1, 1000, 2, 4, 2}, across{4, 8, 3, 16, 1, 2, 2};
constexpr std::array<LineOptions, 3> long_passes{far_along, near_along, across};
constexpr std::array<LineOptions, 2> loose_passes{along, across};
constexpr LineOptions to_edges{4, 8, 3, 16, 1, 2};
constexpr std::array<LineOptions, 4> short_passes{{{10, 1000, 1, 1000, 2, 2}, to_edges, to_edges, to_edges}};
// Pixels.
constexpr double long_cell = 6;
// A last pass that moves the lines by more than this, pixels, is made again.
constexpr double far_for_last = 0.4;
constexpr int max_more = 2;
constexpr std::array<LineOptions, 2> settling_passes{{{7, 8, 3, 16}, {4, 8, 3, 16}}};
constexpr int max_settlings = 3;
// From as far off as a prediction and the whole look leave a pose, to all that the edges tell.
constexpr std::array<LineOptions, 3> measuring_passes{{{8}, {5}, {4, 1.2, 80, 1.7}}};
constexpr double settled_share = 0.68;

// Whether all cells of the straight arms are long in the picture: none points towards the camera, and none is far.
bool shows_long_cells(const Intrinsics& k, const RodModel& rod, const EigenPose& pose) {
  Vec2d before, here;
  if (!project(k, pose * rod.edge(0).centre, before)) return false;
  for (int c = 0; c < rod.cell_count(); ++c) {
    if (!project(k, pose * rod.edge(c + 1).centre, here)) return false;
    if (rod.arm_of(c) >= 0 && (here - before).squaredNorm() < long_cell * long_cell) return false;
    before = here;
  }
  return true;
}

// The edges of the cells in sight are where they should be: a pose that fits one arm only has cells that agree, but not
// their edges.
bool settled(const Detection& d) {
  const double seen = static_cast<double>(d.appearance.agrees) / std::max(1, d.appearance.in_sight);
  return d.refinement.supported > settled_share * seen * d.refinement.expected;
}

// What a line fit found, as refine() counts it: five lines an edge.
Refinement refinement_of(const LineFit& fit) {
  constexpr int lines = 5;
  Refinement r;
  r.pose = fit.motion.pose;
  r.covariance = fit.pose_covariance();
  r.expected = lines * fit.edges;
  for (std::size_t c = 0; c < r.support.size(); ++c) {
    r.support[c] = lines * fit.support[c];
    r.supported += static_cast<double>(r.support[c]);
  }
  r.rms = fit.rms;
  r.valid = fit.valid;
  return r;
}

// Ring edges supported on the straight arm that has second most.
double second_arm_support(const RodModel& rod, const Refinement& r) {
  double best = 0, second = 0, sum = 0;
  for (int c = 0, arm = -1; c <= rod.cell_count(); ++c) {
    const int next = c < rod.cell_count() ? rod.arm_of(c) : -1;
    if (next != arm) {
      if (sum > best) std::swap(sum, best);
      second = std::max(second, sum);
      sum = 0;
      arm = next;
    }
    if (arm >= 0) sum += static_cast<double>(r.support[static_cast<std::size_t>(c)]);
  }
  return second;
}

}  // namespace

bool believable(const RodModel& rod, const Refinement& r, const Appearance& a) {
  if (!r.valid || a.agrees < min_agreeing || a.evidence() < 8 || 16 * a.contradicts > a.agrees) return false;
  // One arm alone leaves the roll about it to chance. On a wrong arm some cells agree by chance, but no ring edges
  // show.
  const bool both = a.fewest_on_arm >= 3 && second_arm_support(rod, r) >= 7;
  if (rod.has_roll() && !both) return false;
  // Two fingers cover half an arm; where less agrees, the pose is right for one arm only. Edges found loosely
  // prove less.
  if (a.weakest_share < (r.rms < 0.6 ? 0.25 : 0.42)) return false;
  return r.supported > 2.0 * a.agrees && r.supported > 0.36 * r.expected && r.rms < 1.25;
}

bool LineProof::prove(const TimedView& view, int marker, const RodModel& rod, const Motion& expected,
                      const MotionPrior& prior, const Inks& inks, Detection& detection, Nearness nearness) {
  std::span<const LineOptions> passes = short_passes;
  if (shows_long_cells(view.intrinsics, rod, expected.pose)) {
    passes = long_passes;
    if (nearness == Nearness::loosely) passes = loose_passes;
  }
  if (nearness == Nearness::nearly) passes = passes.last(2);
  if (nearness == Nearness::exactly) passes = passes.last(1);
  LineFit fit = fitter_.fit(view, rod, inks, expected, prior, passes);
  for (int again = 0; fit.valid && fit.moved > far_for_last && again < max_more; ++again)
    fit = fitter_.fit(view, rod, inks, fit.motion, prior, passes.last(1));
  Detection d{marker, {}, {}, inks};
  for (int again = 0; fit.valid; ++again) {
    d.refinement = refinement_of(fit);
    d.appearance = assess(view.image, view.intrinsics, rod, inks, fit.motion.pose);
    if (settled(d) || again == max_settlings) break;
    fit = fitter_.fit(view, rod, inks, fit.motion, prior, settling_passes);
  }
  const bool believed = settled(d) && believable(rod, d.refinement, d.appearance);
  if (believed) take_velocity(view, fit, d);
  detection = std::move(d);
  return believed;
}

bool LineProof::measure(const TimedView& view, const RodModel& rod, const Motion& start, const MotionPrior& known,
                        Detection& d) {
  const LineFit fit = fitter_.fit(view, rod, d.inks, start, known, measuring_passes);
  if (!fit.settled()) return false;
  d.refinement.pose = fit.motion.pose;
  d.refinement.covariance = fit.pose_covariance();
  d.refinement.valid = true;
  d.as_expected = true;
  take_velocity(view, fit, d);
  return true;
}

}  // namespace onestroke

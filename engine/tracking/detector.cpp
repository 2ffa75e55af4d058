#include "tracking/detector.h"

#include "tracking/candidate_groups.h"
#include "tracking/likelihood.h"
#include "tracking/whole_look.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

constexpr int max_proofs_per_marker = 8;
constexpr int max_rolls = 4;
// Nats by which a name must lead over another one in the same place.
constexpr double min_name_margin = 6;
// Nats that no closer look makes up for.
constexpr double hopelessly_behind = 18;
// A short or noisy row leaves its tilt to the camera uncertain by about this much, radians.
constexpr std::array<double, 5> tilts{0, -0.12, 0.12, -0.24, 0.24};

// Daylight, lamplight, inks before a background of a pale colour of their own (a sky), and light that a coloured
// background gives its tint.
constexpr std::array<SegmentationOptions, 5> sharp_segmentations{
    {{1.0F}, {1.6F}, {1.0F, 0.4F}, {1.6F, 0.12F, 7.0F, 0.75F}, {1.0F, 0.05F, 3.0F, 0.75F}}};
// Defocus and noise mix the inks; smoothed, the little that they differ by still stands out of the noise.
constexpr std::array<SegmentationOptions, 2> soft_segmentations{{{1.0F, 0.05F, 3.0F}, {1.0F, 0.05F, 3.0F, 0.75F}}};
// Inks before petals and screens of their own colour, for pictures that stand alone.
constexpr std::array<SegmentationOptions, 2> pale_segmentations{
    {{1.0F, 0.35F, 5.0F, 1.0F, 0.12F}, {1.6F, 0.35F, 5.0F, 0.75F, 0.12F}}};
constexpr std::array<SegmentationOptions, 3> softer_segmentations{{{1.0F}, {1.6F}, {1.25F, 0.05F, 3.0F}}};

// Two detections explain the same cells of the picture.
bool overlap(double reach, const Detection& a, const Detection& b) {
  int shared = 0;
  for (const CellCentre& p : a.appearance.cells)
    shared += std::any_of(b.appearance.cells.begin(), b.appearance.cells.end(),
                          [&](const CellCentre& q) { return std::hypot(p.u - q.u, p.v - q.v) < reach; });
  return shared >= 3;
}

// Two sticks cannot stand in one place: how many cells of the one lie within the other.
bool collide(const RodModel& rod_a, const Detection& a, const RodModel& rod_b, const Detection& b) {
  int inside = 0;
  for (const CellCentre& c : a.appearance.cells) {
    const Vec3d p = a.refinement.pose * rod_a.middle(c.index).centre;
    for (int i = 0; i < rod_b.cell_count(); ++i)
      if ((p - b.refinement.pose * rod_b.middle(i).centre).norm() < rod_a.radius() + rod_b.radius()) {
        ++inside;
        break;
      }
  }
  return inside >= 5;
}

// A detection explains much of what the candidate would. Of two that cross, one shares fewer cells with the other.
bool explains(const Intrinsics& k, const RodModel& rod, const PoseCandidate& c, const Detection& d) {
  constexpr int shared_cells = 6;
  const double reach = 0.5 * pitch_in_pixels(k, rod, c.pose);
  int shared = 0;
  for (int i = 0; i < rod.cell_count(); ++i) {
    Vec2d p;
    if (!project(k, c.pose * rod.middle(i).centre, p)) continue;
    shared += std::any_of(d.appearance.cells.begin(), d.appearance.cells.end(),
                          [&](const CellCentre& q) { return std::hypot(p.x() - q.u, p.y() - q.v) < reach; });
  }
  return shared >= shared_cells;
}

// Two starts from which the refinement ends in the same place.
bool alike(const EigenPose& a, const EigenPose& b) {
  return angle_between(a, b) < 0.015 && relative_distance(a, b) < 0.007;
}

bool same_row(const Proposal& a, const Proposal& b) {
  if (a.marker != b.marker) return false;
  int same = 0;
  for (const CellPoint& p : a.points)
    for (const CellPoint& q : b.points) same += p.cell == q.cell && (p.pixel - q.pixel).norm() < 4;
  return same >= 3 && same + 1 >= static_cast<int>(std::max(a.points.size(), b.points.size()));
}

// A row is settled where a detection explains it and shows both arms well; what it names each of the row's cells alike
// is explained the better.
bool settled(const Proposal& single, const std::vector<Detection>& proven) {
  constexpr double near = 6;
  constexpr int well_shown = 8, shown = 5;
  constexpr double well_found = 0.6;  // Of the ring edges in sight.
  const CellPoint& middle = single.points[single.points.size() / 2];
  for (const Detection& d : proven) {
    if (d.appearance.fewest_on_arm < shown) continue;
    const auto at = [&](const CellPoint& p, bool named) {
      return std::any_of(d.appearance.cells.begin(), d.appearance.cells.end(), [&](const CellCentre& c) {
        return (!named || c.index == p.cell) && std::hypot(c.u - p.pixel.x(), c.v - p.pixel.y()) < near;
      });
    };
    if (d.appearance.fewest_on_arm >= well_shown && at(middle, false)) return true;
    if (d.marker != single.marker || d.refinement.supported < well_found * d.refinement.expected) continue;
    const auto named =
        std::count_if(single.points.begin(), single.points.end(), [&](const CellPoint& p) { return at(p, true); });
    if (4 * named >= 3 * static_cast<std::ptrdiff_t>(single.points.size())) return true;
  }
  return false;
}

}  // namespace

Detector::Detector(const Catalog& catalog, const Search& search) : catalog_(catalog), search_(search) {
  for (const MarkerSpec& m : catalog.markers) rods_.emplace_back(m);
}

void Detector::propose(const ImageView& image, const SegmentationOptions& segmentation, const Intrinsics& intrinsics,
                       const std::vector<bool>& skip) {
  segment(image, segmentation, labels_);
  if (segmentation.least_share > 0) peel(image.width, image.height, labels_);
  cell_finder_.find(labels_, image.width, image.height, {}, cells_);
  find_chains(image);
  readings_ = read_chains(catalog_, cells_, chains_);
  const Proposer proposer(rods_, cells_, chains_, readings_, search_.limits);
  proposer.pairs(intrinsics, skip, pairs_);
  proposer.singles(skip, singles_);
}

void Detector::find_chains(const ImageView& image) {
  constexpr std::size_t min_cells = 4, min_joined = 7, min_piece = 3;
  ChainOptions options;
  if (search_.join_rows) options.min_cells = min_piece;
  chain_finder_.find(cells_, image.width, image.height, options, chains_);
  if (search_.join_rows) row_joiner_.join(cells_, min_joined, chains_);
  std::erase_if(chains_, [](const Chain& c) { return c.links.size() < min_cells; });
}

// Cheap look at a guess before the costly refinement.
void Detector::weigh(const Levels& levels, const Intrinsics& intrinsics, const Proposal& p,
                     std::vector<PoseCandidate>& candidates) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(p.marker)];
  const ImageView& image = levels.for_pitch(pitch_in_pixels(intrinsics, rod, p.guesses.front().pose));
  const Inks seen = inks_of(image, rod, p);
  if (seen.separation < min_ink_separation) return;
  for (const PoseGuess& g : p.guesses) {
    PoseCandidate c{p.marker, g.pose, seen, 0, 0};
    complete_inks(image, intrinsics, rod, g.pose, c.inks);
    const Appearance a = assess(image, intrinsics, rod, c.inks, g.pose);
    c.evidence = a.evidence();
    if (a.agrees < 6 || 2 * a.contradicts > a.agrees) continue;
    if (search_.max_fits > 0)
      c.likelihood =
          LikelihoodMeter(image, intrinsics, rod, c.inks, Surroundings(image, intrinsics, rod, g.pose))(g.pose);
    candidates.push_back(c);
  }
}

bool Detector::prove(const Levels& levels, const Intrinsics& intrinsics, int marker, const EigenPose& start,
                     const Inks& inks, Detection& detection) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(marker)];
  const ImageView& image = levels.for_pitch(pitch_in_pixels(intrinsics, rod, start));
  Detection d{marker, refine(image, intrinsics, rod, inks, start), {}, inks};
  if (!d.refinement.valid) return false;
  d.appearance = assess(image, intrinsics, rod, inks, d.refinement.pose);
  if (d.appearance.agrees < min_agreeing) return false;
  relearn(image, intrinsics, rod, d);
  if (&image == &levels.softer) {
    // Smoothing drew it in; where the picture is clean its finer levels are more exact.
    const Refinement finer = refine(levels.soft, intrinsics, rod, d.inks, d.refinement.pose);
    if (finer.valid && finer.rms < d.refinement.rms && finer.supported > 0.9 * d.refinement.supported)
      d.refinement = finer;
  }
  d.appearance = assess(image, intrinsics, rod, d.inks, d.refinement.pose);
  if (!believable(rod, d.refinement, d.appearance)) return false;
  detection = std::move(d);
  return true;
}

// The few cells that made the guess may show the inks badly; all cells at the pose show them better, if the pose is
// right.
void Detector::relearn(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, Detection& d) {
  Detection other = d;
  other.inks = {};
  complete_inks(image, intrinsics, rod, d.refinement.pose, other.inks);
  if (other.inks.separation < min_ink_separation) return;
  other.refinement = refine(image, intrinsics, rod, other.inks, d.refinement.pose);
  if (!other.refinement.valid) return;
  other.appearance = assess(image, intrinsics, rod, other.inks, other.refinement.pose);
  if (other.appearance.evidence() > d.appearance.evidence()) d = std::move(other);
}

// Fits the arm of a single row, then turns the rod about it until the rest of it fits the picture too.
void Detector::complete_arm(const Levels& levels, const Intrinsics& intrinsics, const Proposal& single,
                            std::vector<PoseCandidate>& candidates, std::vector<Detection>& proven) const {
  const RodModel& rod = rods_[static_cast<std::size_t>(single.marker)];
  const int on_arm = single.points.front().cell;
  RefineOptions options;
  options.one_arm = true;
  options.first_cell = options.last_cell = on_arm;
  for (int c = 0; c < rod.cell_count(); ++c)
    if (rod.arm_of(c) == rod.arm_of(on_arm)) {
      options.first_cell = std::min(options.first_cell, c);
      options.last_cell = std::max(options.last_cell, c);
    }
  std::vector<EigenPose> arms;
  for (const PoseGuess& g : poses_from_row(intrinsics, rod, single.points)) {
    const double pitch = pitch_in_pixels(intrinsics, rod, g.pose);
    if (g.rms > 0.35 * pitch + 0.5) continue;
    const ImageView& image = levels.for_pitch(pitch);
    Inks inks = inks_of(image, rod, single);
    if (inks.separation < min_ink_separation) continue;
    complete_inks(image, intrinsics, rod, g.pose, inks);
    const Refinement arm = refine(image, intrinsics, rod, inks, g.pose, options);
    if (!arm.valid || arm.supported < search_.min_arm_support * arm.expected) continue;
    if (search_.once && std::any_of(arms.begin(), arms.end(), [&](const EigenPose& p) { return alike(p, arm.pose); }))
      continue;
    arms.push_back(arm.pose);
    const Surroundings around(image, intrinsics, rod, arm.pose);
    const LikelihoodMeter meter(image, intrinsics, rod, inks, around);
    std::vector<RollCandidate> rolls;
    for (const double tilt : tilts)
      for (const RollCandidate& c : search_roll(meter, tilt_arm(rod, arm.pose, on_arm, tilt), on_arm, max_rolls))
        if (c.likelihood > search_.min_roll_likelihood) rolls.push_back(c);
    likeliest_first(rolls);
    if (rolls.size() > search_.max_rolls) rolls.resize(search_.max_rolls);
    for (const RollCandidate& c : rolls) {
      candidates.push_back({single.marker, c.pose, inks, 0, c.likelihood});
      Detection d;
      if (prove(levels, intrinsics, single.marker, c.pose, inks, d)) proven.push_back(std::move(d));
    }
  }
}

// The candidates of markers that ring edges did not prove, by marker and place; those of which there are most first.
std::vector<std::vector<PoseCandidate>> Detector::unproven(const Intrinsics& intrinsics,
                                                           std::vector<PoseCandidate>& candidates,
                                                           const std::vector<Detection>& proven) const {
  likeliest_first(candidates);
  std::vector<std::vector<PoseCandidate>> all;
  for (std::size_t m = 0; m < rods_.size(); ++m) {
    const int marker = static_cast<int>(m);
    if (std::any_of(proven.begin(), proven.end(), [&](const Detection& d) { return d.marker == marker; })) continue;
    std::vector<PoseCandidate> own;
    for (const PoseCandidate& c : candidates)
      if (c.marker == marker && c.likelihood > 0 && std::none_of(proven.begin(), proven.end(), [&](const Detection& d) {
            return explains(intrinsics, rods_[m], c, d);
          }))
        own.push_back(c);
    for (auto& group : group_by_place(rods_[m], own)) all.push_back(std::move(group));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return all;
}

// The markers that ring edges did not prove.
void Detector::prove_by_look(const WholeLook& look, const Intrinsics& intrinsics,
                             std::vector<PoseCandidate>& candidates, std::vector<Detection>& proven) const {
  std::vector<Detection> likely, doubtful;
  // Another name in the same place is likelier by more than `nats`.
  const auto outdone = [&](const Detection& d, double nats) {
    const auto outdoes = [&](const Detection& other) {
      return other.marker != d.marker && other.likelihood > d.likelihood + nats &&
             collide(rod(d.marker), d, rod(other.marker), other);
    };
    return std::any_of(likely.begin(), likely.end(), outdoes) || std::any_of(doubtful.begin(), doubtful.end(), outdoes);
  };
  const auto hopeless = [&](const Detection& d) { return outdone(d, hopelessly_behind); };
  for (const auto& group : unproven(intrinsics, candidates, proven)) {
    const PoseCandidate& first = group.front();
    if (std::any_of(likely.begin(), likely.end(), [&](const Detection& d) {
          return d.marker == first.marker && explains(intrinsics, rod(first.marker), first, d);
        }))
      continue;
    Detection d;
    const bool proof = look.prove(group, search_.max_fits, hopeless, d);
    if (d.likelihood > 0) (proof ? likely : doubtful).push_back(std::move(d));
  }
  // What another marker explains about as well is not proven, though that one be doubtful too.
  for (const Detection& d : likely)
    if (!outdone(d, -min_name_margin)) proven.push_back(d);
}

// The same row comes out of several segmentations.
void Detector::thin_singles() {
  std::stable_sort(singles_.begin(), singles_.end(),
                   [](const Proposal& a, const Proposal& b) { return a.score > b.score; });
  std::vector<Proposal> kept;
  for (Proposal& s : singles_) {
    const bool known =
        search_.once && std::any_of(kept.begin(), kept.end(), [&](const Proposal& k) { return same_row(s, k); });
    if (!known && kept.size() < search_.max_singles) kept.push_back(std::move(s));
  }
  singles_ = std::move(kept);
}

// Best first; a detection that explains again what a better one explains is dropped, and each marker exists once.
void Detector::select(const Intrinsics& intrinsics, std::vector<Detection>& proven,
                      std::vector<Detection>& detections) const {
  const auto by_look = [](const Detection& d) { return d.likelihood > 0; };
  const auto worth = [&](const Detection& d) {
    return by_look(d) ? d.likelihood : d.refinement.supported + 4 * d.appearance.evidence();
  };
  // Ring edges prove more than the look.
  std::stable_sort(proven.begin(), proven.end(), [&](const Detection& a, const Detection& b) {
    return by_look(a) == by_look(b) ? worth(a) > worth(b) : by_look(b);
  });
  for (Detection& d : proven) {
    const double reach = 0.5 * pitch_in_pixels(intrinsics, rod(d.marker), d.refinement.pose);
    const bool taken = std::any_of(detections.begin(), detections.end(), [&](const Detection& e) {
      return e.marker == d.marker || overlap(reach, d, e) || collide(rod(d.marker), d, rod(e.marker), e);
    });
    if (!taken) detections.push_back(std::move(d));
  }
}

void Detector::detect(const TimedView& view, const Levels& levels, const std::vector<bool>& skip,
                      std::vector<Detection>& detections) {
  const Intrinsics& intrinsics = view.intrinsics;
  detections.clear();
  pairs_.clear();
  singles_.clear();
  for (const SegmentationOptions& s : sharp_segmentations) propose(levels.sharp, s, intrinsics, skip);
  for (const SegmentationOptions& s : soft_segmentations) propose(levels.soft, s, intrinsics, skip);
  for (const SegmentationOptions& s : softer_segmentations) propose(levels.softer, s, intrinsics, skip);
  if (search_.join_rows)
    for (const SegmentationOptions& s : pale_segmentations) propose(levels.soft, s, intrinsics, skip);
  std::vector<PoseCandidate> candidates;
  for (const Proposal& p : pairs_) weigh(levels, intrinsics, p, candidates);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.evidence > b.evidence; });
  std::vector<Detection> proven;
  std::vector<int> tries(rods_.size(), 0);
  std::vector<const PoseCandidate*> tried;
  for (const PoseCandidate& c : candidates) {
    if (search_.once && std::any_of(tried.begin(), tried.end(), [&](const PoseCandidate* t) {
          return t->marker == c.marker && alike(t->pose, c.pose);
        }))
      continue;
    if (++tries[static_cast<std::size_t>(c.marker)] > max_proofs_per_marker) continue;
    tried.push_back(&c);
    Detection d;
    if (prove(levels, intrinsics, c.marker, c.pose, c.inks, d)) proven.push_back(std::move(d));
  }
  thin_singles();
  for (const Proposal& s : singles_)
    if (!settled(s, proven)) complete_arm(levels, intrinsics, s, candidates, proven);
  const WholeLook look(levels, intrinsics, rods_);
  if (search_.max_fits > 0) prove_by_look(look, intrinsics, candidates, proven);
  look.settle_rivals(proven);
  select(intrinsics, proven, detections);
  for (Detection& d : detections) {
    look.polish(d);
    const auto sharpen = [&] { return sharpener_.sharpen(view, rod(d.marker), d); };
    if (!sharpen() && look.settle(d)) sharpen();
  }
}

}  // namespace onestroke

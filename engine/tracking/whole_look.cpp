#include "tracking/whole_look.h"

#include "tracking/look_fits.h"
#include "tracking/roll_search.h"

#include <algorithm>
#include <array>
#include <optional>

namespace onestroke {
namespace {

// Nats. Of candidates that are worth a fit, and of fits that are worth a look beside them.
constexpr double worth_fitting = 18, worth_fitting_more = 30, worth_looking_beside = 65, worth_proof = 35;
// Fits of a marker's likeliest candidates that tell whether more of them are worth it.
constexpr std::size_t enough_to_tell = 3;
// Starts nearer than this to one another (radians, share of the distance) are drawn into the same fit.
constexpr double same_move = 0.04;
// A best fit further from where the look began, as a share of the distance, stands before other surroundings.
constexpr double far_off = 0.1;
// Beside the best fit: rolls about each arm to both sides.
constexpr int max_rounds = 2, rolls_a_side = 6;
constexpr double roll_step = 0.04;
constexpr std::size_t max_climbs = 24, max_beside = 3;
constexpr int rivals_an_arm = 3;
constexpr std::size_t max_around = 6;
// Radians.
constexpr std::array<double, 5> tilts{0, -0.12, 0.12, -0.24, 0.24};
// Cells shorter than this, pixels, edges that scatter by more, and where a smaller share of them is found: measured by
// the whole look.
constexpr double small_pitch = 8, loose = 0.3, few = 0.55;

}  // namespace

LookFits WholeLook::fits_of(int marker, const EigenPose& about) const {
  return {levels_, intrinsics_, rods_[static_cast<std::size_t>(marker)], marker, about};
}

std::vector<PoseCandidate> WholeLook::climb_all(const LookFits& fits, const std::vector<PoseCandidate>& candidates) {
  std::vector<PoseCandidate> climbed;
  for (const PoseCandidate& c : candidates) {
    if (climbed.size() == max_climbs) break;
    const RollCandidate top = climb(fits.meter(c.inks), c.pose);
    climbed.push_back({c.marker, top.pose, c.inks, c.evidence, top.likelihood});
  }
  likeliest_first(climbed);
  return climbed;
}

// The other ways of holding the rod with one arm about where the best fit has it, its tilt being what is known worst.
void WholeLook::look_around(LookFits& fits) const {
  const EigenPose pose = fits.best().pose;
  const Inks inks = fits.best().inks;
  const LikelihoodMeter meter = fits.meter(inks);
  std::vector<RollCandidate> around;
  for (const int cell : arm_middles(fits.rod()))
    for (const double tilt : tilts)
      for (const RollCandidate& c : search_roll(meter, tilt_arm(fits.rod(), pose, cell, tilt), cell, rivals_an_arm))
        around.push_back(climb(meter, c.pose));
  likeliest_first(around);
  std::vector<EigenPose> tried;
  for (const PhotometricFit& f : fits.all()) tried.push_back(f.pose);
  std::size_t count = 0;
  for (const RollCandidate& c : around) {
    if (count == max_around) break;
    if (LookFits::turned_like_one_of(tried, c.pose)) continue;
    tried.push_back(c.pose);
    fits.add(c.pose, inks);
    ++count;
  }
}

// An arm that points at the camera is drawn in from no further than its own thickness: the rolls around are measured,
// and the best of them fitted.
void WholeLook::look_beside(LookFits& fits) const {
  const PhotometricFit best = fits.best();
  const Inks inks = fits.best().inks;
  std::vector<PhotometricFit> beside;
  for (const int cell : arm_middles(fits.rod()))
    for (int i = -rolls_a_side; i <= rolls_a_side; ++i) {
      if (i == 0) continue;
      const PhotometricFit f =
          fits.fit(roll_about(fits.rod(), best.pose, cell, i * roll_step), inks, {false, best.blur});
      if (f.valid) beside.push_back(f);
    }
  likeliest_first(beside);
  if (beside.size() > max_beside) beside.resize(max_beside);
  for (const PhotometricFit& f : beside) {
    fits.add_measured({f, inks});
    fits.add(f.pose, inks);
  }
}

// The other ways of holding the rod that look most like one.
void WholeLook::add_rivals(LookFits& fits, const Detection& d) const {
  const EigenPose& pose = d.refinement.pose;
  fits.add(mirrored(fits.rod(), pose), d.inks);
  const LikelihoodMeter meter = fits.meter(d.inks);
  for (const int cell : arm_middles(fits.rod()))
    for (const RollCandidate& c : search_roll(meter, pose, cell, rivals_an_arm))
      if (angle_between(c.pose, pose) > LookFits::apart) fits.add(c.pose, d.inks);
}

bool WholeLook::prove(const std::vector<PoseCandidate>& candidates, std::size_t max_fits,
                      const std::function<bool(const Detection&)>& hopeless, Detection& detection) const {
  detection.likelihood = 0;
  LookFits fits = fits_of(candidates.front().marker, candidates.front().pose);
  fit_likeliest(fits, candidates, max_fits);
  if (fits.all().empty() || fits.best().likelihood < worth_looking_beside || fits.best().proof < worth_proof)
    return false;
  if (relative_distance(fits.best().pose, candidates.front().pose) > far_off) fits.recentre();
  look_around(fits);
  for (int round = 0; round < max_rounds; ++round) {
    const EigenPose before = fits.best().pose;
    look_beside(fits);
    if (fits.rod().has_roll()) fits.add(mirrored(fits.rod(), fits.best().pose), fits.best().inks);
    if (angle_between(before, fits.best().pose) < 0.01) break;
  }
  fits.drop_contradicted();
  detection = fits.measure();
  const bool before = fits.believed(detection);
  if (is_small(fits.rod(), fits.best().pose)) return before;
  if (before ? !fits.settle() : LookFits::contradicted(detection.appearance) || hopeless(detection) || !fits.contest())
    return before;
  detection = fits.measure();
  return before || fits.believed(detection);
}

// Fits the candidates that the meter finds likeliest, once each.
void WholeLook::fit_likeliest(LookFits& fits, const std::vector<PoseCandidate>& candidates, std::size_t max_fits) {
  const std::vector<PoseCandidate> climbed = climb_all(fits, candidates);
  if (climbed.front().likelihood < worth_fitting) return;
  std::vector<const PoseCandidate*> tried;
  for (const PoseCandidate& c : climbed) {
    if (tried.size() == max_fits) break;
    if (tried.size() == enough_to_tell && (fits.all().empty() || fits.best().likelihood < worth_fitting_more)) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const PoseCandidate* t) {
          return angle_between(t->pose, c.pose) < LookFits::same_turn && relative_distance(t->pose, c.pose) < same_move;
        }))
      continue;
    tried.push_back(&c);
    fits.add(c.pose, c.inks);
  }
}

void WholeLook::settle_rivals(std::vector<Detection>& proven) const {
  struct Kept {
    Detection detection;
    std::optional<PhotometricFit> fit;
  };
  std::vector<Kept> kept;
  for (Detection& d : proven) {
    const auto rival = std::find_if(kept.begin(), kept.end(), [&](const Kept& k) {
      return k.detection.marker == d.marker &&
             angle_between(k.detection.refinement.pose, d.refinement.pose) > LookFits::apart;
    });
    if (rival == kept.end()) {
      kept.push_back({std::move(d), {}});
      continue;
    }
    const EigenPose other = rival->detection.refinement.pose;
    const LookFits fits = fits_of(d.marker, other);
    if (!rival->fit) rival->fit = fits.fit(other, rival->detection.inks);
    const PhotometricFit fit = fits.fit(d.refinement.pose, d.inks);
    if (!likelier(fit, *rival->fit)) continue;
    std::erase_if(kept, [&](const Kept& k) {
      return k.detection.marker == d.marker && angle_between(k.detection.refinement.pose, other) <= LookFits::apart;
    });
    kept.push_back({std::move(d), fit});
  }
  proven.clear();
  for (Kept& k : kept) proven.push_back(std::move(k.detection));
}

void WholeLook::polish(Detection& d) const {
  const Refinement& r = d.refinement;
  const RodModel& rod = rods_[static_cast<std::size_t>(d.marker)];
  const bool small = is_small(rod, r.pose);
  const bool doubtful = r.rms > loose || r.supported < few * r.expected;
  if (d.likelihood > 0 || (!small && !doubtful)) return;
  LookFits fits = fits_of(d.marker, r.pose);
  fits.add(r.pose, d.inks);
  if (doubtful && rod.has_roll()) add_rivals(fits, d);
  if (fits.all().empty()) return;
  const auto is_rival = [&](const LookFit& f) { return angle_between(f.pose, r.pose) > LookFits::apart; };
  if (is_rival(fits.best())) {
    // What ring edges say is overruled by a clear case only.
    const LookFit& rival = fits.best();
    const PhotometricFit as_it_was = fits.fit(r.pose, d.inks, {false, rival.blur});
    if (as_it_was.valid && rival.likelihood > as_it_was.likelihood + LookFits::min_margin &&
        rival.weakest_arm > LookFits::min_arm) {
      d = fits.measure();
      return;
    }
    if (small) return;
    if (!fits.keep_like(r.pose)) return;
  }
  if (!small) return;
  const PhotometricFit as_it_was = fits.fit(r.pose, d.inks, {false, fits.best().blur});
  if (!as_it_was.valid || likelier(as_it_was, fits.best())) return;
  d.refinement.pose = fits.best().pose;
  d.refinement.covariance = fits.best().covariance;
}

bool WholeLook::settle(Detection& d) const {
  Refinement& r = d.refinement;
  if (d.likelihood > 0 || r.rms <= loose || is_small(rods_[static_cast<std::size_t>(d.marker)], r.pose)) return false;
  const auto settled = fits_of(d.marker, r.pose).settled(r.pose, d.inks);
  if (!settled) return false;
  r.pose = settled->pose;
  r.covariance = settled->covariance;
  return true;
}

bool WholeLook::is_small(const RodModel& rod, const EigenPose& pose) const {
  return pitch_in_pixels(intrinsics_, rod, pose) < small_pitch;
}

}  // namespace onestroke

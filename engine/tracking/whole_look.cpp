#include "tracking/whole_look.h"

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
// Nats. Of what is believed: the likelihood, that of each straight arm (one that shows nothing proves no roll), the
// lead over any other way of holding the rod, one with which no roll needs to be looked for any more, and the proof
// against a plain thing.
constexpr double min_likelihood = 55, min_arm = 1, min_margin = 6, clear_margin = 20, min_proof = 60;
// Of the cells that are believed in, one in eight may show a wrong ink.
constexpr int min_agreeing = 12, agreeing_per_contradiction = 8;
// Where more of them do, no other way of holding the rod will mend it.
constexpr int agreeing_per_contradiction_at_all = 5;
// Starts nearer than this to one another (radians, share of the distance) are drawn into the same fit.
constexpr double same_turn = 0.1, same_move = 0.04;
// A best fit further from where the look began, as a share of the distance, stands before other surroundings.
constexpr double far_off = 0.1;
// Poses further apart than this are two ways of holding the rod, radians; nearer ones that are likely alike are one
// pose, badly determined.
constexpr double apart = 0.14, far_apart = 0.2;
// Beside the best fit: rolls about each arm to both sides.
constexpr int max_rounds = 2, rolls_a_side = 6;
constexpr double roll_step = 0.04;
constexpr std::size_t max_climbs = 24, max_beside = 3;
constexpr int rivals_an_arm = 3;
constexpr std::size_t max_around = 6;
// Nats within which ways of holding the rod are contested, where the arm that shows least is no more than half
// covered (a covered one costs four), and how many are.
constexpr double worth_contesting = 12, half_covered = -3.5;
constexpr std::size_t max_contested = 4;
// Nats that are more than chance between two poses near one another.
constexpr double clearly = 2;
// Radians.
constexpr std::array<double, 5> tilts{0, -0.12, 0.12, -0.24, 0.24};
// Cells shorter than this, pixels, edges that scatter by more, and where a smaller share of them is found: measured by
// the whole look.
constexpr double small_pitch = 8, loose = 0.3, few = 0.55;

bool turned_like_one_of(const std::vector<EigenPose>& poses, const EigenPose& pose) {
  return std::any_of(poses.begin(), poses.end(),
                     [&](const EigenPose& p) { return angle_between(p, pose) < same_turn; });
}

bool contradicted(const Appearance& a) {
  return agreeing_per_contradiction_at_all * a.contradicts > a.agrees;
}

}  // namespace

// The fits of one marker, best first, and what they are compared by.
struct WholeLook::Fits {
  struct Fit : PhotometricFit {
    Inks inks;
  };

  Fits(const WholeLook& look, int marker, const EigenPose& about)
      : look(look),
        marker(marker),
        rod(look.rods_[static_cast<std::size_t>(marker)]),
        image(look.level_for(rod, about)),
        around(image, look.intrinsics_, rod, about) {}

  PhotometricFit fit(const EigenPose& pose, const Inks& inks, const PhotometricOptions& options = {}) const {
    return fit_photometric(look.levels_.sharp, look.intrinsics_, rod, inks, around, pose, options);
  }

  LikelihoodMeter meter(const Inks& inks) const { return {image, look.intrinsics_, rod, inks, around}; }

  void add(const EigenPose& start, const Inks& inks) {
    const PhotometricFit f = fit(start, inks);
    if (!f.valid) return;
    all.push_back({f, inks});
    likeliest_first(all);
  }

  // A pose once more, now that the rod is sure to be there. None where nothing near by is clearly likelier.
  std::optional<PhotometricFit> settled(const EigenPose& pose, const Inks& inks) const {
    const PhotometricFit near = fit(pose, inks, {.near = true});
    if (!near.valid || angle_between(near.pose, pose) > apart) return {};
    const PhotometricFit before = fit(pose, inks, {false, near.blur, true});
    if (before.valid && near.likelihood < before.likelihood + clearly) return {};
    return near;
  }

  // Ways of holding the rod that show wrong inks are not what is seen, however likely the rest of them: they only cast
  // doubt on the others. One is left.
  void drop_contradicted() {
    const auto right = [&](const Fit& f) {
      return !contradicted(assess(image, look.intrinsics_, rod, f.inks, f.pose));
    };
    const auto wrong = std::stable_partition(all.begin(), all.end(), right);
    if (wrong == all.begin()) return;
    dropped.assign(wrong, all.end());
    all.erase(wrong, all.end());
    std::erase_if(measured, [&](const Fit& f) { return !right(f); });
  }

  // How much likelier the best is than any other way of holding the rod.
  double lead() const {
    double least = lead_over_rest;
    for (const std::vector<Fit>* ways : {&all, &dropped})
      for (const Fit& f : *ways)
        if (angle_between(f.pose, all.front().pose) > far_apart)
          least = std::min(least, all.front().likelihood - f.likelihood);
    return least;
  }

  // The best fit once more. False where it stays.
  bool settle() {
    const auto near = settled(all.front().pose, all.front().inks);
    if (near) static_cast<PhotometricFit&>(all.front()) = *near;
    return near.has_value();
  }

  // Fits near the ways of holding the rod that are about as likely as the best. False where that one does not show.
  bool contest() {
    std::vector<Fit> ways = all;
    ways.insert(ways.end(), measured.begin(), measured.end());
    likeliest_first(ways);
    const Fit& best = ways.front();
    if (best.likelihood < min_likelihood || best.proof < min_proof || best.weakest_arm < half_covered) return false;
    const double enough = best.likelihood - worth_contesting;
    std::vector<EigenPose> tried;
    std::vector<Fit> contested;
    for (const Fit& f : ways) {
      if (f.likelihood < enough || tried.size() == max_contested) {
        lead_over_rest = best.likelihood - f.likelihood;
        break;
      }
      if (turned_like_one_of(tried, f.pose)) continue;
      tried.push_back(f.pose);
      const PhotometricFit near = fit(f.pose, f.inks, {.near = true});
      if (near.valid) contested.push_back({near, f.inks});
    }
    if (contested.empty()) return false;
    all = std::move(contested);
    likeliest_first(all);
    return true;
  }

  // Likelihoods are compared before the surroundings of one place: those of the best fit, once it has been drawn in
  // from afar.
  void recentre() {
    const EigenPose about = all.front().pose;
    around = Surroundings(image, look.intrinsics_, rod, about);
    for (Fit& f : all) {
      const PhotometricFit again = fit(f.pose, f.inks, {false, f.blur});
      f.likelihood = again.likelihood;
      f.proof = again.proof;
      f.weakest_arm = again.weakest_arm;
    }
    likeliest_first(all);
  }

  const WholeLook& look;
  int marker;
  const RodModel& rod;
  const ImageView& image;
  Surroundings around;
  std::vector<Fit> all;
  std::vector<Fit> dropped;
  std::vector<Fit> measured;    // Taken as they are; their covariance is not known.
  double lead_over_rest = 1e9;  // Of what was not contested.
};

const ImageView& WholeLook::level_for(const RodModel& rod, const EigenPose& pose) const {
  return levels_.for_pitch(pitch_in_pixels(intrinsics_, rod, pose));
}

std::vector<PoseCandidate> WholeLook::climb_all(const Fits& fits, const std::vector<PoseCandidate>& candidates) {
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
void WholeLook::look_around(Fits& fits) const {
  const EigenPose pose = fits.all.front().pose;
  const Inks inks = fits.all.front().inks;
  const LikelihoodMeter meter = fits.meter(inks);
  std::vector<RollCandidate> around;
  for (const int cell : arm_middles(fits.rod))
    for (const double tilt : tilts)
      for (const RollCandidate& c : search_roll(meter, tilt_arm(fits.rod, pose, cell, tilt), cell, rivals_an_arm))
        around.push_back(climb(meter, c.pose));
  likeliest_first(around);
  std::vector<EigenPose> tried;
  for (const PhotometricFit& f : fits.all) tried.push_back(f.pose);
  std::size_t count = 0;
  for (const RollCandidate& c : around) {
    if (count == max_around) break;
    if (turned_like_one_of(tried, c.pose)) continue;
    tried.push_back(c.pose);
    fits.add(c.pose, inks);
    ++count;
  }
}

// An arm that points at the camera is drawn in from no further than its own thickness: the rolls around are measured,
// and the best of them fitted.
void WholeLook::look_beside(Fits& fits) const {
  const PhotometricFit best = fits.all.front();
  const Inks inks = fits.all.front().inks;
  std::vector<PhotometricFit> beside;
  for (const int cell : arm_middles(fits.rod))
    for (int i = -rolls_a_side; i <= rolls_a_side; ++i) {
      if (i == 0) continue;
      const PhotometricFit f = fits.fit(roll_about(fits.rod, best.pose, cell, i * roll_step), inks, {false, best.blur});
      if (f.valid) beside.push_back(f);
    }
  likeliest_first(beside);
  if (beside.size() > max_beside) beside.resize(max_beside);
  for (const PhotometricFit& f : beside) {
    fits.measured.push_back({f, inks});
    fits.add(f.pose, inks);
  }
}

// The other ways of holding the rod that look most like one.
void WholeLook::add_rivals(Fits& fits, const Detection& d) const {
  const EigenPose& pose = d.refinement.pose;
  fits.add(mirrored(fits.rod, pose), d.inks);
  const LikelihoodMeter meter = fits.meter(d.inks);
  for (const int cell : arm_middles(fits.rod))
    for (const RollCandidate& c : search_roll(meter, pose, cell, rivals_an_arm))
      if (angle_between(c.pose, pose) > apart) fits.add(c.pose, d.inks);
}

Detection WholeLook::measure(const Fits& fits) const {
  const Fits::Fit& best = fits.all.front();
  Detection d;
  d.marker = fits.marker;
  d.inks = best.inks;
  d.likelihood = best.likelihood;
  d.refinement = refine(fits.image, intrinsics_, fits.rod, d.inks, best.pose);
  const Refinement& r = d.refinement;
  // Sharp ring edges that agree with the look are the more exact.
  if (!r.valid || r.supported < 0.6 * r.expected || r.rms > 0.5 || angle_between(r.pose, best.pose) > 0.02) {
    d.refinement.pose = best.pose;
    d.refinement.covariance = best.covariance;
    d.refinement.valid = true;
  }
  d.appearance = assess(fits.image, intrinsics_, fits.rod, d.inks, d.refinement.pose);
  return d;
}

bool WholeLook::prove(const std::vector<PoseCandidate>& candidates, std::size_t max_fits,
                      const std::function<bool(const Detection&)>& hopeless, Detection& detection) const {
  detection.likelihood = 0;
  Fits fits(*this, candidates.front().marker, candidates.front().pose);
  fit_likeliest(fits, candidates, max_fits);
  if (fits.all.empty() || fits.all.front().likelihood < worth_looking_beside || fits.all.front().proof < worth_proof)
    return false;
  if (relative_distance(fits.all.front().pose, candidates.front().pose) > far_off) fits.recentre();
  look_around(fits);
  for (int round = 0; round < max_rounds; ++round) {
    const EigenPose before = fits.all.front().pose;
    look_beside(fits);
    if (fits.rod.has_roll()) fits.add(mirrored(fits.rod, fits.all.front().pose), fits.all.front().inks);
    if (angle_between(before, fits.all.front().pose) < 0.01) break;
  }
  fits.drop_contradicted();
  detection = measure(fits);
  const bool before = believed(fits, detection);
  if (is_small(fits.rod, fits.all.front().pose)) return before;
  if (before ? !fits.settle() : contradicted(detection.appearance) || hopeless(detection) || !fits.contest()) return before;
  detection = measure(fits);
  return before || believed(fits, detection);
}

// Fits the candidates that the meter finds likeliest, once each.
void WholeLook::fit_likeliest(Fits& fits, const std::vector<PoseCandidate>& candidates, std::size_t max_fits) {
  const std::vector<PoseCandidate> climbed = climb_all(fits, candidates);
  if (climbed.front().likelihood < worth_fitting) return;
  std::vector<const PoseCandidate*> tried;
  for (const PoseCandidate& c : climbed) {
    if (tried.size() == max_fits) break;
    if (tried.size() == enough_to_tell && (fits.all.empty() || fits.all.front().likelihood < worth_fitting_more)) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const PoseCandidate* t) {
          return angle_between(t->pose, c.pose) < same_turn && relative_distance(t->pose, c.pose) < same_move;
        }))
      continue;
    tried.push_back(&c);
    fits.add(c.pose, c.inks);
  }
}

bool WholeLook::believed(const Fits& fits, const Detection& d) {
  const Fits::Fit& best = fits.all.front();
  if (best.likelihood < min_likelihood || best.proof < min_proof) return false;
  const double lead = fits.lead();
  if (lead < min_margin) return false;
  const Appearance& a = d.appearance;
  if (a.agrees < min_agreeing || agreeing_per_contradiction * a.contradicts > a.agrees) return false;
  if (!fits.rod.has_roll()) return true;
  return best.weakest_arm > min_arm && (lead > clear_margin || roll_margin(fits.meter(d.inks), best.pose) > 0);
}

void WholeLook::settle_rivals(std::vector<Detection>& proven) const {
  struct Kept {
    Detection detection;
    std::optional<PhotometricFit> fit;
  };
  std::vector<Kept> kept;
  for (Detection& d : proven) {
    const auto rival = std::find_if(kept.begin(), kept.end(), [&](const Kept& k) {
      return k.detection.marker == d.marker && angle_between(k.detection.refinement.pose, d.refinement.pose) > apart;
    });
    if (rival == kept.end()) {
      kept.push_back({std::move(d), {}});
      continue;
    }
    const EigenPose other = rival->detection.refinement.pose;
    const Fits fits(*this, d.marker, other);
    if (!rival->fit) rival->fit = fits.fit(other, rival->detection.inks);
    const PhotometricFit fit = fits.fit(d.refinement.pose, d.inks);
    if (!likelier(fit, *rival->fit)) continue;
    std::erase_if(kept, [&](const Kept& k) {
      return k.detection.marker == d.marker && angle_between(k.detection.refinement.pose, other) <= apart;
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
  Fits fits(*this, d.marker, r.pose);
  fits.add(r.pose, d.inks);
  if (doubtful && rod.has_roll()) add_rivals(fits, d);
  if (fits.all.empty()) return;
  const auto is_rival = [&](const Fits::Fit& f) { return angle_between(f.pose, r.pose) > apart; };
  if (is_rival(fits.all.front())) {
    // What ring edges say is overruled by a clear case only.
    const Fits::Fit& rival = fits.all.front();
    const PhotometricFit as_it_was = fits.fit(r.pose, d.inks, {false, rival.blur});
    if (as_it_was.valid && rival.likelihood > as_it_was.likelihood + min_margin && rival.weakest_arm > min_arm) {
      d = measure(fits);
      return;
    }
    if (small) return;
    std::erase_if(fits.all, is_rival);
    if (fits.all.empty()) return;
  }
  if (!small) return;
  const PhotometricFit as_it_was = fits.fit(r.pose, d.inks, {false, fits.all.front().blur});
  if (!as_it_was.valid || likelier(as_it_was, fits.all.front())) return;
  d.refinement.pose = fits.all.front().pose;
  d.refinement.covariance = fits.all.front().covariance;
}

bool WholeLook::settle(Detection& d) const {
  Refinement& r = d.refinement;
  if (d.likelihood > 0 || r.rms <= loose || is_small(rods_[static_cast<std::size_t>(d.marker)], r.pose)) return false;
  const auto settled = Fits(*this, d.marker, r.pose).settled(r.pose, d.inks);
  if (!settled) return false;
  r.pose = settled->pose;
  r.covariance = settled->covariance;
  return true;
}

bool WholeLook::is_small(const RodModel& rod, const EigenPose& pose) const {
  return pitch_in_pixels(intrinsics_, rod, pose) < small_pitch;
}

}  // namespace onestroke

#include "tracking/look_fits.h"

#include "tracking/roll_search.h"

#include <algorithm>

namespace onestroke {
namespace {

// Nats. Of what is believed: the likelihood, and the proof against a plain thing; a lead over any other way of holding
// the rod with which no roll needs to be looked for any more.
constexpr double min_likelihood = 55, min_proof = 60, clear_margin = 20;
// Of the cells that are believed in, one in eight may show a wrong ink.
constexpr int min_agreeing = 12, agreeing_per_contradiction = 8, agreeing_per_contradiction_at_all = 5;
// Ways of holding the rod nearer than this, radians, that are likely alike are one pose, badly determined.
constexpr double far_apart = 0.2;
// Nats within which ways of holding the rod are contested, where the arm that shows least is not wholly covered (that
// costs four), and how many are.
constexpr double worth_contesting = 12, nearly_covered = -3.5;
constexpr std::size_t max_contested = 4;
// Nats that are more than chance between two poses near one another.
constexpr double clearly = 2;

}  // namespace

LookFits::LookFits(const Levels& levels, const Intrinsics& intrinsics, const RodModel& rod, int marker,
                   const EigenPose& about)
    : levels_(levels),
      intrinsics_(intrinsics),
      rod_(rod),
      marker_(marker),
      image_(levels.for_pitch(pitch_in_pixels(intrinsics, rod, about))),
      around_(image_, intrinsics, rod, about) {}

PhotometricFit LookFits::fit(const EigenPose& pose, const Inks& inks, const PhotometricOptions& options) const {
  return fit_photometric(levels_.sharp, intrinsics_, rod_, inks, around_, pose, options);
}

LikelihoodMeter LookFits::meter(const Inks& inks) const {
  return {image_, intrinsics_, rod_, inks, around_};
}

void LookFits::add(const EigenPose& start, const Inks& inks) {
  const PhotometricFit f = fit(start, inks);
  if (!f.valid) return;
  all_.push_back({f, inks});
  likeliest_first(all_);
}

bool LookFits::keep_like(const EigenPose& pose) {
  std::erase_if(all_, [&](const LookFit& f) { return angle_between(f.pose, pose) > apart; });
  return !all_.empty();
}

void LookFits::recentre() {
  around_ = Surroundings(image_, intrinsics_, rod_, best().pose);
  for (LookFit& f : all_) {
    const PhotometricFit again = fit(f.pose, f.inks, {false, f.blur});
    f.likelihood = again.likelihood;
    f.proof = again.proof;
    f.weakest_arm = again.weakest_arm;
  }
  likeliest_first(all_);
}

void LookFits::drop_contradicted() {
  const auto right = [&](const LookFit& f) { return !contradicted(assess(image_, intrinsics_, rod_, f.inks, f.pose)); };
  const auto wrong = std::stable_partition(all_.begin(), all_.end(), right);
  if (wrong == all_.begin()) return;
  others_.insert(others_.end(), wrong, all_.end());
  all_.erase(wrong, all_.end());
  std::erase_if(measured_, [&](const LookFit& f) { return !right(f); });
}

std::optional<PhotometricFit> LookFits::settled(const EigenPose& pose, const Inks& inks) const {
  const PhotometricFit near = fit(pose, inks, {.near = true});
  if (!near.valid || angle_between(near.pose, pose) > apart) return {};
  const PhotometricFit before = fit(pose, inks, {false, near.blur, true});
  if (before.valid && near.likelihood < before.likelihood + clearly) return {};
  return near;
}

bool LookFits::settle() {
  const auto near = settled(best().pose, best().inks);
  if (near) static_cast<PhotometricFit&>(all_.front()) = *near;
  return near.has_value();
}

bool LookFits::contest() {
  std::vector<LookFit> ways = all_;
  ways.insert(ways.end(), measured_.begin(), measured_.end());
  likeliest_first(ways);
  const LookFit& first = ways.front();
  if (first.likelihood < min_likelihood || first.proof < min_proof || first.weakest_arm < nearly_covered) return false;
  std::vector<EigenPose> tried;
  std::vector<LookFit> contested;
  for (const LookFit& f : ways) {
    if (turned_like_one_of(tried, f.pose)) continue;
    if (f.likelihood < first.likelihood - worth_contesting || tried.size() == max_contested) {
      others_.push_back(f);
      break;
    }
    tried.push_back(f.pose);
    const PhotometricFit near = fit(f.pose, f.inks, {.near = true});
    if (near.valid) contested.push_back({near, f.inks});
  }
  if (contested.empty()) return false;
  all_ = std::move(contested);
  likeliest_first(all_);
  return true;
}

Detection LookFits::measure() const {
  Detection d;
  d.marker = marker_;
  d.inks = best().inks;
  d.likelihood = best().likelihood;
  d.refinement = refine(image_, intrinsics_, rod_, d.inks, best().pose);
  const Refinement& r = d.refinement;
  if (!r.valid || r.supported < 0.6 * r.expected || r.rms > 0.5 || angle_between(r.pose, best().pose) > 0.02) {
    d.refinement.pose = best().pose;
    d.refinement.covariance = best().covariance;
    d.refinement.valid = true;
  }
  d.appearance = assess(image_, intrinsics_, rod_, d.inks, d.refinement.pose);
  return d;
}

// How much likelier the best is than any other way of holding the rod.
double LookFits::lead() const {
  double least = 1e9;
  for (const std::vector<LookFit>* ways : {&all_, &others_})
    for (const LookFit& f : *ways)
      if (angle_between(f.pose, best().pose) > far_apart) least = std::min(least, best().likelihood - f.likelihood);
  return least;
}

bool LookFits::believed(const Detection& d) const {
  if (best().likelihood < min_likelihood || best().proof < min_proof) return false;
  const double ahead = lead();
  if (ahead < min_margin) return false;
  const Appearance& a = d.appearance;
  if (a.agrees < min_agreeing || agreeing_per_contradiction * a.contradicts > a.agrees) return false;
  if (!rod_.has_roll()) return true;
  return best().weakest_arm > min_arm && (ahead > clear_margin || roll_margin(meter(d.inks), best().pose) > 0);
}

bool LookFits::contradicted(const Appearance& a) {
  return agreeing_per_contradiction_at_all * a.contradicts > a.agrees;
}

bool LookFits::turned_like_one_of(const std::vector<EigenPose>& poses, const EigenPose& pose) {
  return std::any_of(poses.begin(), poses.end(),
                     [&](const EigenPose& p) { return angle_between(p, pose) < same_turn; });
}

}  // namespace onestroke

#include "tracking/look_proof.h"

#include "tracking/photometric_fit.h"
#include "tracking/roll_search.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

// Nats: of poses from cold, less what a prediction is worth; of the arm that shows least, which more than that makes
// sure of the roll; and how much likelier another roll may be.
constexpr double min_likelihood = 45, min_proof = 45, min_arm = 1, sure_arm = 10, min_margin = 6;
// What is not as likely is not there, however it is looked at.
constexpr double hopeful_likelihood = 25;
constexpr std::array<double, 4> small_tilts{0.01, -0.01, 0.02, -0.02};  // Radians.
// Of the cells of an arm in sight that agree.
constexpr double min_share = 0.25;
// How far a prediction may be off: radians, share of the distance.
constexpr double max_turn = 0.12, max_move = 0.04;
constexpr int min_agreeing = 8, agreeing_per_contradiction = 4;
// An arm is hidden behind the other where no more than this share of all cells should be in sight; of these that share
// must show.
constexpr double one_arm = 0.6, shown = 0.75;

// The arm on which most cells agree, by one of its cells.
int arm_in_sight(const RodModel& rod, const Appearance& a) {
  int best = 0, most = -1;
  for (const int middle : arm_middles(rod)) {
    int count = 0;
    for (const CellCentre& c : a.cells) count += rod.arm_of(c.index) == rod.arm_of(middle);
    if (count > most) most = count, best = middle;
  }
  return best;
}

// The angle about one arm that a rod's thickness at the end of the other is.
double thickness_at_end(const RodModel& rod) {
  return 2 * rod.radius() / rod.bounding_radius();
}

// The fit with the roll about an arm as expected, and as uncertain as a rod's thickness at the end of the other arm
// makes it.
void expect_roll(const RodModel& rod, int cell, const EigenPose& expected, Refinement& r) {
  const Vec3d axis = r.pose.R * rod.middle(cell).tangent;
  const Eigen::AngleAxisd off(r.pose.R * expected.R.transpose());
  r.pose = roll_about(rod, r.pose, cell, -off.angle() * off.axis().dot(axis));
  const double sigma = thickness_at_end(rod);
  // The marker's origin turns about the arm's axis too.
  Eigen::Matrix<double, 6, 1> roll;
  roll << axis, axis.cross(r.pose.t - r.pose * rod.middle(cell).centre);
  r.covariance += sigma * sigma * roll * roll.transpose();
}

bool proven(const PhotometricFit& fit) {
  return fit.valid && fit.likelihood >= min_likelihood && fit.proof >= min_proof;
}

// An arm that points at the camera is a few pixels long, and the fit may stop with its cells one beside the other.
PhotometricFit fit_from(const Levels& levels, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                        const Surroundings& around, const EigenPose& start, LookStarts starts) {
  const auto fit = [&](const EigenPose& from) {
    return fit_photometric(levels.sharp, intrinsics, rod, inks, around, from);
  };
  const PhotometricFit best = fit(start);
  const bool hopeful = best.valid && best.likelihood >= hopeful_likelihood;
  if (starts == LookStarts::expected || !hopeful || proven(best)) return best;
  const Vec3d middle = start * rod.centre();
  for (const double angle : small_tilts)
    for (const Vec3d& axis : {Vec3d(Vec3d::UnitX()), Vec3d(Vec3d::UnitY())}) {
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const PhotometricFit tilted = fit({turn * start.R, middle + turn * (start.t - middle)});
      if (proven(tilted)) return tilted;
    }
  return best;
}

// No other roll about the arm looks better: the other arm does not stand out elsewhere.
bool hidden(const LikelihoodMeter& meter, const EigenPose& pose, int cell) {
  const auto rolls = search_roll(meter, pose, cell, 1);
  return rolls.empty() || angle_between(rolls.front().pose, pose) < max_turn ||
         rolls.front().likelihood < meter(pose) + min_margin;
}

bool shows(const Appearance& a) {
  return a.agrees >= min_agreeing && agreeing_per_contradiction * a.contradicts <= a.agrees;
}

// Enough of either arm to tell its roll, if only just.
bool shows_little(const PhotometricFit& fit, const Appearance& a) {
  return fit.weakest_arm >= min_arm && a.weakest_share >= min_share;
}

bool one_arm_shows(const RodModel& rod, const Appearance& a) {
  return a.in_sight <= one_arm * rod.cell_count() && a.agrees >= shown * a.in_sight;
}

}  // namespace

bool prove_by_look(const Levels& levels, const Intrinsics& intrinsics, int marker, const RodModel& rod,
                   const EigenPose& expected, const Inks& inks, Detection& detection, LookStarts starts) {
  const ImageView& image = levels.sharp;
  const Surroundings around(image, intrinsics, rod, expected);
  const PhotometricFit fit = fit_from(levels, intrinsics, rod, inks, around, expected, starts);
  if (!proven(fit)) return false;
  Detection d{marker, {}, assess(image, intrinsics, rod, inks, fit.pose), inks};
  d.refinement.pose = fit.pose;
  d.refinement.covariance = fit.covariance;
  d.refinement.valid = true;
  d.likelihood = fit.likelihood;
  if (!shows(d.appearance)) return false;
  if (rod.has_roll() && fit.weakest_arm < sure_arm) {
    const bool little = shows_little(fit, d.appearance);
    const int cell = arm_in_sight(rod, d.appearance);
    Detection rolled = d;
    expect_roll(rod, cell, expected, rolled.refinement);
    rolled.appearance = assess(image, intrinsics, rod, inks, rolled.refinement.pose);
    const LikelihoodMeter meter(image, intrinsics, rod, inks, around);
    if (one_arm_shows(rod, rolled.appearance) && hidden(meter, rolled.refinement.pose, cell))
      d = std::move(rolled);
    else if (!little)
      return false;
  }
  if (angle_between(d.refinement.pose, expected) > max_turn ||
      relative_distance(d.refinement.pose, expected) > max_move)
    return false;
  detection = std::move(d);
  return true;
}

bool shows_look(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, double turn_sigma,
                Detection& d) {
  const EigenPose& pose = d.refinement.pose;
  const Surroundings around(image, intrinsics, rod, pose);
  const PhotometricFit look = fit_photometric(image, intrinsics, rod, d.inks, around, pose, {.fit = false});
  if (!proven(look)) return false;
  d.appearance = assess(image, intrinsics, rod, d.inks, pose);
  d.likelihood = look.likelihood;
  if (!shows(d.appearance)) return false;
  if (!rod.has_roll() || look.weakest_arm >= sure_arm || shows_little(look, d.appearance)) return true;
  const LikelihoodMeter meter(image, intrinsics, rod, d.inks, around);
  return turn_sigma < thickness_at_end(rod) && hidden(meter, pose, arm_in_sight(rod, d.appearance));
}

}  // namespace onestroke

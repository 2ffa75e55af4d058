#pragma once

#include "tracking/detection.h"
#include "tracking/levels.h"
#include "tracking/photometric_fit.h"

#include <optional>
#include <vector>

namespace onestroke {

struct LookFit : PhotometricFit {
  Inks inks;
};

/// The fits of one marker's whole look in one place, and what is believed of them. Nats where nothing else is said;
/// angles in radians. Borrows what it is given; used by one thread.
class LookFits {
 public:
  /// Of what is believed: what the arm that shows least has (one that shows nothing proves no roll), and the lead over
  /// any other way of holding the rod.
  static constexpr double min_arm = 1, min_margin = 6;
  /// Starts nearer than this to one another are drawn into the same fit.
  static constexpr double same_turn = 0.1;
  /// Poses further apart than this are two ways of holding the rod.
  static constexpr double apart = 0.14;

  /// `marker`: index into the catalogue; `about`: where likelihoods are compared before the surroundings.
  LookFits(const Levels& levels, const Intrinsics& intrinsics, const RodModel& rod, int marker, const EigenPose& about);

  const RodModel& rod() const { return rod_; }
  /// Best first.
  const std::vector<LookFit>& all() const { return all_; }
  const LookFit& best() const { return all_.front(); }

  PhotometricFit fit(const EigenPose& pose, const Inks& inks, const PhotometricOptions& options = {}) const;
  LikelihoodMeter meter(const Inks& inks) const;

  /// Fits from a start, and keeps the fit if it is valid.
  void add(const EigenPose& start, const Inks& inks);
  /// Keeps one that was taken as it is: its covariance is not known.
  void add_measured(const LookFit& fit) { measured_.push_back(fit); }
  /// Keeps the fits that turn the rod about as `pose` does. False where that leaves none.
  bool keep_like(const EigenPose& pose);
  /// Likelihoods are compared before the surroundings of one place: from now on those of the best fit.
  void recentre();
  /// Ways of holding the rod that show wrong inks are not what is seen, however likely the rest of them: they only cast
  /// doubt on the others. Where all do, all stay.
  void drop_contradicted();

  /// A pose once more, now that the rod is sure to be there. None where nothing near by is clearly likelier.
  std::optional<PhotometricFit> settled(const EigenPose& pose, const Inks& inks) const;
  /// The best fit once more. False where it stays.
  bool settle();
  /// Fits near the ways of holding the rod that are about as likely as the best. False where that one does not show.
  bool contest();

  /// The best fit as a detection; sharp ring edges that agree with it are the more exact.
  Detection measure() const;
  bool believed(const Detection& best) const;
  /// Whether more of the cells show a wrong ink than any other way of holding the rod will mend.
  static bool contradicted(const Appearance& appearance);
  static bool turned_like_one_of(const std::vector<EigenPose>& poses, const EigenPose& pose);

 private:
  double lead() const;

  const Levels& levels_;
  const Intrinsics& intrinsics_;
  const RodModel& rod_;
  int marker_;
  const ImageView& image_;
  Surroundings around_;
  std::vector<LookFit> all_, measured_;
  std::vector<LookFit> others_;  // That are no more than a doubt.
};

}  // namespace onestroke

#include "tracking/tracker.h"

#include "tracking/detector.h"
#include "tracking/follower.h"
#include "tracking/look_proof.h"
#include "tracking/quick_search.h"
#include "tracking/rgb_image.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace onestroke {
namespace {

std::array<double, 36> flatten(const Matrix6d& m) {
  std::array<double, 36> a;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) a[static_cast<std::size_t>(6 * r + c)] = m(r, c);
  return a;
}

// World rates of T_world_marker seen from a camera that stands still at the exposure: the same rates in camera axes.
Velocity in_camera(const Velocity& v, const Pose& T_world_camera) {
  const Quat to_camera = T_world_camera.rotation.conjugate();
  return {rotate(to_camera, v.angular), rotate(to_camera, v.linear)};
}

PoseMeasurement in_world(const Detection& d, const Pose& T_world_camera) {
  const Refinement& r = d.refinement;
  return {T_world_camera * from_eigen(r.pose), turned(r.covariance, T_world_camera.rotation), d.as_expected};
}

// As in_camera(), the other way round.
Velocity velocity_in_world(const Detection& d, const Pose& T_world_camera) {
  const auto turned = [&](const Vec3d& v) { return rotate(T_world_camera.rotation, Vec3{v.x(), v.y(), v.z()}); };
  return {turned(d.angular), turned(d.linear)};
}

// A velocity that would not mislead the next prediction by more than a standing start would.
bool tells_velocity(const Detection& d) {
  constexpr double angular_sigma = 0.7, linear_sigma = 80;
  const auto variance = d.velocity_covariance.diagonal();
  return d.moving && variance.head<3>().maxCoeff() < angular_sigma * angular_sigma &&
         variance.tail<3>().maxCoeff() < linear_sigma * linear_sigma;
}

// By how much the tips and the corner of a rod are apart at two poses, pixels.
double shift_in_picture(const Intrinsics& k, const RodModel& rod, const EigenPose& a, const EigenPose& b) {
  double largest = 0;
  for (const int e : {0, rod.cell_count() / 2, rod.cell_count()}) {
    Vec2d p, q;
    if (!project(k, a * rod.edge(e).centre, p) || !project(k, b * rod.edge(e).centre, q))
      return std::numeric_limits<double>::infinity();
    largest = std::max(largest, (p - q).norm());
  }
  return largest;
}

// A pose that is less certain than this, radians, is measured by all lines.
constexpr double vague_turn = 0.008;

// What the whole look errs by is not noise, which its covariance tells of, but covers, shade and gleams, alike all over
// a cell or an arm: in pictures of which the truth is known, times what the covariance tells.
constexpr double look_errs = 6;

// What is known of a marker before its picture, camera axes.
struct Expectation {
  Motion motion;
  MotionPrior prior;  // Of nothing that would keep few lines from what they show.
  Matrix6d covariance;

  MotionPrior known() const {
    MotionPrior k{.angular = prior.angular, .linear = prior.linear};
    k.add(motion.pose, covariance);
    return k;
  }
};

bool shows_well(const Detection& d) {
  constexpr double share = 0.8;
  return d.appearance.agrees > share * d.appearance.in_sight;
}

}  // namespace

class Tracker::Impl {
 public:
  Impl(Catalog catalog, const TrackerOptions& options)
      : catalog_(std::move(catalog)),
        options_(options),
        detector_(catalog_, options.independent ? Search::thorough() : Search{}),
        quick_(catalog_, detector_.rods()),
        followers_(catalog_.markers.size()),
        surprise_(catalog_.markers.size()) {}

  void process(const Picture& picture, FrameRecord& record) {
    const Time begin = Time::now();
    start(picture, record);
    const TimedView view{rgb_view(picture, rgb_), picture.intrinsics, {picture.exposure, picture.height}};
    levels_made_ = false;
    if (!options_.independent) follow(picture, view);
    search(picture, view);
    report(picture, record);
    record.cost = Time::now() - begin;
  }

  const Catalog& catalog() const { return catalog_; }

 private:
  void start(const Picture& picture, FrameRecord& record) {
    time_ = picture.exposure.middle();
    if (options_.independent || time_ < last_time_) forget();
    last_time_ = time_;
    record.sequence = picture.sequence;
    record.time = time_;
    record.T_world_camera = picture.T_world_camera;
    record.marker_count = 0;
    found_.assign(followers_.size(), false);
    measured_.clear();
  }

  void forget() {
    for (Follower& f : followers_) f.forget();
    fruitless_.clear();
    since_thorough_ = long_ago;
  }

  // A pose that no hand could have brought about is a mistake, however well it fits: what is followed goes on as
  // predicted, and once it counts as lost any pose is as good as another.
  void take(const Picture& picture, const Detection& d, const Detection* sharp = nullptr) {
    const auto m = static_cast<std::size_t>(d.marker);
    const PoseMeasurement measured = in_world(d, picture.T_world_camera);
    if (!followers_[m].plausible(time_, measured.pose)) return;
    found_[m] = true;
    measured_.push_back(d);
    const Velocity seen = velocity_in_world(d, picture.T_world_camera);
    const PoseMeasurement sharper = sharp ? in_world(*sharp, picture.T_world_camera) : PoseMeasurement{};
    followers_[m].measured(time_, measured, d.inks, tells_velocity(d) ? &seen : nullptr, sharp ? &sharper : nullptr);
  }

  // Smoothing takes longer than following, and is seldom needed then.
  const Levels& levels(const TimedView& view) {
    if (!levels_made_) smoothed_ = levels_.make(view.image);
    levels_made_ = true;
    return smoothed_;
  }

  void follow(const Picture& picture, const TimedView& view) {
    ++since_sharpened_;
    const std::size_t to_sharpen = next_to_sharpen();
    for (std::size_t m = 0; m < followers_.size(); ++m) {
      Detection d, sharp;
      if (followers_[m].phase() != Follower::Phase::followed || !find_near(picture, view, m, d)) continue;
      // A few lines tell little of an arm that points at the camera.
      if (d.refinement.covariance.topLeftCorner<3, 3>().trace() > vague_turn * vague_turn)
        sharpener_.sharpen(view, detector_.rod(d.marker), d);
      take(picture, d, m == to_sharpen && sharpen(view, d, sharp) ? &sharp : nullptr);
    }
  }

  // Looks for a marker where it must be: predicted by its velocity, or where it last was if it stopped.
  bool find_near(const Picture& picture, const TimedView& view, std::size_t m, Detection& d) {
    const Follower& f = followers_[m];
    const int marker = static_cast<int>(m);
    const RodModel& rod = detector_.rod(marker);
    const Pose T_camera_world = inverse(picture.T_world_camera);
    const Expectation expected = expectation(picture, f);
    // A hand that stops at once is as likely as one that a bad measurement made seem to move.
    const Motion still{to_eigen(T_camera_world * f.last_seen())};
    const auto off = [&](const EigenPose& pose) {
      return shift_in_picture(picture.intrinsics, rod, pose, expected.motion.pose);
    };
    // What came as predicted, or hardly moves, will be near again.
    const double surprise = std::min(surprise_[m], off(still.pose));
    const Nearness nearness = surprise < max_settled_shift ? Nearness::exactly
                              : surprise < max_slow_shift  ? Nearness::nearly
                              : surprise < max_usual_shift ? Nearness::loosely
                                                           : Nearness::roughly;
    const auto look = [&](Nearness n) {
      return lines_.prove(view, marker, rod, expected.motion, expected.prior, f.inks(), d, n);
    };
    if (look(nearness) || (nearness != Nearness::roughly && look(Nearness::roughly))) {
      surprise_[m] = off(d.refinement.pose);
      return true;
    }
    // An arm that shows its edges may be right by now, and only the other one not.
    const bool led = d.refinement.valid;
    const EigenPose led_to = d.refinement.pose;
    // Where it was it may seem to be in part while it moves on.
    Detection here;
    const bool stayed = lines_.prove(view, marker, rod, still, {}, f.inks(), here);
    const auto by_look = [&](const EigenPose& pose, LookStarts starts) {
      if (!prove_by_look(levels(view), picture.intrinsics, marker, rod, pose, f.inks(), d, starts)) return false;
      measure_look(view, expected, d);
      return true;
    };
    if (!stayed || !shows_well(here)) {
      const EigenPose& pose = expected.motion.pose;
      if (detector_.prove(levels(view), picture.intrinsics, marker, pose, f.inks(), d)) return true;
      if (prove_by_all_lines(view, marker, expected, f.inks(), d)) return true;
      if (by_look(pose, led ? LookStarts::expected : LookStarts::tilted_too)) return true;
      if (led && by_look(led_to, LookStarts::tilted_too)) return true;
    }
    if (!stayed) return by_look(still.pose, LookStarts::expected);
    d = std::move(here);
    return true;
  }

  Expectation expectation(const Picture& picture, const Follower& f) const {
    const Pose T_camera_world = inverse(picture.T_world_camera);
    const Velocity velocity = in_camera(f.velocity(), picture.T_world_camera);
    const PoseMeasurement there = f.expectation(time_);
    return {{to_eigen(T_camera_world * there.pose), to_eigen(velocity.angular), to_eigen(velocity.linear)},
            f.motion_prior(time_),
            turned(there.covariance, T_camera_world.rotation)};
  }

  // Where the edges that show are too few to prove the marker, they still measure it, with what was expected, and
  // better than its whole look, which then only judges.
  bool prove_by_all_lines(const TimedView& view, int marker, const Expectation& expected, const Inks& inks,
                          Detection& detection) {
    const RodModel& rod = detector_.rod(marker);
    Detection d{marker, {}, {}, inks};
    const double turn_sigma = std::sqrt(expected.covariance.topLeftCorner<3, 3>().diagonal().maxCoeff());
    if (!lines_.measure(view, rod, expected.motion, expected.known(), d) ||
        !shows_look(view.image, view.intrinsics, rod, turn_sigma, d))
      return false;
    detection = std::move(d);
    return true;
  }

  // A pose that the whole look proved, by edges too.
  void measure_look(const TimedView& view, const Expectation& expected, Detection& d) {
    Motion start = expected.motion;
    start.pose = d.refinement.pose;
    MotionPrior known = expected.known();
    known.add(d.refinement.pose, look_errs * look_errs * d.refinement.covariance);
    lines_.measure(view, detector_.rod(d.marker), start, known, d);
  }

  // All that a picture tells of a marker is worth its cost where it stands still: every few pictures it is the next
  // one's turn. The number of markers where it is nobody's.
  std::size_t next_to_sharpen() const {
    const std::size_t n = followers_.size();
    if (since_sharpened_ < sharpen_every) return n;
    for (std::size_t i = 1; i <= n; ++i) {
      const Follower& f = followers_[(last_sharpened_ + i) % n];
      if (f.phase() == Follower::Phase::followed && f.standing_for() >= sharpen_when_standing_for)
        return (last_sharpened_ + i) % n;
    }
    return n;
  }

  // False where it told no more than following did.
  bool sharpen(const TimedView& view, const Detection& d, Detection& sharp) {
    last_sharpened_ = static_cast<std::size_t>(d.marker);
    since_sharpened_ = 0;
    sharp = d;
    return sharpener_.sharpen(view, detector_.rod(d.marker), sharp);
  }

  // For all when nothing is known, for a marker in hand that was missed, and now and then for newcomers.
  void search(const Picture& picture, const TimedView& view) {
    if (options_.independent) {
      search_thoroughly(picture, view);
      return;
    }
    ++since_search_;
    ++since_thorough_;
    const bool missing = measured_.empty() || missed();
    if (!missing && since_search_ < options_.search_every) return;
    since_search_ = 0;
    if (!search_quickly(picture, view, QuickSearch::Detail::coarse)) return;
    if (!search_quickly(picture, view, QuickSearch::Detail::fine)) return;
    const bool still_missing = measured_.empty() || missed();
    if (since_thorough_ < (still_missing ? options_.miss_thoroughly_every : options_.search_thoroughly_every)) return;
    search_thoroughly(picture, view);
    since_thorough_ = 0;
    fruitless_ = quick_.unexplained();
  }

  // Whether that leaves something to look for.
  bool search_quickly(const Picture& picture, const TimedView& view, QuickSearch::Detail detail) {
    detections_.clear();
    quick_.find(view, detail, found_, measured_, detections_);
    for (const Detection& d : detections_) take(picture, d);
    return measured_.empty() || missed() || something_new();
  }

  // A row of cells that nothing explains, where none was when the last thorough search was made.
  bool something_new() const {
    constexpr double reach = 30;
    const auto known = [&](const Vec2d& p) {
      return std::any_of(fruitless_.begin(), fruitless_.end(), [&](const Vec2d& q) { return (p - q).norm() < reach; });
    };
    const std::vector<Vec2d>& left = quick_.unexplained();
    return !std::all_of(left.begin(), left.end(), known);
  }

  void search_thoroughly(const Picture& picture, const TimedView& view) {
    detector_.detect(view, levels(view), found_, detections_);
    for (const Detection& d : detections_) take(picture, d);
  }

  // A marker that was seen is not found in this picture.
  bool missed() const {
    return std::any_of(followers_.begin(), followers_.end(), [&](const Follower& f) {
      return f.ever_seen() && !found_[static_cast<std::size_t>(&f - followers_.data())];
    });
  }

  MarkerObservation& add(FrameRecord& record, std::size_t marker) const {
    MarkerObservation& o = record.markers[static_cast<std::size_t>(record.marker_count++)];
    const MarkerSpec& spec = catalog_.markers[marker];
    o.id = spec.id;
    o.name.fill(0);
    std::memcpy(o.name.data(), spec.name.data(), std::min(spec.name.size(), o.name.size() - 1));
    o.velocity = in_camera(followers_[marker].velocity(), record.T_world_camera);
    o.second_cells = 0;
    return o;
  }

  void report(const Picture& picture, FrameRecord& record) {
    const Pose T_camera_world = inverse(picture.T_world_camera);
    for (const Detection& d : measured_) {
      if (record.marker_count == max_markers_per_frame) return;
      MarkerObservation& o = add(record, static_cast<std::size_t>(d.marker));
      o.state = MarkerState::measured;
      const Follower& f = followers_[static_cast<std::size_t>(d.marker)];
      o.T_camera_marker = T_camera_world * f.last_seen();
      o.covariance = flatten(turned(f.covariance(), T_camera_world.rotation));
      o.cells_seen = std::min(static_cast<int>(d.appearance.cells.size()), max_cells_per_marker);
      std::copy_n(d.appearance.cells.begin(), o.cells_seen, o.cells.begin());
    }
    for (std::size_t m = 0; m < followers_.size(); ++m) {
      Follower& f = followers_[m];
      if (found_[m]) continue;
      f.missed(time_, options_);
      if (!f.ever_seen() || record.marker_count == max_markers_per_frame) continue;
      MarkerObservation& o = add(record, m);
      o.state = f.phase() == Follower::Phase::followed ? MarkerState::predicted : MarkerState::lost;
      o.T_camera_marker = T_camera_world * f.predict(time_);
      o.covariance = flatten(turned(f.predicted_covariance(time_), T_camera_world.rotation));
      o.cells_seen = 0;
    }
  }

  Catalog catalog_;
  TrackerOptions options_;
  Detector detector_;
  LineProof lines_;
  Sharpener sharpener_;
  QuickSearch quick_;
  std::vector<Follower> followers_;
  std::vector<double> surprise_;  // By how much each was off its last prediction, pixels.
  std::vector<bool> found_;
  std::vector<Detection> detections_, measured_;
  std::vector<Vec2d> fruitless_;
  std::vector<std::uint8_t> rgb_;
  LevelMaker levels_;
  Levels smoothed_;
  bool levels_made_ = false;
  Time time_, last_time_;
  static constexpr int long_ago = 1 << 20;                                                       // Pictures.
  static constexpr double max_usual_shift = 6.5, max_slow_shift = 2.5, max_settled_shift = 0.5;  // Pixels.
  static constexpr int sharpen_when_standing_for = 4, sharpen_every = 3;
  int since_search_ = 0, since_thorough_ = long_ago, since_sharpened_ = 0;
  std::size_t last_sharpened_ = 0;
};

Tracker::Tracker(Catalog catalog, const TrackerOptions& options)
    : impl_(std::make_unique<Impl>(std::move(catalog), options)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

void Tracker::process(const Picture& picture, FrameRecord& record) {
  impl_->process(picture, record);
}
const Catalog& Tracker::catalog() const {
  return impl_->catalog();
}

}  // namespace onestroke

#include "tracking/tracker.h"

#include "tracking/detector.h"
#include "tracking/follower.h"
#include "tracking/quick_search.h"
#include "tracking/rgb_image.h"

#include <algorithm>
#include <cstring>

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

// The same the other way round.
Velocity in_world(const Detection& d, const Pose& T_world_camera) {
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

}  // namespace

class Tracker::Impl {
 public:
  Impl(Catalog catalog, const TrackerOptions& options)
      : catalog_(std::move(catalog)),
        options_(options),
        detector_(catalog_, options.independent ? Search::thorough() : Search{}),
        quick_(catalog_, detector_.rods()),
        followers_(catalog_.markers.size()) {}

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
  void take(const Picture& picture, const Detection& d) {
    const auto m = static_cast<std::size_t>(d.marker);
    const Pose T_world_marker = picture.T_world_camera * from_eigen(d.refinement.pose);
    if (!followers_[m].plausible(time_, T_world_marker)) return;
    found_[m] = true;
    measured_.push_back(d);
    const Velocity seen = in_world(d, picture.T_world_camera);
    followers_[m].measured(time_, T_world_marker, d.inks, flatten(d.refinement.covariance),
                           tells_velocity(d) ? &seen : nullptr);
  }

  // Smoothing takes longer than following, and is seldom needed then.
  const Levels& levels(const TimedView& view) {
    if (!levels_made_) smoothed_ = levels_.make(view.image);
    levels_made_ = true;
    return smoothed_;
  }

  // Looks for each marker where it must be: predicted by its velocity, or where it last was if it stopped.
  void follow(const Picture& picture, const TimedView& view) {
    const Pose T_camera_world = inverse(picture.T_world_camera);
    for (std::size_t m = 0; m < followers_.size(); ++m) {
      const Follower& f = followers_[m];
      if (f.phase() != Follower::Phase::followed) continue;
      const Velocity velocity = in_camera(f.velocity(), picture.T_world_camera);
      const Motion moving{to_eigen(T_camera_world * f.predict(time_)), to_eigen(velocity.angular),
                          to_eigen(velocity.linear)};
      // A hand that stops at once is as likely as one that a bad measurement made seem to move.
      const Motion still{to_eigen(T_camera_world * f.last_seen())};
      const int marker = static_cast<int>(m);
      const RodModel& rod = detector_.rod(marker);
      Detection d;
      if (lines_.prove(view, marker, rod, moving, f.velocity_prior(time_), f.inks(), d) ||
          lines_.prove(view, marker, rod, still, {}, f.inks(), d) ||
          detector_.prove(levels(view), picture.intrinsics, marker, moving.pose, f.inks(), d))
        take(picture, d);
    }
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
    return o;
  }

  void report(const Picture& picture, FrameRecord& record) {
    for (const Detection& d : measured_) {
      if (record.marker_count == max_markers_per_frame) return;
      MarkerObservation& o = add(record, static_cast<std::size_t>(d.marker));
      o.state = MarkerState::measured;
      o.T_camera_marker = from_eigen(d.refinement.pose);
      o.covariance = flatten(d.refinement.covariance);
      o.cells_seen = std::min(static_cast<int>(d.appearance.cells.size()), max_cells_per_marker);
      std::copy_n(d.appearance.cells.begin(), o.cells_seen, o.cells.begin());
    }
    const Pose T_camera_world = inverse(picture.T_world_camera);
    for (std::size_t m = 0; m < followers_.size(); ++m) {
      Follower& f = followers_[m];
      if (found_[m]) continue;
      f.missed(time_, options_);
      if (!f.ever_seen() || record.marker_count == max_markers_per_frame) continue;
      MarkerObservation& o = add(record, m);
      o.state = f.phase() == Follower::Phase::followed ? MarkerState::predicted : MarkerState::lost;
      o.T_camera_marker = T_camera_world * f.predict(time_);
      o.covariance = f.predicted_covariance(time_);
      o.cells_seen = 0;
    }
  }

  Catalog catalog_;
  TrackerOptions options_;
  Detector detector_;
  LineProof lines_;
  QuickSearch quick_;
  std::vector<Follower> followers_;
  std::vector<bool> found_;
  std::vector<Detection> detections_, measured_;
  std::vector<Vec2d> fruitless_;
  std::vector<std::uint8_t> rgb_;
  LevelMaker levels_;
  Levels smoothed_;
  bool levels_made_ = false;
  Time time_, last_time_;
  static constexpr int long_ago = 1 << 20;  // Pictures.
  int since_search_ = 0, since_thorough_ = long_ago;
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

#include "library/onestroke.h"
#include "library/picture_input.h"
#include "marker/catalog.h"
#include "tracking/tracker.h"

#include <new>
#include <stdexcept>
#include <utility>

namespace onestroke {
namespace {

std::array<double, 3> flat(Vec3 v) {
  return {v.x, v.y, v.z};
}

std::array<double, 9> flat(const Mat3& m) {
  return {m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]};
}

TrackedState to_state(MarkerState state) {
  if (state == MarkerState::measured) return TrackedState::measured;
  return state == MarkerState::predicted ? TrackedState::predicted : TrackedState::lost;
}

TrackedMarker to_tracked(const MarkerObservation& o, const Catalog& catalog) {
  TrackedMarker marker;
  marker.id = o.id;
  marker.name = catalog.find(o.id)->name;
  marker.state = to_state(o.state);
  marker.rotation = flat(to_matrix(o.T_camera_marker.rotation));
  marker.translation_mm = flat(o.T_camera_marker.translation);
  marker.covariance = o.covariance;
  marker.angular_velocity = flat(o.velocity.angular);
  marker.linear_velocity = flat(o.velocity.linear);
  marker.cells_seen = o.cells_seen;
  return marker;
}

// The libraries beneath throw what their own users know; users of this one are promised std::runtime_error.
template <class Work>
auto promised_errors(const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

class [[gnu::visibility("hidden")]] MarkerTracker::Impl {
 public:
  Impl(Catalog catalog, const CameraLens& lens, const MarkerTrackerOptions& options)
      : lens_(lens), tracker_(std::move(catalog), tracker_options(options)) {}

  TrackedPicture process(const CameraPicture& picture) {
    tracker_.process(to_picture(picture, lens_), record_);
    std::size_t count = 0;
    for (const MarkerObservation& o : record_.seen()) markers_[count++] = to_tracked(o, tracker_.catalog());
    return {record_.sequence, record_.time.ns, record_.cost.ns, {markers_.data(), count}};
  }

 private:
  static TrackerOptions tracker_options(const MarkerTrackerOptions& options) {
    TrackerOptions inner;
    inner.independent = options.independent;
    return inner;
  }

  CameraLens lens_;
  Tracker tracker_;
  FrameRecord record_;
  std::array<TrackedMarker, max_markers_per_frame> markers_;
};

MarkerTracker::MarkerTracker(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
MarkerTracker::~MarkerTracker() = default;
MarkerTracker::MarkerTracker(MarkerTracker&&) noexcept = default;
MarkerTracker& MarkerTracker::operator=(MarkerTracker&&) noexcept = default;

MarkerTracker MarkerTracker::from_file(const std::string& catalog_file, const CameraLens& lens,
                                       const MarkerTrackerOptions& options) {
  return promised_errors([&] {
    check_lens(lens);
    return MarkerTracker(std::make_unique<Impl>(load_catalog(catalog_file), lens, options));
  });
}

MarkerTracker MarkerTracker::from_json(const std::string& catalog_text, const CameraLens& lens,
                                       const MarkerTrackerOptions& options) {
  return promised_errors([&] {
    check_lens(lens);
    return MarkerTracker(std::make_unique<Impl>(catalog_from_json(catalog_text, "catalogue"), lens, options));
  });
}

TrackedPicture MarkerTracker::process(const CameraPicture& picture) {
  return promised_errors([&] {
    if (impl_ == nullptr) throw ArgumentError("this tracker was moved from; use the one it was moved to");
    return impl_->process(picture);
  });
}

}  // namespace onestroke

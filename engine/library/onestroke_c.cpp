#include "library/onestroke_c.h"

#include "core/frame_record.h"
#include "library/onestroke.h"
#include "library/picture_input.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <utility>

struct onestroke_tracker {  // NOLINT(readability-identifier-naming): C's name
  onestroke::MarkerTracker tracker;
  onestroke::TrackedPicture last;
};

namespace onestroke {
namespace {

static_assert(sizeof(onestroke_marker::name) == max_name_length + 1);
static_assert(ONESTROKE_MAX_MARKERS == max_markers_per_frame);

// Of a fixed size, so that running out of memory can be told too.
thread_local char last_error[1024] = "";

onestroke_status failed(onestroke_status status, const char* message) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s", message);
  return status;
}

// Nothing that C++ throws may pass.
template <class Work>
onestroke_status guarded(const Work& work) noexcept {
  try {
    work();
    return ONESTROKE_OK;
  } catch (const ArgumentError& error) {
    return failed(ONESTROKE_BAD_ARGUMENT, error.what());
  } catch (const std::exception& error) {
    return failed(ONESTROKE_FAILED, error.what());
  } catch (...) {
    return failed(ONESTROKE_FAILED, "unknown error");
  }
}

void require(const void* argument, const char* name) {
  if (argument == nullptr) throw ArgumentError(std::string(name) + " is NULL");
}

CameraLens to_lens(const onestroke_lens& c) {
  CameraLens lens{c.horizontal_fov_deg, c.fx, c.fy, c.cx, c.cy, {}};
  std::ranges::copy(c.distortion, lens.distortion.begin());
  return lens;
}

CameraPicture to_camera_picture(const onestroke_picture& c) {
  CameraPicture picture;
  picture.data = c.data;
  picture.stride = c.stride;
  picture.uv_data = c.uv_data;
  picture.uv_stride = c.uv_stride;
  picture.width = c.width;
  picture.height = c.height;
  picture.layout = static_cast<PictureLayout>(c.layout);
  picture.exposure_start_ns = c.exposure_start_ns;
  picture.exposure_length_ns = c.exposure_length_ns;
  picture.readout_ns = c.readout_ns;
  picture.sequence = c.sequence;
  return picture;
}

onestroke_marker to_c(const TrackedMarker& marker) {
  onestroke_marker c{};
  c.id = marker.id;
  c.state = static_cast<int>(marker.state);
  c.cells_seen = marker.cells_seen;
  marker.name.copy(c.name, sizeof c.name - 1);
  std::ranges::copy(marker.rotation, c.rotation);
  std::ranges::copy(marker.translation_mm, c.translation_mm);
  std::ranges::copy(marker.covariance, c.covariance);
  std::ranges::copy(marker.angular_velocity, c.angular_velocity);
  std::ranges::copy(marker.linear_velocity, c.linear_velocity);
  return c;
}

using Factory = MarkerTracker (*)(const std::string&, const CameraLens&, const MarkerTrackerOptions&);

onestroke_tracker* create(Factory factory, const char* name, const char* catalog, const onestroke_lens* lens,
                          int independent) noexcept {
  onestroke_tracker* made = nullptr;
  guarded([&] {
    require(catalog, name);
    require(lens, "lens");
    made = std::make_unique<onestroke_tracker>(
               onestroke_tracker{factory(catalog, to_lens(*lens), {.independent = independent != 0}), {}})
               .release();
  });
  return made;
}

}  // namespace
}  // namespace onestroke

onestroke_tracker* onestroke_create_from_file(const char* catalog_file, const onestroke_lens* lens, int independent) {
  return onestroke::create(&onestroke::MarkerTracker::from_file, "catalog_file", catalog_file, lens, independent);
}

onestroke_tracker* onestroke_create_from_json(const char* catalog_text, const onestroke_lens* lens, int independent) {
  return onestroke::create(&onestroke::MarkerTracker::from_json, "catalog_text", catalog_text, lens, independent);
}

void onestroke_destroy(onestroke_tracker* tracker) {
  delete tracker;
}

onestroke_status onestroke_process(onestroke_tracker* tracker, const onestroke_picture* picture) {
  return onestroke::guarded([&] {
    onestroke::require(tracker, "tracker");
    tracker->last = {};
    onestroke::require(picture, "picture");
    tracker->last = tracker->tracker.process(onestroke::to_camera_picture(*picture));
  });
}

size_t onestroke_markers(const onestroke_tracker* tracker, onestroke_marker* markers, size_t capacity) {
  if (tracker == nullptr) return 0;
  const auto found = tracker->last.markers;
  if (markers != nullptr)
    std::ranges::transform(found.first(std::min(capacity, found.size())), markers, onestroke::to_c);
  return found.size();
}

int64_t onestroke_time_ns(const onestroke_tracker* tracker) {
  return tracker == nullptr ? 0 : tracker->last.time_ns;
}

const char* onestroke_last_error(void) {
  return onestroke::last_error;
}

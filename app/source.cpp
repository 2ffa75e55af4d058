#include "app/source.h"

#include "app/head_camera.h"
#include "app/say.h"
#include "camera/open_camera.h"
#include "camera/rig_file.h"
#include "camera/side_by_side_camera.h"
#include "camera/stereo_camera.h"
#include "core/error.h"

#include <numbers>

namespace onestroke {
namespace {

CameraOptions first_camera(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount) {
  CameraOptions camera{.spec = options.camera, .fov_rad = {}, .calibration = options.calibration, .readout = {}};
  if (options.fov_deg) camera.fov_rad = *options.fov_deg * std::numbers::pi / 180;
  if (options.readout_ms) camera.readout = Duration::from_ms(*options.readout_ms);
  camera.catalog = &catalog;
  camera.mount = mount;
  camera.live = options.live;
  camera.live.say = say;
  return camera;
}

/// A recording was not taken by the head that watches it.
bool is_worn(const Camera& camera, const HeadMount& mount) {
  return mount.head && camera.live();
}

using Open = std::unique_ptr<Camera> (*)(const CameraOptions& options);

std::unique_ptr<Camera> open_worn(const CameraOptions& options) {
  std::unique_ptr<Camera> camera = open_camera(options);
  if (!is_worn(*camera, options.mount)) return camera;
  return std::make_unique<HeadCamera>(std::move(camera), options.mount);
}

Rig rig_of(const SourceOptions& options) {
  const Rig rig = options.baseline_mm ? parallel_rig(*options.baseline_mm) : read_rig(options.rig);
  if (rig.lenses && (options.fov_deg || !options.calibration.empty()))
    throw UsageError("--rig " + options.rig.string() + " knows both lenses: leave --fov and --calibration out");
  return rig;
}

std::unique_ptr<Camera> open_two(const SourceOptions& options, CameraOptions first, const Rig& rig, Open open) {
  CameraOptions second = first;
  second.mount.T_head_camera = first.mount.T_head_camera * rig.T_first_second;
  if (rig.lenses) {
    first.lens = (*rig.lenses)[0];
    second.lens = (*rig.lenses)[1];
  }
  first.rig.live_since = second.rig.live_since = Time::now();
  constexpr const char* synthetic = "synthetic";
  if (options.second_camera == synthetic && options.camera.starts_with(synthetic))
    second.rig.T_first_camera = rig.T_first_second;
  else
    second.spec = options.second_camera;
  std::unique_ptr<Camera> left = open(first), right = open(second);
  const bool say_where = open == open_worn && is_worn(*left, first.mount);
  return std::make_unique<StereoCamera>(std::move(left), std::move(right),
                                        say_where ? std::nullopt : std::optional(rig.T_first_second));
}

std::unique_ptr<Camera> open_side_by_side(CameraOptions whole, const Rig& rig, Open open) {
  const LensSource both(whole.calibration, whole.fov_rad);
  if (!rig.lenses && !both.known())
    throw Error("camera " + whole.spec + ": the lenses are not known; give --fov DEG or --calibration FILE.yaml");
  // Nobody looks through it: that of each half takes its place.
  constexpr double any_fov = 1;
  whole.lens = LensSource({}, any_fov);
  return std::make_unique<SideBySideCamera>(open(whole), rig.lenses.value_or(std::array{both, both}),
                                            rig.T_first_second);
}

std::unique_ptr<Camera> open_one_or_two(const SourceOptions& options, const CameraOptions& camera, Open open) {
  if (!options.pair()) return open(camera);
  const Rig rig = rig_of(options);
  return options.side_by_side ? open_side_by_side(camera, rig, open) : open_two(options, camera, rig, open);
}

}  // namespace

std::unique_ptr<Camera> open_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount) {
  return open_one_or_two(options, first_camera(options, catalog, mount), open_camera);
}

std::unique_ptr<Camera> open_worn_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount) {
  return open_one_or_two(options, first_camera(options, catalog, mount), open_worn);
}

}  // namespace onestroke

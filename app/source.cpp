#include "app/source.h"

#include "app/say.h"
#include "camera/open_camera.h"

#include <numbers>

namespace onestroke {

std::unique_ptr<Camera> open_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount) {
  CameraOptions camera{.spec = options.camera, .fov_rad = {}, .calibration = options.calibration, .readout = {}};
  if (options.fov_deg) camera.fov_rad = *options.fov_deg * std::numbers::pi / 180;
  if (options.readout_ms) camera.readout = Duration::from_ms(*options.readout_ms);
  camera.catalog = &catalog;
  camera.mount = mount;
  camera.live = options.live;
  camera.playback = options.playback;
  camera.live.say = say;
  return open_camera(camera);
}

}  // namespace onestroke

#include "camera/open_camera.h"

#include "camera/folder_camera.h"
#include "camera/lens_source.h"
#include "camera/libcamera_source.h"
#include "camera/live_camera.h"
#include "camera/synthetic_camera.h"
#include "camera/video_camera.h"
#include "core/error.h"

#include <numbers>

namespace onestroke {
namespace {

std::unique_ptr<Camera> open_synthetic(const std::string& settings, const CameraOptions& options) {
  SyntheticOptions synthetic = parse_synthetic_options(settings);
  if (!options.catalog) throw Error("camera synthetic shows markers of a catalogue; give --catalog FILE");
  if (!synthetic.readout_ms && options.readout.ns != 0) synthetic.readout_ms = options.readout.ms();
  if (options.fov_rad) synthetic.fov_deg = *options.fov_rad * 180 / std::numbers::pi;
  std::optional<Intrinsics> lens;
  if (options.lens) {
    lens = options.lens->intrinsics(synthetic.width, synthetic.height, "the synthetic camera");
  } else if (!options.calibration.empty()) {
    lens = LensSource(options.calibration, {}).intrinsics(synthetic.width, synthetic.height, "the synthetic camera");
  }
  return make_synthetic_camera(synthetic, *options.catalog, lens, options.mount, options.rig);
}

LensSource lens_of(const CameraOptions& options) {
  if (options.lens) return *options.lens;
  LensSource lens(options.calibration, options.fov_rad);
  if (!lens.known()) {
    throw Error("camera " + options.spec +
                ": the field of view is not known; give --fov DEG or --calibration FILE.yaml");
  }
  return lens;
}

}  // namespace

std::unique_ptr<Camera> open_camera(const CameraOptions& options) {
  const std::size_t colon = options.spec.find(':');
  const std::string kind = options.spec.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : options.spec.substr(colon + 1);
  if (options.fov_rad && !(*options.fov_rad > 0 && *options.fov_rad < std::numbers::pi)) {
    throw UsageError("a field of view lies between 0 and 180 degrees; give --fov DEG");
  }
  if (kind == "synthetic") return open_synthetic(rest, options);
  if (kind == "libcamera")
    return make_live_camera(make_libcamera_source(rest, options.live), lens_of(options), options.readout, options.live);
  if (kind == "folder" && !rest.empty()) return open_folder(rest, lens_of(options), options.readout);
  if (kind == "file" && !rest.empty()) return open_video(rest, lens_of(options), options.readout);
  throw UsageError("no camera is called \"" + options.spec +
                   "\"; give synthetic[:key=value,...], libcamera[:NAME], folder:DIR or file:VIDEO");
}

}  // namespace onestroke

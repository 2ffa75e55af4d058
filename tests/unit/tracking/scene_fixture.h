#pragma once

#include "camera/synthetic_renderer.h"
#include "marker_fixture.h"
#include "tracking/image_view.h"
#include "tracking/rod_model.h"
#include "tracking/tracker.h"

#include <vector>

namespace onestroke::test {

/// A rendered picture with its camera, as the tracker takes it.
struct Shot {
  Intrinsics intrinsics;
  SyntheticImage image;

  ImageView view() const { return {image.rgb.data(), image.width, image.height, stride()}; }
  std::size_t stride() const { return 3 * static_cast<std::size_t>(image.width); }

  Picture picture(std::int64_t ms = 0, const Pose& T_world_camera = {}) const {
    Picture p;
    p.width = image.width;
    p.height = image.height;
    p.planes[0] = image.rgb.data();
    p.strides[0] = stride();
    p.sequence = static_cast<std::uint64_t>(ms);
    p.exposure.start = {ms * 1'000'000};
    p.intrinsics = intrinsics;
    p.T_world_camera = T_world_camera;
    return p;
  }
};

struct Placed {
  const MarkerSpec* marker;
  Pose T_camera_marker;
};

/// What a scene adds to an even grey background.
struct Look {
  double noise = 1.5;
  double blur = 0.6;
  double light_kelvin = 6500;
  std::uint64_t seed = 1;
};

/// 640 x 480 at 35 degrees; the paper's camera at less than half its resolution.
inline Shot shoot(const std::vector<Placed>& placed, const Look& look = {}) {
  std::vector<Rod> rods;
  for (const Placed& p : placed) rods.emplace_back(*p.marker);
  SyntheticFrame frame;
  frame.width = 640;
  frame.height = 480;
  frame.intrinsics = Intrinsics::from_fov(frame.width, frame.height, 35 * radian);
  for (std::size_t i = 0; i < placed.size(); ++i) frame.markers.push_back({&rods[i], placed[i].T_camera_marker});
  frame.effects.noise = look.noise;
  frame.effects.blur = look.blur;
  frame.effects.light_kelvin = look.light_kelvin;
  frame.noise_seed = look.seed;
  return {frame.intrinsics, render_synthetic(frame)};
}

/// A picture of one marker alone.
inline Shot shoot(const MarkerSpec& marker, const Pose& pose, const Look& look = {}) {
  return shoot({{&marker, pose}}, look);
}

inline FrameRecord process(Tracker& tracker, const Picture& picture) {
  FrameRecord record;
  tracker.process(picture, record);
  return record;
}

}  // namespace onestroke::test

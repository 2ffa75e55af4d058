#pragma once

#include "camera/synthetic_renderer.h"
#include "marker/catalog.h"

#include <numbers>

namespace onestroke::test {

/// One of two catalogued markers before an even background, drawn, with its truth.
struct HeldMarker {
  static constexpr double fov_deg = 35;
  static constexpr int width = 640, height = 480;

  Catalog catalog{{marker(7, "seven", 0x2a5f13c9d), marker(8, "eight", 0x15c3e07ab)}};
  const MarkerSpec& held = catalog.markers[0];
  Pose T_camera_marker{exp_so3({0.5, -0.3, 0.4}), Vec3{5, 5, 330} - rotate(exp_so3({0.5, -0.3, 0.4}), {24, -24, 0})};
  SyntheticImage image = draw();

 private:
  static MarkerSpec marker(int id, const char* name, std::uint64_t code) {
    return {id, name, encode(code, 36), Shape::angle(36, 4, 3, 0), ""};
  }

  SyntheticImage draw() const {
    const Rod rod(held);
    SyntheticFrame frame;
    frame.width = width;
    frame.height = height;
    frame.intrinsics = Intrinsics::from_fov(width, height, fov_deg * std::numbers::pi / 180);
    frame.markers.push_back({&rod, T_camera_marker});
    frame.effects.noise = 1.5;
    frame.effects.blur = 0.6;
    return render_synthetic(frame);
  }
};

}  // namespace onestroke::test

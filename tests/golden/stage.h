#pragma once

#include "core/picture.h"
#include "display/offscreen.h"
#include "golden/comparator.h"
#include "render/renderer.h"

#include <gtest/gtest.h>

namespace onestroke::golden {

/// A camera picture made by formula, with the memory behind it: gradients, checks and fine lines.
struct Chart {
  std::vector<std::uint8_t> bytes;
  onestroke::Picture picture;

  Chart(int width, int height, PixelFormat format, double horizontal_fov_rad);
  Chart(const Chart&) = delete;
};

/// Draws single frames off-screen under validation.
class Stage : public testing::Test {
 protected:
  static constexpr int width = 480, height = 360;
  static constexpr double fov = 0.9;  // radians, horizontal

  Stage() : Stage(1) {}
  explicit Stage(int views);
  /// Validation must have had nothing to say, to the end of the GPU's last object.
  void TearDown() override;

  /// Draws three frames, once round everything that is taken in turn, and reads the last back. Views not given
  /// stand at the world's origin with the charts' field of view.
  Picture draw(const FrameScene& scene, std::span<const View> views = {});

  /// Compares with pictures/NAME.png. See Album; ONESTROKE_BLESS is what it blesses.
  void expect_golden(const std::string& name, const Picture& actual, Tolerance tolerance);

  int views_;
  std::atomic<int> validation_messages_{0};
  std::unique_ptr<OffscreenDisplay> display_;
  std::optional<Gpu> gpu;
  std::unique_ptr<Renderer> renderer;
  std::string drawn_by_;
};

class StereoStage : public Stage {
 protected:
  StereoStage() : Stage(2) {}
};

/// From an orientation and a position in graphics axes and metres, at one scale.
Matrix4 placed(float x, float y, float z, float turn_x_rad, float turn_y_rad, float scale = 1);

}  // namespace onestroke::golden

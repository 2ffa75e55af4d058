// What the camera does to the light: rolling shutter, motion blur, noise, gain, colour of the light, defocus.

#include "scene_fixture.h"

#include <vector>

namespace onestroke::test {
namespace {

/// An upright stick in the middle of the picture, long enough to cross it from top to bottom.
struct Upright {
  MarkerSpec spec{1, "line", encode(5, 36), Shape::line(36, 4, 3), ""};
  Rod rod{spec};
  Pose pose{exp_so3({0, 0, std::numbers::pi / 2}), {0, 0, 400}};
};

/// The column, in pixels, of what differs from the background in a row.
double column_of(const SyntheticImage& image, const SyntheticImage& empty, int y) {
  double weight = 0, sum = 0;
  for (int x = 0; x < image.width; ++x) {
    const auto a = pixel(image, x, y), b = pixel(empty, x, y);
    double w = 0;
    for (std::size_t c = 0; c < 3; ++c) w += std::abs(to_linear(a[c]) - to_linear(b[c]));
    weight += w;
    sum += w * (x + 0.5);
  }
  return weight > 0 ? sum / weight : -1;
}

std::array<double, 3> mean_light(const SyntheticImage& image) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) sum[i % 3] += to_linear(image.rgb[i]);
  for (double& s : sum) s /= static_cast<double>(image.width) * image.height;
  return sum;
}

TEST(Effects, RollingShutterLeansAMovingStickAndTheMiddleRowKeepsTheTruth) {
  const Upright stick;
  SyntheticFrame frame = plain_frame();
  frame.effects.readout = Duration::from_ms(20);
  const SyntheticImage empty = render_synthetic(frame);
  constexpr double way = 40;  // mm to the right during the readout
  frame.markers.push_back({&stick.rod, sliding(stick.pose, {way, 0, 0})});
  const SyntheticImage image = render_synthetic(frame);
  const double per_mm = frame.intrinsics.fx / 400;
  const int top = 120, middle = 240, bottom = 360;
  // Rows are exposed from the top: a stick that goes right stands further right in the rows below.
  const double lean = column_of(image, empty, bottom) - column_of(image, empty, top);
  EXPECT_NEAR(lean, way * per_mm * (bottom - top) / 479.0, 1.0);
  EXPECT_NEAR(column_of(image, empty, middle), frame.intrinsics.cx, 0.6);

  frame.effects.readout = {};
  frame.effects.exposure = {};
  const SyntheticImage still = render_synthetic(frame);
  EXPECT_NEAR(column_of(still, empty, top), column_of(still, empty, bottom), 0.3) << "a global shutter does not lean";
}

TEST(Effects, MotionBlurSpreadsTheLightAndKeepsItsSum) {
  const Upright stick;
  SyntheticFrame frame = plain_frame();
  frame.background = {0.02f, 0.02f, 0.02f};
  const std::array<double, 3> empty = mean_light(render_synthetic(frame));
  frame.markers.push_back({&stick.rod, stick.pose});
  const SyntheticImage sharp = render_synthetic(frame);
  frame.effects.exposure = Duration::from_ms(10);
  frame.markers[0].T_camera_marker = sliding(stick.pose, {12, 0, 0});
  const SyntheticImage blurred = render_synthetic(frame);
  const auto a = mean_light(sharp), b = mean_light(blurred);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR((b[c] - empty[c]) / (a[c] - empty[c]), 1.0, 0.02) << "channel " << c;
  const int y = 240;
  int touched_sharp = 0, touched_blurred = 0;
  for (int x = 0; x < frame.width; ++x) {
    touched_sharp += pixel(sharp, x, y) != pixel(sharp, 0, y);
    touched_blurred += pixel(blurred, x, y) != pixel(blurred, 0, y);
  }
  EXPECT_NEAR(touched_blurred - touched_sharp, 12 * frame.intrinsics.fx / 400, 3);
}

TEST(Effects, NoiseHasTheLevelThatWasAsked) {
  for (const double wanted : {1.0, 4.0, 8.0}) {
    SyntheticFrame frame = plain_frame();
    frame.background = {0.2158605f, 0.2158605f, 0.2158605f};  // level 128
    frame.effects.noise = wanted;
    const SyntheticImage image = render_synthetic(frame);
    double sum = 0, squares = 0;
    for (const std::uint8_t v : image.rgb) {
      sum += v;
      squares += static_cast<double>(v) * v;
    }
    const double n = static_cast<double>(image.rgb.size()), mean = sum / n;
    EXPECT_NEAR(mean, 128, 0.15);
    const double rounding = 1.0 / 12;
    EXPECT_NEAR(std::sqrt(squares / n - mean * mean - rounding), wanted, 0.03 * wanted);
  }
}

TEST(Effects, NoiseIsNotRepeatedFromRowToRow) {
  SyntheticFrame frame = plain_frame();
  frame.effects.noise = 4;
  const SyntheticImage image = render_synthetic(frame);
  const double mean = 148.4;  // of 0.30 in linear light
  double product = 0, square = 0;
  for (std::size_t i = 0; i + 1920 < image.rgb.size(); ++i) {
    product += (image.rgb[i] - mean) * (image.rgb[i + 1920] - mean);
    square += (image.rgb[i] - mean) * (image.rgb[i] - mean);
  }
  EXPECT_LT(std::abs(product / square), 0.02);
}

TEST(Effects, TheSameSeedGivesTheSameBytesWhateverTheThreads) {
  const Rod rod(angle_marker(3));
  const Room room(120, 4);
  SyntheticFrame frame = plain_frame(320, 240);
  frame.room = &room;
  frame.effects.noise = 2;
  frame.effects.exposure = Duration::from_ms(5);
  frame.noise_seed = 11;
  frame.markers.push_back({&rod, sliding(Pose{{}, {-30, 30, 400}}, {4, 3, 0})});
  const SyntheticImage first = render_synthetic(frame);
  EXPECT_EQ(first.rgb, render_synthetic(frame).rgb);
  SyntheticRenderer shared(3);
  std::vector<std::uint8_t> rgb(first.rgb.size());
  std::vector<int> visible(1);
  shared.render(frame, rgb.data(), 3 * 320, visible);
  EXPECT_EQ(first.rgb, rgb);
  EXPECT_EQ(first.cells_visible, visible);
  frame.noise_seed = 12;
  EXPECT_NE(first.rgb, render_synthetic(frame).rgb);
}

TEST(Effects, GainScalesLightAndWarmLightReddens) {
  SyntheticFrame frame = plain_frame(64, 64);
  const auto full = mean_light(render_synthetic(frame));
  frame.effects.gain = 0.25;
  const auto dim = mean_light(render_synthetic(frame));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(dim[c] / full[c], 0.25, 0.01);
  frame.effects.gain = 1;
  frame.effects.light_kelvin = 3000;
  const auto warm = mean_light(render_synthetic(frame));
  EXPECT_GT(warm[0] / warm[1], 1.4);
  EXPECT_LT(warm[2] / warm[1], 0.5);
}

TEST(Effects, DefocusKeepsTheSumOfLightAndSpreadsEdges) {
  const Upright stick;
  SyntheticFrame frame = plain_frame();
  frame.markers.push_back({&stick.rod, stick.pose});
  const SyntheticImage sharp = render_synthetic(frame);
  frame.effects.blur = 2;
  const SyntheticImage soft = render_synthetic(frame);
  const auto a = mean_light(sharp), b = mean_light(soft);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(b[c] / a[c], 1, 0.003);
  const auto steepest = [&](const SyntheticImage& image) {
    int most = 0;
    for (int x = 1; x < frame.width; ++x)
      most = std::max(most, std::abs(pixel(image, x, 240)[0] - pixel(image, x - 1, 240)[0]));
    return most;
  };
  EXPECT_LT(2 * steepest(soft), steepest(sharp));
}

}  // namespace
}  // namespace onestroke::test

#include "golden/stage.h"

#include "golden/album.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace onestroke::golden {

namespace {

std::array<std::uint8_t, 3> chart_color(int x, int y, int width, int height) {
  const bool check = (x / 24 + y / 24) % 2 == 0;
  const bool line = x % 60 == 0 || y % 60 == 0;
  if (line) return {250, 250, 60};
  const int level = check ? 60 : 0;
  return {static_cast<std::uint8_t>(40 + level + 140 * x / width),
          static_cast<std::uint8_t>(60 + level + 110 * y / height),
          static_cast<std::uint8_t>(150 - level + 40 * (x * y % 7 == 0))};
}

}  // namespace

Chart::Chart(int width, int height, PixelFormat format, double horizontal_fov_rad) {
  // An odd stride, so that rows are not taken to follow each other without a gap.
  const std::size_t channels = format == PixelFormat::rgb8 ? 3 : 1;
  const std::size_t stride = static_cast<std::size_t>(width) * channels + 5;
  bytes.assign(stride * static_cast<std::size_t>(height), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto color = chart_color(x, y, width, height);
      std::copy_n(color.data(), channels,
                  bytes.data() + stride * static_cast<std::size_t>(y) + channels * static_cast<std::size_t>(x));
    }
  picture.width = width;
  picture.height = height;
  picture.format = format;
  picture.planes[0] = bytes.data();
  picture.strides[0] = stride;
  picture.intrinsics = Intrinsics::from_fov(width, height, horizontal_fov_rad);
}

Stage::Stage(int views) : views_(views) {
  display_ =
      std::make_unique<OffscreenDisplay>(OffscreenOptions{.width = width * views, .height = height, .views = views});
  // The one whose pictures the golden ones are, whatever else the machine has.
  gpu.emplace(GpuOptions{
      .needs = display_->needs(), .validation = true, .validation_messages = &validation_messages_, .gpu = "llvmpipe"});
  drawn_by_ = gpu->name();
  display_->attach(*gpu);
  renderer = std::make_unique<Renderer>(*gpu);
}

void Stage::TearDown() {
  display_->finish();
  renderer.reset();
  display_.reset();
  gpu.reset();
  EXPECT_EQ(validation_messages_, 0);
}

Picture Stage::draw(const FrameScene& scene, std::span<const View> views) {
  const Fov charts = fov_of(Intrinsics::from_fov(width, height, fov), width, height);
  for (int i = 0; i < 3; ++i) {
    FrameInfo frame;
    display_->begin(frame);
    for (auto& view : frame.views) view.fov = charts;
    std::copy(views.begin(), views.end(), frame.views.begin());
    EXPECT_TRUE(renderer->draw(scene, frame)) << renderer->failure();
    display_->end(frame);
  }
  return from_rgba(width * views_, height, display_->read_back());
}

void Stage::expect_golden(const std::string& name, const Picture& actual, Tolerance tolerance) {
  const char* bless = std::getenv("ONESTROKE_BLESS");
  const Album album({.pictures = ONESTROKE_SOURCE_DIR "/tests/golden/pictures", .failures = ONESTROKE_FAILURES_DIR},
                    drawn_by_, bless ? bless : "", std::cout);
  const std::string wrong = album.check(name, actual, tolerance);
  EXPECT_TRUE(wrong.empty()) << wrong;
}

Matrix4 placed(float x, float y, float z, float turn_x, float turn_y, float scale) {
  glm::mat4 m = glm::translate(glm::mat4(1), glm::vec3(x, y, z));
  m = glm::rotate(m, turn_x, glm::vec3(1, 0, 0));
  m = glm::rotate(m, turn_y, glm::vec3(0, 1, 0));
  m = glm::scale(m, glm::vec3(scale));
  Matrix4 values;
  std::copy_n(glm::value_ptr(m), 16, values.begin());
  return values;
}

}  // namespace onestroke::golden

// A finger on a stick is before the model that stands behind it.
#include "golden/solids.h"
#include "golden/stage.h"

namespace onestroke::golden {
namespace {

class Fingers : public Stage {
 protected:
  Fingers() : room(width, height, PixelFormat::rgb8, fov) {
    // A finger from the lower edge to above the middle, round at its end.
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double above = y < 160 ? (160 - y) * (160 - y) : 0;
        if ((x - 250) * (x - 250) + above > 22 * 22) continue;
        const int shade = 40 - 2 * std::abs(x - 250);
        const std::array skin{190 + shade, 140 + shade, 120 + shade};
        for (std::size_t c = 0; c < 3; ++c)
          room.bytes[room.picture.strides[0] * static_cast<std::size_t>(y) + 3 * static_cast<std::size_t>(x) + c] =
              static_cast<std::uint8_t>(skin[c]);
      }
    const Intrinsics& k = room.picture.intrinsics;
    for (double u = 236; u <= 264; u += 7)
      covered.push_back({{(u - k.cx) / k.fx * 400, (190 - k.cy) / k.fy * 400, 400}, 1});
    ring = {.model = renderer->load(torus(0.05F, 0.02F, {.base_color = {0.3F, 0.5F, 0.8F, 1}, .metallic = 0})),
            .world_graphics_from_model = placed(0, 0, -0.42F, -0.3F, 0)};
    near_ring = ring;
    near_ring.world_graphics_from_model = placed(0, 0, -0.34F, -0.3F, 0);
  }

  Chart room;
  std::vector<CoveredCell> covered;
  ModelInstance ring, near_ring;
  const std::array<DepthSegment, 1> stick{DepthSegment{{-60, 5, 400}, {60, 5, 400}}};
};

TEST_F(Fingers, AreBeforeWhatIsBehindThem) {
  renderer->set_picture(room.picture, covered);
  expect_golden("finger_before_model", draw({.passthrough_segments = stick, .instances = {&ring, 1}}),
                {.level = 3, .pixels = 60});
}

TEST_F(Fingers, AreLeftOutOnRequest) {
  renderer->set_picture(room.picture, covered);
  expect_golden("finger_left_out", draw({.passthrough_segments = stick, .instances = {&ring, 1}, .fingers = false}),
                {.level = 3, .pixels = 60});
}

TEST_F(Fingers, AreBehindWhatIsBeforeThem) {
  renderer->set_picture(room.picture, covered);
  const FrameScene scene{.passthrough_segments = stick, .instances = {&near_ring, 1}};
  FrameScene without = scene;
  without.fingers = false;
  const auto result = compare(draw(without), draw(scene), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Fingers, ChangeNothingWhereThereIsNoModel) {
  renderer->set_picture(room.picture, covered);
  const auto result = compare(draw({.passthrough_segments = stick, .fingers = false}),
                              draw({.passthrough_segments = stick}), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

}  // namespace
}  // namespace onestroke::golden

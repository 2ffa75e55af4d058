// Labels, gauges, leader lines and what is on the screen, alone and beside models; both eyes.
#include "golden/solids.h"
#include "golden/stage.h"

#include <algorithm>
#include <cmath>

namespace onestroke::golden {
namespace {

using Overlays = Stage;
using OverlaysStereo = StereoStage;

const ModelMaterial red{.base_color = {0.8F, 0.2F, 0.15F, 1}, .metallic = 0, .roughness = 0.5F};
const ModelMaterial blue{.base_color = {0.2F, 0.45F, 0.8F, 1}, .metallic = 0, .roughness = 0.5F};

/// Two models side by side with their names, as they are compared.
struct Pair {
  std::array<ModelInstance, 2> models;
  std::array<Label, 2> labels{Label{.text = "bracket A\n72.0 × 31.5 mm", .position_world = {-70, -75, 400}},
                              Label{.text = "bracket B\n72.0 × 32.1 mm", .position_world = {70, -75, 400}}};
  std::array<Line, 2> lines{Line{.from_world = {-70, -62, 400}, .to_world = {-60, -20, 380}, .color = {1, 1, 1, 0.9F}},
                            Line{.from_world = {70, -62, 400}, .to_world = {60, -20, 380}, .color = {1, 1, 1, 0.9F}}};

  explicit Pair(Renderer& renderer) {
    models[0] = {.model = renderer.load(torus(0.04F, 0.016F, red)),
                 .world_graphics_from_model = placed(-0.06F, 0, -0.4F, -0.6F, 0.3F)};
    models[1] = {.model = renderer.load(box({0.03F, 0.03F, 0.02F}, blue)),
                 .world_graphics_from_model = placed(0.06F, 0, -0.4F, 0.4F, -0.6F)};
  }
  FrameScene scene() const { return {.instances = models, .lines = lines, .labels = labels}; }
};

TEST_F(Overlays, NameTheModels) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const Pair pair(*renderer);
  const std::array hud{
      HudText{.text = "l: light   s: shape   q: quit", .x = 10, .y = 350, .height_px = 16, .pivot_y = 1},
      HudText{.text = "29.8 fps", .x = 470, .y = 10, .height_px = 13, .pivot_x = 1}};
  FrameScene scene = pair.scene();
  scene.hud = hud;
  expect_golden("labels", draw(scene), {.level = 3, .pixels = 60});
}

TEST_F(OverlaysStereo, GiveEachEyeItsView) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const Pair pair(*renderer);
  expect_golden("stereo", draw(pair.scene()), {.level = 3, .pixels = 120});
}

TEST_F(OverlaysStereo, LookTheSameInOnePassAsInTwo) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  const auto drawn = [&](bool multiview) {
    renderer = std::make_unique<Renderer>(*gpu, RendererOptions{.multiview = multiview});
    renderer->set_picture(chart.picture);
    const Pair pair(*renderer);
    return draw(pair.scene());
  };
  const auto result = compare(drawn(false), drawn(true), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(OverlaysStereo, HangTheScreensWordsBeforeBothEyes) {
  const std::array boxes{HudBox{.x = 200, .y = 60, .width = 24, .height = 80, .color = {0.8F, 0.3F, 0.1F, 1}}};
  const std::array hud{HudText{.text = "Side by side", .x = 0, .y = 0, .height_px = 20},
                       HudText{.text = "lower right", .x = 240, .y = 200, .height_px = 20, .pivot_x = 1, .pivot_y = 1}};
  FrameScene scene{.boxes = boxes, .hud = hud};
  scene.hud_plate = HudPlate{.distance = 500, .width = 240, .height = 200};
  expect_golden("hud_plate", draw(scene), {.level = 3, .pixels = 60});
}

TEST_F(Overlays, SetTextOfAllSizesCrisply) {
  const std::array labels{
      Label{.text = "20 mm: Ångström Øß Žluťoučký µm ° ± → Δ", .position_world = {0, -120, 450}, .height_mm = 14},
      Label{.text = "behind the box", .position_world = {-70, 30, 500}, .height_mm = 20},
      Label{.text = "in front", .position_world = {60, 70, 350}, .height_mm = 12, .color = {1, 0.8F, 0.2F, 1}},
      Label{.text = "on top", .position_world = {60, 20, 600}, .height_px = 30, .on_top = true},
      Label{.text = "no plate \xFF \xE4\xBD\xA0",
            .position_world = {90, 110, 400},
            .height_px = 20,
            .plate = {0, 0, 0, 0}}};
  const std::array hud{HudText{.text = "9 px: the quick brown fox", .x = 8, .y = 280, .height_px = 9},
                       HudText{.text = "12 px: the quick brown fox", .x = 8, .y = 300, .height_px = 12},
                       HudText{.text = "17 px: the quick brown fox", .x = 8, .y = 325, .height_px = 17}};
  const std::array instances{ModelInstance{.model = renderer->load(box({0.04F, 0.05F, 0.02F}, blue)),
                                           .world_graphics_from_model = placed(0, -0.02F, -0.42F, 0.2F, 0.3F)}};
  expect_golden("text",
                draw({.background = {0.05F, 0.1F, 0.08F, 1}, .instances = instances, .labels = labels, .hud = hud}),
                {.level = 3, .pixels = 60});
}

TEST_F(Overlays, DrawLinesOfEvenWidthAndCutThemAtTheEye) {
  std::array<Line, 10> lines;
  for (std::size_t i = 0; i < 8; ++i)
    lines[i] = {
        .from_world = {0, 0, 400},
        .to_world = {120 * std::cos(0.42 * static_cast<double>(i)), 110 * std::sin(0.42 * static_cast<double>(i)), 400},
        .width_px = 0.5 + static_cast<double>(i),
        .color = {1, 0.7F, 0.2F, 1}};
  lines[8] = {.from_world = {-150, 20, 600}, .to_world = {-20, 40, -300}, .width_px = 5, .color = {0.2F, 0.8F, 1, 1}};
  lines[9] = {.from_world = {-100, 0, -50}, .to_world = {100, 0, -50}, .width_px = 5, .color = {1, 0, 0, 1}};
  expect_golden("lines", draw({.lines = lines}), {.level = 3, .pixels = 60});
}

/// Of what a dwell shows: nothing yet, on its way, done; before and behind a model, on any background.
struct Rings {
  std::array<ModelInstance, 1> models;
  std::array<Gauge, 7> gauges{
      Gauge{.position_world = {-110, -60, 400}},
      Gauge{.position_world = {-60, -60, 400}, .progress = 0.3},
      Gauge{.position_world = {0, -60, 400}, .radius_px = 24, .progress = 0.8, .color = {1, 0.6F, 0.1F, 1}},
      Gauge{.position_world = {60, -60, 400}, .progress = 1},
      Gauge{.position_world = {-40, 30, 330}, .radius_px = 20, .progress = 0.3},
      Gauge{.position_world = {40, 30, 460}, .radius_px = 20, .progress = 0.6},
      Gauge{.position_world = {40, 0, 460}, .radius_px = 20, .progress = 0.6, .on_top = true}};
  std::array<Label, 1> labels{Label{.text = "overlay", .position_world = {-55, 30, 330}, .pivot_x = 1}};

  explicit Rings(Renderer& renderer) {
    models[0] = {.model = renderer.load(box({0.05F, 0.04F, 0.02F}, blue)),
                 .world_graphics_from_model = placed(0, -0.015F, -0.4F, 0.3F, 0.2F)};
  }
  FrameScene scene() const { return {.instances = models, .labels = labels, .gauges = gauges}; }
};

TEST_F(Overlays, FillRings) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  expect_golden("gauges", draw(Rings(*renderer).scene()), {.level = 3, .pixels = 60});
}

TEST_F(OverlaysStereo, FillRingsInBothEyes) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  expect_golden("gauges_stereo", draw(Rings(*renderer).scene()), {.level = 3, .pixels = 120});
}

/// A bar of colours from the bottom to the top, in heights that are no whole pixels.
std::array<HudBox, 32> color_bar(double x, double bottom, double step) {
  std::array<HudBox, 32> boxes;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto t = static_cast<float>(i) / 31;
    boxes[i] = {.x = x,
                .y = bottom - step * static_cast<double>(i + 1),
                .width = 18.4,
                .height = step,
                .color = {t, 0.3F + 0.4F * t * (1 - t), 1 - t, 1}};
  }
  return boxes;
}

TEST_F(Overlays, DrawABarOfColours) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const auto bar = color_bar(400, 300, 7.3);
  std::array<HudBox, 33> boxes{HudBox{.x = 392, .y = 50, .width = 84, .height = 262, .color = {0, 0, 0, 0.6F}}};
  std::copy(bar.begin(), bar.end(), boxes.begin() + 1);
  const std::array hud{
      HudText{.text = "+0.5", .x = 416, .y = 60, .height_px = 12, .plate = {0, 0, 0, 0}},
      HudText{.text = "-0.5 mm", .x = 416, .y = 305, .height_px = 12, .pivot_y = 1, .plate = {0, 0, 0, 0}}};
  expect_golden("color_bar", draw({.boxes = boxes, .hud = hud}), {.level = 3, .pixels = 60});
}

TEST_F(Overlays, LeaveNoSeamBetweenBoxes) {
  // All of one colour, so that any seam is seen; half see-through, so that any overlap is.
  for (const double step : {7.3, 8.0, 2.5, 0.7}) {
    auto boxes = color_bar(430.5, 300.5, step);
    for (auto& box : boxes) box.color = {1, 1, 1, 0.5F};
    const Picture picture = draw({.background = {0, 0, 0, 1}, .boxes = boxes});
    const int top = static_cast<int>(std::floor(300.5 - 32 * step + 0.5)), bottom = 301;
    const int inside = *picture.at(440, 298);
    EXPECT_NEAR(inside, 188, 1);  // Half of all light, coded as sRGB.
    for (int y = 0; y < height; ++y)
      for (const int x : {430, 431, 440, 448, 449})
        ASSERT_EQ(*picture.at(x, y), x >= 431 && x < 449 && y >= top && y < bottom ? inside : 0)
            << step << ' ' << x << ' ' << y;
  }
}

}  // namespace
}  // namespace onestroke::golden

#include "render/font.h"

#include "render/overlay.h"

#include <gtest/gtest.h>

#include <string>

namespace onestroke {
namespace {

std::u32string all_characters(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) characters += take_character(text);
  return characters;
}

TEST(Font, ReadsUtf8) {
  EXPECT_EQ(all_characters("aé→😀"), U"aé→😀");
}

TEST(Font, ReplacesEveryByteThatIsNotSound) {
  EXPECT_EQ(all_characters("a\xFFz"), U"a\uFFFDz");
  EXPECT_EQ(all_characters("\xE2\x86"), U"\uFFFD\uFFFD");            // cut short
  EXPECT_EQ(all_characters("\xC0\x80"), U"\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(all_characters("\xE0\x80\xAF"), U"\uFFFD\uFFFD\uFFFD");  // overlong
  EXPECT_EQ(all_characters("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");  // surrogate
  EXPECT_EQ(all_characters("\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD");
}

TEST(Font, HasWhatMeasurementsNeed) {
  constexpr std::u32string_view needed = U"AZaz09 .,:;()[]{}<>=+-*/%°±×µäÅøĞŻαΩπΔ−≈≤≥→∞";
  for (const char32_t code : needed) EXPECT_EQ(find_glyph(code).code, code);
  EXPECT_EQ(find_glyph(U'你').code, char32_t{0xFFFD});
}

TEST(Font, KeepsGlyphsInsideTheAtlasAndApart) {
  const FontAtlas& atlas = font_atlas();
  ASSERT_EQ(atlas.texels.size(), static_cast<std::size_t>(atlas.width * atlas.height));
  std::vector<bool> taken(atlas.texels.size());
  for (const Glyph& g : atlas.glyphs) {
    const auto u0 = static_cast<int>(g.u0 * static_cast<float>(atlas.width) + 0.5F);
    const auto u1 = static_cast<int>(g.u1 * static_cast<float>(atlas.width) + 0.5F);
    const auto v0 = static_cast<int>(g.v0 * static_cast<float>(atlas.height) + 0.5F);
    const auto v1 = static_cast<int>(g.v1 * static_cast<float>(atlas.height) + 0.5F);
    ASSERT_LE(u1, atlas.width);
    ASSERT_LE(v1, atlas.height);
    for (int v = v0; v < v1; ++v)
      for (int u = u0; u < u1; ++u) {
        const auto at = static_cast<std::size_t>(v * atlas.width + u);
        ASSERT_FALSE(taken[at]) << static_cast<unsigned>(g.code);
        taken[at] = true;
      }
  }
}

TEST(Font, MeasuresLines) {
  const TextSize one = measure("mm"), two = measure("mm\nm");
  EXPECT_FLOAT_EQ(one.width, 2 * find_glyph(U'm').advance);
  EXPECT_FLOAT_EQ(two.width, one.width);
  EXPECT_FLOAT_EQ(two.height, one.height + font_atlas().line);
}

TEST(Overlay, CentresLabelsOnTheirPositionAtTheSizeAsked) {
  const View view{.T_world_view = {}, .fov = {}, .viewport = {0, 0, 1000, 1000}};
  const std::array labels{Label{.text = "M", .position_world = {10, 20, 500}, .height_mm = 25},
                          Label{.text = "M", .position_world = {10, 20, 800}, .height_px = 40}};
  Overlay overlay;
  overlay.build({.labels = labels}, {&view, 1});
  ASSERT_EQ(overlay.quads().size(), 4U);
  EXPECT_EQ(overlay.tested(), 4U);
  const auto plate_middle = [&](std::size_t i) {
    const auto& q = overlay.quads()[i];
    return q.origin + 0.5F * q.edge_x + 0.5F * q.edge_y;
  };
  const auto em = [&](std::size_t i) { return overlay.quads()[i].edge_x.x / overlay.quads()[i].uv.x; };
  // The farther label comes first; 500 pixels are 45 degrees, so 40 of them are 64 mm at 800 mm.
  EXPECT_NEAR(plate_middle(0).z, -0.8, 1e-6);
  EXPECT_NEAR(em(0), 0.064, 1e-6);
  EXPECT_NEAR(plate_middle(2).x, 0.01, 1e-6);
  EXPECT_NEAR(plate_middle(2).y, -0.02, 1e-6);
  EXPECT_NEAR(plate_middle(2).z, -0.5, 1e-6);
  EXPECT_NEAR(em(2), 0.025, 1e-6);
}

TEST(Overlay, LeavesOutLabelsBehindTheViewer) {
  const View view{.T_world_view = {}, .fov = {}, .viewport = {0, 0, 1000, 1000}};
  const std::array labels{Label{.text = "M", .position_world = {10, 20, -500}}};
  Overlay overlay;
  overlay.build({.labels = labels}, {&view, 1});
  EXPECT_TRUE(overlay.quads().empty());
}

}  // namespace
}  // namespace onestroke

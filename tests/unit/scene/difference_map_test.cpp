#include "scene/difference_map.h"

#include "scene/color_scale.h"
#include "scene/frames.h"
#include "solid_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

constexpr double mm = metres_per_millimetre;

/// Slabs on one another's corner: each has a part that the other lacks.
Model step(bool low) {
  return model_of(cubes(10 * mm, {4, 2, 2}, [low](const Cell& c) { return c.y == 0 || (low ? c.x == 0 : c.x == 3); }),
                  "step");
}

std::array<float, 4> opaque(const std::array<float, 3>& color) {
  return {color[0], color[1], color[2], 1};
}

TEST(DifferenceMap, HasTheScalesColours) {
  const ComparedModel laid(step(true)), base(step(false));
  ModelDifference d = compare(laid, base, Alignment::own_frames);
  const ColorScale scale(d.statistics.reach);
  d.laid[0] = static_cast<float>(2 * d.statistics.reach * mm);
  d.laid[1] = static_cast<float>(-2 * d.statistics.reach * mm);
  d.laid[2] = 0;
  const Model map = difference_map(laid, d);
  ASSERT_EQ(map.vertices.size(), laid.refined.vertices.size());
  EXPECT_EQ(map.vertices[0].color, opaque(scale.color(d.statistics.reach)));
  EXPECT_EQ(map.vertices[1].color, opaque(scale.color(-d.statistics.reach)));
  EXPECT_EQ(map.vertices[2].color, opaque(scale.color(0)));
  for (std::size_t i = 0; i < map.vertices.size(); ++i) {
    EXPECT_EQ(map.vertices[i].color, opaque(scale.color(d.laid[i] / mm)));
    EXPECT_EQ(map.vertices[i].position, laid.refined.vertices[i].position);
  }
}

TEST(DifferenceMap, IsMattAndSolid) {
  const ComparedModel laid(step(true)), base(step(false));
  const Model map = difference_map(laid, compare(laid, base, Alignment::own_frames));
  ASSERT_EQ(map.materials.size(), 1U);
  EXPECT_EQ(map.materials[0].metallic, 0);
  EXPECT_FALSE(map.materials[0].textured());
  EXPECT_FALSE(map.materials[0].double_sided);
  EXPECT_EQ(map.materials[0].alpha_mode, ModelMaterial::AlphaMode::opaque);
  EXPECT_EQ(map.indices, laid.refined.indices);
  EXPECT_NEAR(map.upper[0] - map.lower[0], 40 * mm, 1e-7);
}

TEST(DifferenceMap, ShowsAnOpenSurfaceFromBehindToo) {
  Surface sheet;
  add_face(sheet, {0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}, 4);
  const ComparedModel laid(model_of(sheet)), base(step(false));
  EXPECT_TRUE(difference_map(laid, compare(laid, base, Alignment::own_frames)).materials[0].double_sided);
}

TEST(DifferenceVeil, ShowsWhatTheBaseHasMore) {
  const ComparedModel laid(step(true)), base(step(false));
  const ModelDifference d = compare(laid, base, Alignment::own_frames);
  const Model veil = difference_veil(base, d);
  EXPECT_EQ(veil.materials[0].alpha_mode, ModelMaterial::AlphaMode::blend);
  EXPECT_FALSE(veil.casts_shadow);
  ASSERT_FALSE(veil.indices.empty());
  float most = 0;
  for (const ModelVertex& v : veil.vertices) {
    // Both are the same but for a block of 10 x 10 x 20 mm on either end.
    EXPECT_GE(v.position[0], 30 * mm - 1e-8);
    EXPECT_GE(v.position[1], 10 * mm - 1e-8);
    if (v.position[1] < 10 * mm + 1e-8) {
      EXPECT_EQ(v.color[3], 0) << "on the other's surface";
    }
    most = std::max(most, v.color[3]);
  }
  EXPECT_FLOAT_EQ(most, veil_opacity);
  for (std::size_t i = 0; i < veil.indices.size(); i += 3) {
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += veil.vertices[veil.indices[i + k]].color[3];
    EXPECT_GT(sum, 0);
  }
}

TEST(DifferenceVeil, IsEmptyWhereNothingIsMissing) {
  const ComparedModel body(step(true)), slab(model_of(cubes(10 * mm, {4, 1, 2}, [](const Cell&) { return true; })));
  EXPECT_TRUE(difference_veil(body, compare(body, body, Alignment::own_frames)).indices.empty());
  EXPECT_TRUE(difference_veil(slab, compare(body, slab, Alignment::own_frames)).indices.empty());
  EXPECT_FALSE(difference_veil(body, compare(slab, body, Alignment::own_frames)).indices.empty());
}

}  // namespace
}  // namespace onestroke

#include "render/depth_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace onestroke {
namespace {

const Intrinsics camera = Intrinsics::from_fov(1280, 720, 1.1);
const PlaneBounds bounds = picture_bounds(camera, 1280, 720, 0.1), inside = inner_bounds(camera, 1280, 720);

double depth_at(double x, double y, std::span<const DepthSegment> segments, double distance = 500) {
  DepthSurface surface;
  surface.build(inside, bounds, segments, distance);
  return 1 / surface.inverse_depth(x, y);
}

/// Depth, mm, as it is drawn: 1 / z is affine over each of a cell's two triangles.
double drawn_depth(const DepthSurface& surface, double x, double y) {
  const int columns = surface.across().cells, rows = surface.down().cells;
  const double u = surface.across().cell_of(x), v = surface.down().cell_of(y);
  const int column = std::min(static_cast<int>(u), columns - 1), row = std::min(static_cast<int>(v), rows - 1);
  const auto at = [&](int i, int j) {
    return double{surface.inverse_depths()[static_cast<std::size_t>((row + i) * (columns + 1) + column + j)]};
  };
  const double s = u - column, t = v - row, top_right = at(0, 1), bottom_left = at(1, 0);
  if (s + t < 1) return 1000 / (at(0, 0) + s * (top_right - at(0, 0)) + t * (bottom_left - at(0, 0)));
  return 1000 / (at(1, 1) + (1 - s) * (bottom_left - at(1, 1)) + (1 - t) * (top_right - at(1, 1)));
}

TEST(DepthSurface, FindsTheCellOfAPlace) {
  const SurfaceAxis axis{.outer_from = -2, .from = -1, .to = 1, .outer_to = 3, .cells = 6};
  for (int i = 0; i < axis.cells; ++i)
    EXPECT_NEAR(axis.cell_of(0.75 * axis.at(i) + 0.25 * axis.at(i + 1)), i + 0.25, 1e-12) << i;
  EXPECT_EQ(axis.cell_of(-5), 0);
  EXPECT_EQ(axis.cell_of(5), axis.cells);
  // A lens may leave nothing that is only picture.
  const SurfaceAxis none{.outer_from = -2, .from = 0, .to = 0, .outer_to = 2, .cells = 6};
  EXPECT_NEAR(none.cell_of(-1), 0.5, 1e-12);
  EXPECT_NEAR(none.cell_of(1), 5.5, 1e-12);
}

TEST(DepthSurface, IsAPlaneWhereNothingIsKnown) {
  DepthSurface surface;
  surface.build(inside, bounds, {}, 450);
  EXPECT_EQ(surface.inverse_depths().size(), 16U);
  for (const float q : surface.inverse_depths()) EXPECT_FLOAT_EQ(q, 1 / 0.45F);
}

TEST(DepthSurface, RunsThroughASegmentAlongAllItsLength) {
  const std::array segments{DepthSegment{{-60, 20, 380}, {40, -30, 470}}};
  for (double along = 0; along <= 1; along += 0.1) {
    const Vec3 p = segments[0].from + along * (segments[0].to - segments[0].from);
    EXPECT_NEAR(depth_at(p.x / p.z, p.y / p.z, segments), p.z, 0.1) << along;
  }
}

TEST(DepthSurface, GoesToTheSetDistanceFarFromEverything) {
  const std::array segments{DepthSegment{{-10, 0, 300}, {10, 0, 300}}};
  EXPECT_NEAR(depth_at(3, 0, segments, 800), 800, 8);
  EXPECT_NEAR(depth_at(0, 0.02, segments, 800), 300, 1);
}

TEST(DepthSurface, StaysBetweenWhatItIsMadeOf) {
  const std::array segments{DepthSegment{{-120, 0, 300}, {-80, 40, 340}}, DepthSegment{{90, 0, 600}, {130, -50, 650}}};
  for (double x = bounds.left; x < bounds.right; x += 0.05)
    for (double y = bounds.top; y < bounds.bottom; y += 0.05) {
      const double z = depth_at(x, y, segments);
      EXPECT_GE(z, 299.9);
      EXPECT_LE(z, 650.1);
    }
}

TEST(DepthSurface, ComesAndGoesWithoutAJump) {
  std::array segments{DepthSegment{{-60, 20, 300}, {40, -30, 320}}, DepthSegment{{120, 0, 600}, {160, 40, 600}}};
  for (const double x : {-0.05, 0.1, 0.25}) {
    segments[0].weight = 0;
    double before = depth_at(x, 0.0, segments);
    for (int i = 1; i <= 100; ++i) {
      segments[0].weight = i / 100.0;
      const double z = depth_at(x, 0.0, segments);
      // The first step brings what is a little nearer than what was there; none is larger than a twentieth.
      EXPECT_LT(std::abs(z - before), 25) << x << " " << i;
      before = z;
    }
  }
  EXPECT_NEAR(depth_at(-0.05, 0.0, segments), 308, 3);
}

TEST(DepthSurface, TakesAChainNoSteeperThanSideways) {
  const std::array chain{Vec3{0, -60, 400}, Vec3{0, 0, 400}, Vec3{10, 0, 470}};
  std::array<DepthSegment, 4> pieces;
  ASSERT_EQ(chain_segments(chain, 0.5, pieces), 2U);
  EXPECT_EQ(pieces[0].from, chain[0]);
  EXPECT_EQ(pieces[0].to, chain[1]);
  EXPECT_EQ(pieces[1].from, chain[1]);
  EXPECT_NEAR(pieces[1].to.z, 410, 1e-9);
  EXPECT_NEAR(pieces[1].to.x / pieces[1].to.z, 10 / 470.0, 1e-12);
  EXPECT_EQ(pieces[1].weight, 0.5);
}

TEST(DepthSurface, LeavesOutWhatIsBehindTheCamera) {
  const std::array segments{DepthSegment{{0, 0, -100}, {0, 0, 300}}};
  DepthSurface surface;
  surface.build(inside, bounds, segments, 500);
  for (const float q : surface.inverse_depths()) EXPECT_FLOAT_EQ(q, 2.0F);
}

// 31.5 mm beside the camera a millimetre of depth at 350 mm is a quarter of a pixel.
TEST(DepthSurface, IsDrawnRightAtTheCornersOfSticksAndNearlySoAlongThem) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> turn(-3, 3), aside(-90, 90), far(350, 700);
  double worst = 0;
  std::vector<double> along;
  for (int i = 0; i < 300; ++i) {
    std::vector<DepthSegment> segments;
    std::vector<Vec3> corners;
    for (const double side : {-110.0, 110.0}) {
      const Pose T{exp_so3({turn(random), turn(random), turn(random)}),
                   {side + aside(random) / 2, aside(random), far(random)}};
      const std::array chain{T * Vec3{0, -72, 0}, T * Vec3{}, T * Vec3{72, 0, 0}};
      std::array<DepthSegment, 2> pieces;
      ASSERT_EQ(chain_segments(chain, 1, pieces), 2U);
      segments.insert(segments.end(), pieces.begin(), pieces.end());
      corners.push_back(T.translation);
    }
    DepthSurface surface;
    surface.build(inside, bounds, segments, 500);
    // Sticks that cross in the picture cannot both be met.
    const Vec3 a = corners[0], b = corners[1];
    if (std::hypot(a.x / a.z - b.x / b.z, a.y / a.z - b.y / b.z) < 0.35) continue;
    for (const Vec3 c : corners) worst = std::max(worst, std::abs(drawn_depth(surface, c.x / c.z, c.y / c.z) - c.z));
    // One alone, and not folded up, since arms before each other cannot both be met.
    segments.resize(2);
    surface.build(inside, bounds, segments, 500);
    const Vec3 tip = segments[0].from, stop = segments[1].to;
    if (std::hypot(tip.x / tip.z - stop.x / stop.z, tip.y / tip.z - stop.y / stop.z) < 0.15) continue;
    for (const DepthSegment& s : segments) {
      const Vec3 p = (s.from + s.to) / 2;
      if (std::hypot(s.from.x - s.to.x, s.from.y - s.to.y) < 50) continue;
      along.push_back(std::abs(drawn_depth(surface, p.x / p.z, p.y / p.z) - p.z));
    }
  }
  EXPECT_LT(worst, 0.01);
  ASSERT_GT(along.size(), 150U);
  std::sort(along.begin(), along.end());
  EXPECT_LT(along[along.size() * 95 / 100], 4);
}

}  // namespace
}  // namespace onestroke

#include "marker/shape.h"

#include "../core/error_of.h"
#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace onestroke {
namespace {

using std::numbers::pi;

void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-9) {
  EXPECT_NEAR(norm(a - b), 0, tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") is not (" << b.x << ", "
                                         << b.y << ", " << b.z << ")";
}

/// Pieces follow one another without a gap, and the line is as long as its cells.
void expect_continuous(const Shape& shape) {
  double s = 0;
  for (const Shape::Piece& piece : shape.pieces()) {
    EXPECT_NEAR(piece.start, s, 1e-9);
    EXPECT_NEAR(norm(piece.tangent), 1, 1e-12);
    if (s > 0) {
      const Vec3 before = shape.at(s - 1e-7).position;
      EXPECT_NEAR(norm(before - piece.origin), 1e-7, 1e-9);
    }
    s += piece.length;
  }
  EXPECT_NEAR(s, shape.length(), 1e-9);
}

/// The line's length by summing chords, so that `s` is shown to be arc length.
double walked(const Shape& shape, double from, double to) {
  double sum = 0;
  const int steps = 20000;
  Vec3 last = shape.at(from).position;
  for (int i = 1; i <= steps; ++i) {
    const Vec3 next = shape.at(from + (to - from) * i / steps).position;
    sum += norm(next - last);
    last = next;
  }
  return sum;
}

TEST(AngleShape, SharpCornerStandsLikeTheLetterL) {
  const Shape shape = Shape::angle(36, 4, 3, 0);
  expect_near(shape.at(0).position, {0, -72, 0});
  expect_near(shape.at(72).position, {0, 0, 0});
  expect_near(shape.at(144).position, {72, 0, 0});
  expect_near(shape.at(0).tangent, {0, 1, 0});
  expect_near(shape.at(71.999).tangent, {0, 1, 0});
  expect_near(shape.at(72).tangent, {1, 0, 0});
  EXPECT_TRUE(shape.has_roll());
  expect_continuous(shape);
}

TEST(AngleShape, MitreLiesInTheBisectingPlane) {
  const Shape shape = Shape::angle(36, 4, 3, 0);
  const double h = std::sqrt(0.5);
  expect_near(shape.cut_normal(72), {h, h, 0});
  expect_near(shape.cut_normal(68), {0, 1, 0});
  expect_near(shape.cut_normal(76), {1, 0, 0});
}

TEST(AngleShape, MitreIsFoundWhateverTheRounding) {
  for (const double pitch : {0.1, 0.3, 1.0 / 3, 4.1, 7.7}) {
    const Shape shape = Shape::angle(34, pitch, pitch / 2, 0);
    const double s = 17 * pitch;
    expect_near(shape.cut_normal(s), {std::sqrt(0.5), std::sqrt(0.5), 0});
    expect_near(shape.at(s).tangent, {1, 0, 0});
    expect_near(shape.at(std::nextafter(s, 0)).tangent, {1, 0, 0});
  }
}

TEST(AngleShape, BendOfEightMillimetres) {
  const double r = 8, straight = 72 - pi * r / 4, tip = straight + r;
  const Shape shape = Shape::angle(36, 4, 3, r);
  ASSERT_EQ(shape.pieces().size(), 3u);
  EXPECT_NEAR(shape.pieces()[0].length, straight, 1e-12);
  EXPECT_NEAR(shape.pieces()[1].length, pi * r / 2, 1e-12);
  EXPECT_NEAR(shape.pieces()[2].length, straight, 1e-12);
  expect_near(shape.at(0).position, {0, -tip, 0});
  expect_near(shape.at(144).position, {tip, 0, 0});
  // The middle boundary is the middle of the arc about (r, -r), its ring in the bisecting plane.
  const double h = std::sqrt(0.5);
  expect_near(shape.at(72).position, Vec3{r, -r, 0} + Vec3{-r * h, r * h, 0});
  expect_near(shape.cut_normal(72), {h, h, 0});
  EXPECT_NEAR(walked(shape, 0, 144), 144, 1e-6);
  for (int cell = 0; cell < 36; ++cell) EXPECT_NEAR(walked(shape, 4 * cell, 4 * cell + 4), 4, 1e-6);
  expect_continuous(shape);
}

TEST(AngleShape, EveryPointOfTheBendKeepsItsRadiusAndTangent) {
  const Shape shape = Shape::angle(24, 5, 2, 12);
  const double straight = 60 - pi * 12 / 4;
  for (double s = straight; s <= 120 - straight; s += 0.25) {
    const CentrelinePoint p = shape.at(s);
    const Vec3 spoke = p.position - Vec3{12, -12, 0};
    EXPECT_NEAR(norm(spoke), 12, 1e-9);
    EXPECT_NEAR(dot(spoke, p.tangent), 0, 1e-9);
    EXPECT_NEAR(norm(p.tangent), 1, 1e-12);
  }
}

TEST(AngleShape, IsMirroredInTheBisector) {
  const Shape shape = Shape::angle(36, 4, 3, 8);
  for (double s = 0; s <= 144; s += 1.5) {
    const Vec3 a = shape.at(s).position, b = shape.at(144 - s).position;
    expect_near(b, {-a.y, -a.x, 0});
  }
}

TEST(AngleShape, AllBendMayBeArc) {
  const Shape shape = Shape::angle(36, 4, 3, 144 * 2 / pi - 1e-9);
  EXPECT_NEAR(walked(shape, 0, 144), 144, 1e-5);
}

TEST(AngleShape, ClampsArcLength) {
  const Shape shape = Shape::angle(36, 4, 3, 8);
  expect_near(shape.at(-5).position, shape.at(0).position, 0);
  expect_near(shape.at(500).position, shape.at(144).position, 0);
}

TEST(AngleShape, RefusesWhatMakesNoRod) {
  const double nan = std::nan("");
  using testing::HasSubstr;
  EXPECT_THAT(error_of([] { Shape::angle(2, 4, 3, 0); }), HasSubstr("3 to 64 cells, not 2"));
  EXPECT_THAT(error_of([] { Shape::angle(65, 4, 3, 0); }), HasSubstr("not 65"));
  EXPECT_THAT(error_of([] { Shape::angle(35, 4, 3, 0); }), HasSubstr("even number"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 0, 3, 0); }), HasSubstr("pitch"));
  EXPECT_THAT(error_of([] { Shape::angle(36, -4, 3, 0); }), HasSubstr("pitch"));
  EXPECT_THAT(error_of([&] { Shape::angle(36, nan, 3, 0); }), HasSubstr("pitch"));
  EXPECT_THAT(error_of([&] { Shape::angle(36, HUGE_VAL, 3, 0); }), HasSubstr("pitch"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 4, 0, 0); }), HasSubstr("radius"));
  EXPECT_THAT(error_of([&] { Shape::angle(36, 4, nan, 0); }), HasSubstr("radius"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 4, 0.001, 0); }), HasSubstr("hundredth"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 4, 100, 0); }), HasSubstr("do not fit"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 4, 3, -1); }), HasSubstr("bend radius"));
  EXPECT_THAT(error_of([&] { Shape::angle(36, 4, 3, nan); }), HasSubstr("bend radius"));
  EXPECT_THAT(error_of([] { Shape::angle(36, 4, 3, 95); }), HasSubstr("allow at most 91.6"));
}

TEST(LineShape, LiesAlongXAndHasNoRoll) {
  const Shape shape = Shape::line(10, 4, 3);
  expect_near(shape.at(0).position, {-20, 0, 0});
  expect_near(shape.at(40).position, {20, 0, 0});
  expect_near(shape.cut_normal(20), {1, 0, 0});
  EXPECT_FALSE(shape.has_roll());
  expect_continuous(shape);
}

TEST(StrokeShape, EqualsTheAngleOfTheSameVertices) {
  for (const double bend : {0.0, 8.0}) {
    const Shape angle = Shape::angle(36, 4, 3, bend);
    const Shape stroke = Shape::stroke(36, 4, 3, bend, angle.vertices());
    for (double s = 0; s <= 144; s += 0.5) {
      expect_near(stroke.at(s).position, angle.at(s).position);
      expect_near(stroke.cut_normal(s), angle.cut_normal(s));
    }
  }
}

TEST(StrokeShape, BendsInSpace) {
  // Three legs along x, y and z: two fillets of a quarter turn, each r (2 - pi/2) shorter than its corner.
  const double r = 6, cut = r * (2 - pi / 2), leg = (96 + 2 * cut) / 3;
  const Shape shape = Shape::stroke(24, 4, 2, r, {{0, 0, 0}, {leg, 0, 0}, {leg, leg, 0}, {leg, leg, leg}});
  EXPECT_EQ(shape.pieces().size(), 5u);
  expect_near(shape.at(96).position, {leg, leg, leg});
  expect_near(shape.at(96).tangent, {0, 0, 1});
  EXPECT_NEAR(walked(shape, 0, 96), 96, 1e-6);
  EXPECT_TRUE(shape.has_roll());
  expect_continuous(shape);
}

TEST(StrokeShape, StraightVerticesHaveNoRoll) {
  EXPECT_FALSE(Shape::stroke(10, 4, 3, 5, {{0, 0, 0}, {0, 10, 0}, {0, 40, 0}}).has_roll());
}

TEST(StrokeShape, TakesVerticesRoundedToHundredths) {
  const Shape shape = Shape::stroke(10, 4, 3, 0, {{0, 0, 0}, {0, 40.009, 0}});
  expect_continuous(shape);
  expect_near(shape.at(40).position, {0, 40, 0});
}

/// What a sharp-cornered stroke of 40 cells and radius 3 through these vertices is refused for.
std::string refusal(const std::vector<Vec3>& vertices) {
  double length = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i) length += norm(vertices[i] - vertices[i - 1]);
  return error_of([&] { Shape::stroke(40, length / 40, 3, 0, vertices); });
}

TEST(StrokeShape, RefusesOverlap) {
  using testing::HasSubstr;
  // A square whose last side comes back across the first.
  EXPECT_THAT(refusal({{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {30, 60, 0}, {30, -10, 0}}), HasSubstr("overlaps itself"));
  // The same, but passing over it at 5.9 and at 6 mm, with a diameter of 6 mm.
  EXPECT_THAT(refusal({{0, 0, 0}, {60, 0, 0}, {60, 60, 5.9}, {30, 60, 5.9}, {30, -10, 5.9}}),
              HasSubstr("overlaps itself"));
  EXPECT_EQ(refusal({{0, 0, 0}, {60, 0, 0}, {60, 60, 6}, {30, 60, 6}, {30, -10, 6}}), "no error");
  // A leg that runs back ever closer, and one that stays a diameter away.
  EXPECT_THAT(refusal({{0, 0, 0}, {40, 0, 0}, {44, 10, 0}, {5, 2, 0}}), HasSubstr("overlaps itself"));
  EXPECT_EQ(refusal({{0, 0, 0}, {40, 0, 0}, {40, 6, 0}, {0, 6, 0}}), "no error");
  // Corners that take more than the leg between them has.
  EXPECT_THAT(refusal({{0, 0, 0}, {40, 0, 0}, {40, 5.9, 0}, {0, 5.9, 0}}), HasSubstr("do not fit"));
  EXPECT_THAT(refusal({{0, 0, 0}, {40, 0, 0}, {0, 0.1, 0}}), HasSubstr("turns back"));
}

TEST(StrokeShape, TakesAFinelyDrawnRing) {
  // Three quarters of a circle of radius 20 as 72 chords, each far shorter than the rod is thick.
  std::vector<Vec3> vertices;
  for (int i = 0; i <= 72; ++i) {
    const double a = 1.5 * pi * i / 72;
    vertices.push_back({20 * std::cos(a), 20 * std::sin(a), 0});
  }
  const double length = 72 * 2 * 20 * std::sin(0.75 * pi / 72);
  EXPECT_NO_THROW(Shape::stroke(24, length / 24, 3, 0, vertices));
}

TEST(StrokeShape, RefusesBadVertices) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of([] { Shape::stroke(10, 4, 3, 0, {{0, 0, 0}}); }), HasSubstr("at least 2"));
  EXPECT_THAT(error_of([] { Shape::stroke(10, 4, 3, 0, {{0, 0, 0}, {0, 0, 0}, {40, 0, 0}}); }), HasSubstr("coincide"));
  EXPECT_THAT(error_of([] { Shape::stroke(10, 4, 3, 0, {{0, 0, 0}, {std::nan(""), 0, 0}}); }), HasSubstr("finite"));
  EXPECT_THAT(error_of([] { Shape::stroke(10, 4, 3, 0, {{0, 0, 0}, {50, 0, 0}}); }), HasSubstr("is 40 mm long"));
}

}  // namespace
}  // namespace onestroke

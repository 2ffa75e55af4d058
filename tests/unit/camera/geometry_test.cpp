// Where the renderer puts each cell, against a projection written here from the marker's definition alone.

#include "scene_fixture.h"

#include <functional>
#include <optional>

namespace onestroke::test {
namespace {

struct Uv {
  double u = 0, v = 0;
};

/// OpenCV's lens model, written out.
Uv project(const Intrinsics& k, Vec3 p) {
  const double x = p.x / p.z, y = p.y / p.z, r2 = x * x + y * y;
  const double radial = 1 + k.distortion[0] * r2 + k.distortion[1] * r2 * r2 + k.distortion[4] * r2 * r2 * r2;
  const double bx = x * radial + 2 * k.distortion[2] * x * y + k.distortion[3] * (r2 + 2 * x * x);
  const double by = y * radial + k.distortion[2] * (r2 + 2 * y * y) + 2 * k.distortion[3] * x * y;
  return {k.fx * bx + k.cx, k.fy * by + k.cy};
}

/// The centreline of the sharp angle as MARKER's frame defines it: red tip at (0, -72, 0), corner at the origin, stop
/// tip at (72, 0, 0).
CentrelinePoint sharp_angle(double s) {
  return s < 72 ? CentrelinePoint{{0, s - 72, 0}, {0, 1, 0}} : CentrelinePoint{{s - 72, 0, 0}, {1, 0, 0}};
}

using Centreline = std::function<CentrelinePoint(double)>;

/// Nothing of the rod lies between the camera and a point of its surface, by sampling the line of sight. Points that a
/// mitre swallows, inside the other arm, are hidden too.
bool unhidden(const Pose& pose, const Centreline& line, double length, double radius, Vec3 point) {
  const double distance = norm(point);
  for (double s = 0; s <= length; s += 0.05) {
    if (norm(point - pose * line(s).position) < radius - 0.01) return false;
  }
  for (double d = distance - 160; d < distance; d += 0.5) {
    const Vec3 on_sight = (d / distance) * point;
    for (double s = 0; s <= length; s += 0.5) {
      if (norm(on_sight - pose * line(s).position) < radius - 0.05) return false;
    }
  }
  return true;
}

/// The pixel that sees the middle of the rod's front at arc length s; nothing where it is seen too flat or is hidden.
std::optional<Uv> front(const Intrinsics& k, const Pose& pose, const Centreline& line, double s) {
  constexpr double radius = 3;
  const CentrelinePoint c = line(s);
  const Vec3 p = pose * c.position, tangent = rotate(pose.rotation, c.tangent), to_eye = normalized(-p);
  const Vec3 across = to_eye - dot(to_eye, tangent) * tangent;
  if (norm(across) < 0.5) return std::nullopt;
  const Vec3 surface = p + radius * normalized(across);
  if (!unhidden(pose, line, 144, radius, surface)) return std::nullopt;
  return project(k, surface);
}

int strongest(const std::array<int, 3>& rgb) {
  return static_cast<int>(std::max_element(rgb.begin(), rgb.end()) - rgb.begin());
}

/// Checks three points along each cell; returns how many it could check.
int check_cells(const SyntheticFrame& frame, const Centreline& line, const Cells& cells) {
  const SyntheticImage image = render_synthetic(frame);
  const Pose& pose = frame.markers[0].T_camera_marker.middle();
  int checked = 0;
  for (int cell = 0; cell < 36; ++cell) {
    for (const double within : {0.25, 0.5, 0.75}) {
      const auto uv = front(frame.intrinsics, pose, line, (cell + within) * 4);
      if (!uv) continue;
      const int x = static_cast<int>(std::floor(uv->u)), y = static_cast<int>(std::floor(uv->v));
      if (x < 0 || y < 0 || x >= frame.width || y >= frame.height) continue;
      EXPECT_EQ(strongest(pixel(image, x, y)), static_cast<int>(cells[static_cast<std::size_t>(cell)]))
          << "cell " << cell << " at " << within;
      ++checked;
    }
  }
  return checked;
}

TEST(Geometry, CellsLieWhereTheDefinitionPutsThemInTheFrontalPose) {
  const Rod rod(angle_marker(3));
  SyntheticFrame frame = plain_frame(1280, 960);
  frame.markers.push_back({&rod, Pose{{}, {-36, 36, 400}}});
  EXPECT_EQ(check_cells(frame, sharp_angle, rod.spec().cells), 108);
}

TEST(Geometry, CellsLieWhereTheDefinitionPutsThemAllTheWayRound) {
  const Rod rod(angle_marker(7));
  SyntheticFrame frame = plain_frame(1280, 960);
  int checked = 0;
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, normalized(Vec3{1, -1, 1})}) {
    for (double angle = 0.2; angle < 2 * std::numbers::pi; angle += 0.8) {
      const Quat turn = exp_so3(angle * axis);
      frame.markers.assign(1, {&rod, Pose{turn, Vec3{10, -5, 380} - rotate(turn, {36, -36, 0})}});
      checked += check_cells(frame, sharp_angle, rod.spec().cells);
    }
  }
  EXPECT_GT(checked, 32 * 60);
}

TEST(Geometry, LensDistortionBendsThePictureAsOpenCvDoes) {
  const Rod rod(angle_marker(9));
  SyntheticFrame frame = plain_frame(1280, 960, 60 * radian);
  frame.intrinsics.cx += 7;
  frame.intrinsics.distortion = {-0.22, 0.08, 0.001, -0.002, 0.01};
  frame.markers.push_back({&rod, Pose{from_euler_xyz(0.2, 0.3, 0), {120, -60, 350}}});
  EXPECT_GT(check_cells(frame, sharp_angle, rod.spec().cells), 90);
}

/// The fillet of radius 12: the arc is centred on arc length 72, the straight parts are 72 - 3 pi long.
CentrelinePoint bent_angle(double s) {
  constexpr double r = 12, straight = 72 - std::numbers::pi * r / 4, arc = std::numbers::pi * r / 2;
  if (s < straight) return {{0, s - straight - r, 0}, {0, 1, 0}};
  if (s > straight + arc) return {{r + (s - straight - arc), 0, 0}, {1, 0, 0}};
  const double a = (s - straight) / r;
  return {{r - r * std::cos(a), -r + r * std::sin(a), 0}, {std::sin(a), std::cos(a), 0}};
}

TEST(Geometry, CellsKeepTheirArcLengthRoundABend) {
  const Rod rod(angle_marker(5, 12));
  SyntheticFrame frame = plain_frame(1280, 960);
  frame.markers.push_back({&rod, Pose{{}, {-36, 36, 400}}});
  EXPECT_EQ(check_cells(frame, bent_angle, rod.spec().cells), 108);
  frame.markers.assign(1, {&rod, Pose{from_euler_xyz(0.5, -0.6, 1), {-36, 0, 400}}});
  EXPECT_GT(check_cells(frame, bent_angle, rod.spec().cells), 90);
}

TEST(Geometry, StrokesInSpaceKeepTheirCellsToo) {
  for (const double bend : {0.0, 8.0}) {
    // Two right angles out of one plane; a fillet shortens each by 2 r - pi r / 2.
    const double last = 44 + 2 * bend * (2 - std::numbers::pi / 2);
    const MarkerSpec spec{1, "stroke", encode(99, 36),
                          Shape::stroke(36, 4, 3, bend, {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}, {50, 50, last}}), ""};
    const Rod rod(spec);
    SyntheticFrame frame = plain_frame(1280, 960);
    const Quat turn = from_euler_xyz(0.5, 0.6, 0.2);
    frame.markers.push_back({&rod, Pose{turn, Vec3{0, 0, 420} - rotate(turn, {30, 25, 15})}});
    EXPECT_GT(check_cells(
                  frame, [&](double s) { return spec.shape.at(s); }, spec.cells),
              85)
        << bend;
  }
}

TEST(Geometry, TheRodIsAsThickAsItsRadiusSays) {
  const MarkerSpec line{1, "line", encode(5, 36), Shape::line(36, 4, 3), ""};
  const Rod rod(line);
  SyntheticFrame frame = plain_frame(1280, 960);
  frame.background = {};
  frame.effects.supersampling = 4;
  frame.markers.push_back({&rod, Pose{{}, {0, 0, 300}}});
  const SyntheticImage image = render_synthetic(frame);
  // Down the column of the axis the rod's silhouette spans the angle 2 asin(r / d).
  const double expected = 2 * frame.intrinsics.fy * std::tan(std::asin(3.0 / 300));
  double covered = 0;
  for (int y = 0; y < frame.height; ++y) {
    const auto p = pixel(image, 640 + 2, y);
    covered += p[0] + p[1] + p[2] > 40 ? 1 : 0;
  }
  EXPECT_NEAR(covered, expected, 1.1);
}

TEST(Geometry, TheNearerRodHidesTheFarther) {
  const Rod near(angle_marker(3)), far(angle_marker(4));
  SyntheticFrame frame = plain_frame();
  frame.markers.push_back({&far, Pose{{}, {-36, 36, 460}}});
  const int alone = render_synthetic(frame).cells_visible[0];
  frame.markers.push_back({&near, Pose{exp_so3({0, 0, 0.8}), {-36, 36, 360}}});
  const SyntheticImage both = render_synthetic(frame);
  EXPECT_EQ(alone, 36);
  EXPECT_EQ(both.cells_visible[1], 36);
  EXPECT_LT(both.cells_visible[0], 36);
  EXPECT_GT(both.cells_visible[0], 25);
}

TEST(Geometry, AFingerHidesTheCellsBehindItAndNoOthers) {
  const MarkerSpec line{1, "line", encode(5, 36), Shape::line(36, 4, 3), ""};
  const Rod rod(line);
  SyntheticFrame frame = plain_frame(1280, 720);
  frame.markers.push_back({&rod, Pose{{}, {0, 0, 400}}});
  EXPECT_EQ(render_synthetic(frame).cells_visible[0], 36);
  // A finger of radius 8 that stands 12 mm before the rod hides 2 * 8 * 400 / 388 mm of it: four cells whole.
  frame.fingers.push_back({Pose{{}, {0, -30, 388}}, 60, 8});
  const int beside = render_synthetic(frame).cells_visible[0];
  EXPECT_EQ(beside, 32);
  frame.fingers[0].T_camera_finger = Pose{{}, {0, -30, 420}};
  EXPECT_EQ(render_synthetic(frame).cells_visible[0], 36) << "a finger behind the rod hides nothing";
}

TEST(Geometry, CellsOutsideThePictureAreNotVisible) {
  const MarkerSpec line{1, "line", encode(5, 36), Shape::line(36, 4, 3), ""};
  const Rod rod(line);
  SyntheticFrame frame = plain_frame(1280, 720);
  const double half_width = 400 * 640 / frame.intrinsics.fx;
  frame.markers.push_back({&rod, Pose{{}, {half_width, 0, 400}}});
  EXPECT_NEAR(render_synthetic(frame).cells_visible[0], 18, 1);
  frame.markers[0].T_camera_marker = Pose{{}, {0, 0, -400}};
  EXPECT_EQ(render_synthetic(frame).cells_visible[0], 0) << "behind the camera";
}

}  // namespace
}  // namespace onestroke::test

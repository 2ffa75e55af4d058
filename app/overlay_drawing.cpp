#include "app/overlay_drawing.h"

#include "scene/text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr double axis_length = 30;  // mm
constexpr double nearest = 1;       // mm

/// One marker on its way onto the canvas.
class MarkerDrawing {
 public:
  MarkerDrawing(Canvas& canvas, const Intrinsics& intrinsics, const Shape& shape, const MarkerObservation& marker)
      : canvas_(canvas),
        intrinsics_(intrinsics),
        shape_(shape),
        marker_(marker),
        scale_(std::max(1.0, canvas.width() / 1280.0)) {}

  void draw() const {
    for (int i = 0; i <= shape_.cells(); ++i) ring(i * shape_.pitch(), i == 0 || i == shape_.cells());
    outline();
    axes();
    for (int i = 0; i < marker_.cells_seen; ++i) {
      const CellCentre& cell = marker_.cells[static_cast<std::size_t>(i)];
      canvas_.dot(cell.u, cell.v, 2.2 * scale_, {0, 0, 0});
      canvas_.dot(cell.u, cell.v, 1.4 * scale_, {255, 255, 255});
    }
    name();
  }

 private:
  Ink ink() const {
    if (marker_.state == MarkerState::measured) return {255, 255, 255, 0.85};
    if (marker_.state == MarkerState::predicted) return {255, 210, 60, 0.85};
    return {150, 150, 150, 0.85};
  }

  void line(Vec3 from_camera, Vec3 to_camera, double width, Ink ink) const {
    const auto from = pixel_of(intrinsics_, from_camera), to = pixel_of(intrinsics_, to_camera);
    if (from && to) canvas_.line(from->u, from->v, to->u, to->v, width * scale_, ink);
  }

  Vec3 in_camera(Vec3 direction) const { return rotate(marker_.T_camera_marker.rotation, direction); }

  /// The edge between two cells: all of it at a tip, elsewhere the half that faces the camera.
  void ring(double s, bool whole) const {
    constexpr int corners = 24;
    const CentrelinePoint at = shape_.at(s);
    const Vec3 centre = marker_.T_camera_marker * at.position, along = in_camera(at.tangent);
    const Vec3 cut = in_camera(shape_.cut_normal(s));
    const Vec3 across = normalized(cross(along, centre)), up = cross(along, across);
    const auto corner = [&](int i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      const Vec3 out = shape_.radius() * (std::cos(angle) * across + std::sin(angle) * up);
      return centre + out - along * (dot(out, cut) / dot(along, cut));
    };
    for (int i = 0; i < corners; ++i) {
      const Vec3 from = corner(i), to = corner(i + 1), middle = 0.5 * (from + to);
      const Vec3 out = middle - centre - along * dot(middle - centre, along);
      if (whole || dot(out, middle) < 0) line(from, to, 1, ink());
    }
  }

  void outline() const {
    const int steps = 4 * shape_.cells();
    Vec3 sides_before[2];
    for (int i = 0; i <= steps; ++i) {
      const CentrelinePoint at = shape_.at(shape_.length() * i / steps);
      const Vec3 centre = marker_.T_camera_marker * at.position;
      const Vec3 aside = shape_.radius() * normalized(cross(in_camera(at.tangent), centre));
      const Vec3 sides[2] = {centre + aside, centre - aside};
      for (int side = 0; side < 2; ++side) {
        if (i > 0) line(sides_before[side], sides[side], 1.5, ink());
        sides_before[side] = sides[side];
      }
    }
  }

  void axes() const {
    const Vec3 origin = marker_.T_camera_marker.translation;
    line(origin, origin + in_camera({axis_length, 0, 0}), 2.5, {255, 60, 60});
    line(origin, origin + in_camera({0, axis_length, 0}), 2.5, {60, 230, 60});
    line(origin, origin + in_camera({0, 0, axis_length}), 2.5, {90, 130, 255});
  }

  void name() const {
    const auto origin = pixel_of(intrinsics_, marker_.T_camera_marker.translation);
    if (!origin) return;
    Text words;
    const char* state = marker_.state == MarkerState::measured    ? ""
                        : marker_.state == MarkerState::predicted ? ", predicted"
                                                                  : ", lost";
    Text cells;
    if (marker_.second_cells == 0)
      cells.print("%d", marker_.cells_seen);
    else
      cells.print("%d + %d", marker_.cells_seen, std::popcount(marker_.second_cells));
    words.print("%s: %s cells, %.0f mm%s", marker_.name.data(), cells.view().data(),
                norm(marker_.T_camera_marker.translation), state);
    const double height = 15 * scale_, width = Canvas::text_width(height, words.view()), edge = 4 * scale_,
                 gap = 14 * scale_;
    // Outside the corner, where no arm is.
    const Vec3 arms = marker_.T_camera_marker * (0.5 * (shape_.at(0).position + shape_.at(shape_.length()).position));
    const auto inner = pixel_of(intrinsics_, arms);
    const bool to_right = !inner || inner->u <= origin->u, below = !inner || inner->v <= origin->v;
    const double wanted_left = origin->u + (to_right ? gap : -gap - width);
    const double wanted_top = origin->v + (below ? gap : -gap - 1.2 * height);
    const double left = std::clamp(wanted_left, edge, std::max(edge, canvas_.width() - width - edge));
    const double top = std::clamp(wanted_top, edge, std::max(edge, canvas_.height() - 1.5 * height));
    canvas_.box(left - edge, top - edge / 2, left + width + edge, top + 1.2 * height + edge / 2, {0, 0, 0, 0.6});
    canvas_.text(left, top, height, words.view(), ink());
  }

  Canvas& canvas_;
  const Intrinsics& intrinsics_;
  const Shape& shape_;
  const MarkerObservation& marker_;
  const double scale_;
};

}  // namespace

std::optional<Pixel> pixel_of(const Intrinsics& k, Vec3 p) {
  if (p.z < nearest) return {};
  const double x = p.x / p.z, y = p.y / p.z, r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = k.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return Pixel{k.fx * u + k.cx, k.fy * v + k.cy};
}

void draw_overlay(Canvas& canvas, const Intrinsics& intrinsics, const Catalog& catalog, const FrameRecord& record) {
  for (const MarkerObservation& marker : record.seen())
    if (const MarkerSpec* spec = catalog.find(marker.id)) MarkerDrawing(canvas, intrinsics, spec->shape, marker).draw();
}

}  // namespace onestroke

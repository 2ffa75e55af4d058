#include "scene/comparison_words.h"

#include <array>
#include <cmath>

namespace onestroke {

namespace {

// Within 18 degrees of an axis.
constexpr double nearly = 0.95;

const char* along(double component, const char* forward, const char* backward) {
  return component > 0 ? forward : backward;
}

void add_line(ComparisonView& view, const Text& line) {
  view.lines[static_cast<std::size_t>(view.line_count++)] = line;
}

}  // namespace

void print_axis(Vec3 axis, Text& words) {
  if (norm(axis) < 0.5) {
    words.print("about no axis");
  } else if (std::abs(axis.x) > nearly) {
    words.print("about the stop arm, %s", along(axis.x, "+x", "-x"));
  } else if (std::abs(axis.y) > nearly) {
    words.print("about the start arm, %s", along(axis.y, "+y", "-y"));
  } else if (std::abs(axis.z) > nearly) {
    words.print("in the plane of the stick, %s", along(axis.z, "+z", "-z"));
  } else {
    words.print("about (%.2f, %.2f, %.2f)", axis.x, axis.y, axis.z);
  }
}

void print_label(const HeldMarker& held, std::string_view model_name, Time now, Text& words) {
  const char* state = "";
  if (now - held.measured > mentioned_after) state = held.state == MarkerState::lost ? " (lost)" : " (predicted)";
  const char* separator = model_name.empty() ? "" : " · ";
  words.print("%s%s%.*s%s", held.name.data(), separator, static_cast<int>(model_name.size()), model_name.data(), state);
}

void print_hud(ComparisonView& view) {
  view.line_count = 0;
  Text line;
  if (!view.both_visible) {
    const bool one = view[Hand::left].opacity > 0 || view[Hand::right].opacity > 0;
    line.print("%s", one ? "Hold up a second stick to compare" : "Hold up a stick");
    add_line(view, line);
    return;
  }
  const char* leader = view[Hand::right].leads ? "right" : "left";
  if (view.linked)
    line.print("Linked: both show the %s hand's side", leader);
  else
    line.print("Not linked: hold the corners together, or press L");
  add_line(view, line);
  const RelativePose& r = view.relative;
  line.print("Turned %.1f° %.*s", r.angle_deg, static_cast<int>(r.axis_words.view().size()),
             r.axis_words.view().data());
  add_line(view, line);
  line.print("Rotation (X, Y, Z) = (%.1f°, %.1f°, %.1f°)", r.euler_deg.x, r.euler_deg.y, r.euler_deg.z);
  add_line(view, line);
  line.print("Distance %.0f mm", r.distance);
  add_line(view, line);
}

}  // namespace onestroke

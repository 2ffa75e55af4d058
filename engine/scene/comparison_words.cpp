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

void add_link(ComparisonView& view) {
  const char* leader = name_of(view[Hand::right].leads ? Hand::right : Hand::left);
  Text line;
  if (view.mode.link == Link::apart)
    line.print("Side by side: hold the tips together to link, the corners to lay over");
  if (view.mode.link == Link::same) line.print("Linked: both show the %s hand's side", leader);
  if (view.mode.link == Link::mirrored) line.print("Mirrored: both turn as the %s hand's does, in a mirror", leader);
  add_line(view, line);
}

void add_relative(ComparisonView& view) {
  const RelativePose& r = view.relative;
  Text line;
  line.print("Turned %.1f° %.*s", r.angle_deg, static_cast<int>(r.axis_words.view().size()),
             r.axis_words.view().data());
  add_line(view, line);
  line.print("Rotation (X, Y, Z) = (%.1f°, %.1f°, %.1f°)", r.euler_deg.x, r.euler_deg.y, r.euler_deg.z);
  add_line(view, line);
  line.print("Distance %.0f mm", r.distance);
  add_line(view, line);
}

void add_overlay(ComparisonView& view) {
  const char* laid = name_of(other(view.base));
  Text line;
  line.print("Overlay: the %s model on the %s one, %s", laid, name_of(view.base),
             view.mode.tool == Tool::fitted ? "by best fit" : "by their own frames");
  add_line(view, line);
  line.print("%s, part the corners to end",
             view.mode.tool == Tool::fitted ? "Twist back for their own frames" : "Twist a stick for the best fit");
  add_line(view, line);
}

void add_section(ComparisonView& view) {
  Text line;
  line.print("Section: the %s stick's plane cuts %s", name_of(view.pointer),
             view.mode.link == Link::apart ? "the other's model" : "both models alike");
  add_line(view, line);
  line.print("Touch the corner with its red tip again to end");
  add_line(view, line);
}

void add_measure(ComparisonView& view) {
  const MeasureView& m = view.measure;
  Text line;
  if (m.count < 2)
    line.print("Measure: hold the red tip still at a point of the model");
  else if (m.count == 2)
    line.print("Measured %.1f mm", m.distance);
  else
    line.print("Measured %.1f mm, %.1f mm, angle %.1f°", m.distance, m.distance_2, m.angle_deg);
  add_line(view, line);
  const RelativePose& r = view.relative;
  line.print("Sticks: corners %.1f mm apart, turned %.1f°", r.distance, r.angle_deg);
  add_line(view, line);
  line.print("Touch the end tip with the red tip again to end");
  add_line(view, line);
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

void print_label(const HeldMarker& held, std::string_view model_name, bool frozen, Time now, Text& words) {
  const char* state = frozen ? " (frozen)" : "";
  if (!frozen && now - held.measured > mentioned_after)
    state = held.state == MarkerState::lost ? " (lost)" : " (predicted)";
  const char* separator = model_name.empty() ? "" : " · ";
  words.print("%s%s%.*s%s", held.name.data(), separator, static_cast<int>(model_name.size()), model_name.data(), state);
}

void print_hud(ComparisonView& view) {
  view.line_count = 0;
  Text line;
  if (!view.both_visible && view.mode.tool == Tool::none) {
    const bool one = view[Hand::left].opacity > 0 || view[Hand::right].opacity > 0;
    line.print("%s", one ? "Hold up a second stick to compare" : "Hold up a stick");
    add_line(view, line);
    return;
  }
  switch (view.mode.tool) {
    case Tool::none:
      add_link(view);
      add_relative(view);
      return;
    case Tool::overlay:
    case Tool::fitted:
      add_overlay(view);
      return;
    case Tool::section:
      add_section(view);
      return;
    case Tool::measure:
      add_measure(view);
      return;
  }
}

}  // namespace onestroke

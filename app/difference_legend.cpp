#include "app/difference_legend.h"

#include "scene/color_scale.h"

#include <cmath>

namespace onestroke {
namespace {

constexpr int steps = 32;
constexpr double top = 0.3, bottom = 0.7;  // of the area's height
constexpr Color frame_color{0.01F, 0.012F, 0.016F, 1};

double percent_of(double change, double whole) {
  return whole > 0 ? 100 * change / whole : 0;
}

}  // namespace

void DifferenceLegend::draw(SceneBuilder& scene, const HudArea& area, double em, const DifferenceStatistics& statistics,
                            double opacity) {
  if (opacity <= 0) return;
  const double width = 1.1 * em, x = area.width - 0.8 * em - width;
  const double high = top * area.height, low = bottom * area.height, step = (low - high) / steps;
  const double line = std::max(1.0, std::round(0.1 * em));
  scene.boxes.push_back({x - line, high - line, width + 2 * line, low - high + 2 * line, faded(frame_color, opacity)});
  const ColorScale colors(statistics.reach);
  for (int i = 0; i < steps; ++i) {
    const auto [r, g, b] = colors.color(statistics.reach * (1 - 2 * (i + 0.5) / steps));
    scene.boxes.push_back({x, high + i * step, width, step, {r, g, b, static_cast<float>(opacity)}});
  }
  const auto tick = [&](std::size_t i, double y) {
    scene.texts.push_back({.text = ticks_[i].view(),
                           .x = x - 0.4 * em,
                           .y = y,
                           .height_px = em,
                           .pivot_x = 1,
                           .pivot_y = 0.5,
                           .color = faded(Color{}, opacity),
                           .plate = faded(HudText{}.plate, opacity)});
  };
  ticks_[0].print("+%g mm outside", statistics.reach);
  ticks_[1].print("0");
  ticks_[2].print("−%g mm inside", statistics.reach);
  tick(0, high);
  tick(1, (high + low) / 2);
  tick(2, low);
}

void print_statistics(const DifferenceStatistics& s, std::span<Text, 3> lines) {
  lines[0].print("Distance: mean %+.3g, RMS %.3g, 95 %% within %.3g, most %.3g mm", s.mean, s.rms, s.p95, s.most);
  if (s.laid.closed && s.base.closed)
    lines[1].print("Volume %+.3g cm³ (%+.1f %%), area %+.3g cm² (%+.1f %%)", s.volume_change() / 1000,
                   percent_of(s.volume_change(), s.base.volume), s.area_change() / 100,
                   percent_of(s.area_change(), s.base.area));
  else
    lines[1].print("Area %+.3g cm² (%+.1f %%); no volume, a surface is open", s.area_change() / 100,
                   percent_of(s.area_change(), s.base.area));
  lines[2].clear();
  if (s.fit_rms > 0)
    lines[2].print("Best fit: moved %.2f mm, turned %.2f°, RMS %.3g mm", s.moved, s.turned_deg, s.fit_rms);
}

}  // namespace onestroke

#include "growth.h"

#include <array>
#include <cmath>
#include <iomanip>

namespace onestroke::bench {
namespace {

constexpr std::array<const char*, 2> costs{"cold", "following"};

struct Line {
  double fixed, slope;
};

// Least squares.
Line line_through(const RatioReport& report, const Series& series, const char* what) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Series::Step& s : series.steps) {
    const double ms = report.median(what, s.name);
    n += 1;
    x += s.amount;
    y += ms;
    xx += s.amount * s.amount;
    xy += s.amount * ms;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {(y - slope * x) / n, slope};
}

}  // namespace

std::vector<Series> all_series() {
  Series pixels{"pixels", "megapixel", {}}, markers{"markers", "marker", {}}, clutter{"clutter", "", {}};
  for (const auto& [width, height] : {std::pair{640, 480}, {1280, 960}, {1600, 1200}, {2560, 1920}})
    pixels.steps.push_back({std::to_string(width) + " x " + std::to_string(height),
                            {.width = width, .height = height, .tags = false},
                            1e-6 * width * height});
  for (const int n : {1, 2, 4, 8, 16})
    markers.steps.push_back({std::to_string(n) + (n > 1 ? " markers" : " marker"),
                             {.markers = n, .background = Scene::Background::plain, .tags = false, .grid = true},
                             static_cast<double>(n)});
  clutter.steps = {{"plain grey", {.background = Scene::Background::plain, .tags = false}, 0},
                   {"a room", {.background = Scene::Background::room, .tags = false}, 0},
                   {"confetti", {.background = Scene::Background::confetti, .tags = false}, 0}};
  return {pixels, markers, clutter};
}

void print_growth(std::ostream& out, const RatioReport& report, const std::vector<Series>& all) {
  out << std::fixed << std::setprecision(2);
  for (const Series& series : all) {
    bool run = true;
    for (const Series::Step& s : series.steps)
      for (const char* what : costs) run = run && !std::isnan(report.median(what, s.name));
    if (!run) continue;
    out << "\n| " << series.title << " | cold, ms | following, ms |\n|---|---|---|\n";
    for (const Series::Step& s : series.steps) {
      out << "| " << s.name << " |";
      for (const char* what : costs) out << ' ' << report.median(what, s.name) << " |";
      out << '\n';
    }
    if (series.unit.empty()) continue;
    out << "| fixed, and a " << series.unit << " |";
    for (const char* what : costs) {
      const Line line = line_through(report, series, what);
      out << ' ' << line.fixed << " + " << line.slope << " |";
    }
    out << '\n';
  }
}

}  // namespace onestroke::bench

#pragma once

#include "bench_pictures.h"
#include "ratio_report.h"

#include <ostream>
#include <string>
#include <vector>

namespace onestroke::bench {

/// Scenes that differ in one thing only.
struct Series {
  struct Step {
    std::string name;
    Scene scene;
    double amount;  ///< Of what grows.
  };
  std::string title;
  std::string unit;  ///< Of the amount; empty where it is not a number.
  std::vector<Step> steps;
};

/// How the cost grows with pixels, with markers and with clutter.
std::vector<Series> all_series();

/// For each series a Markdown table of the medians of "cold" and "following", and the straight lines nearest to them:
/// a fixed part and a part a unit.
void print_growth(std::ostream& out, const RatioReport& report, const std::vector<Series>& all);

}  // namespace onestroke::bench

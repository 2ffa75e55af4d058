#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace onestroke::bench {

/// The counter in which a benchmark tells the median of single pictures, ms.
inline constexpr const char* median_counter = "median_ms";

/// Prints each benchmark as usual and keeps its median (its only time where there is one repetition): that of
/// single pictures where it tells it.
/// Benchmarks are named "what/picture".
class RatioReport : public benchmark::ConsoleReporter {
 public:
  RatioReport() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Of the pictures that have a yardstick, a Markdown table of the medians, and of how many times each yardstick's
  /// time ours take.
  void print_ratios(const std::vector<std::string>& ours, const std::vector<std::string>& yardsticks) const;
  /// The median of a benchmark that was run, ms; otherwise not a number.
  double median(const std::string& what, const std::string& picture) const;
  bool failed() const { return failed_; }

 private:
  std::map<std::string, std::map<std::string, double>> ms_;  // By picture, by what.
  bool failed_ = false;
};

}  // namespace onestroke::bench

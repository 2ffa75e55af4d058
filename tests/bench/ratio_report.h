#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace onestroke::bench {

/// Prints each benchmark as usual and keeps its median (its only time where there is one repetition).
/// Benchmarks are named "what/picture".
class RatioReport : public benchmark::ConsoleReporter {
 public:
  RatioReport() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;

  /// A Markdown table of the medians, and of how many times each yardstick's time ours take.
  void print_ratios(const std::vector<std::string>& ours, const std::vector<std::string>& yardsticks) const;
  bool failed() const { return failed_; }

 private:
  std::map<std::string, std::map<std::string, double>> ms_;  // By picture, by what.
  bool failed_ = false;
};

}  // namespace onestroke::bench

#include "ratio_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace onestroke::bench {

namespace {

double median_of(const benchmark::BenchmarkReporter::Run& run) {
  const auto counter = run.counters.find(median_counter);
  return counter != run.counters.end() ? counter->second.value : run.GetAdjustedRealTime();
}

}  // namespace

void RatioReport::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    failed_ |= run.error_occurred;
    const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
    if (run.error_occurred || (run.run_type == Run::RT_Aggregate && !median)) continue;
    const std::string& name = run.run_name.function_name;
    const std::size_t slash = name.find('/');
    // Repetitions come before their median, which takes their place.
    ms_[name.substr(slash + 1)][name.substr(0, slash)] = median_of(run);
  }
}

double RatioReport::median(const std::string& what, const std::string& picture) const {
  const auto times = ms_.find(picture);
  if (times == ms_.end() || !times->second.contains(what)) return std::nan("");
  return times->second.at(what);
}

void RatioReport::print_ratios(const std::vector<std::string>& ours, const std::vector<std::string>& yardsticks) const {
  std::ostream& out = GetOutputStream();
  out << std::fixed << "\n| picture | | ms |";
  for (const std::string& y : yardsticks) out << " times " << y << " |";
  out << "\n|---|---|---|";
  for (std::size_t i = 0; i < yardsticks.size(); ++i) out << "---|";
  out << '\n';
  for (const auto& entry : ms_) {
    const auto& times = entry.second;
    if (std::none_of(yardsticks.begin(), yardsticks.end(), [&](const auto& y) { return times.contains(y); })) continue;
    const auto row = [&](const std::string& what) {
      if (!times.contains(what)) return;
      out << "| " << entry.first << " | " << what << " | " << std::setprecision(2) << times.at(what) << " |";
      for (const std::string& y : yardsticks)
        if (times.contains(y))
          out << ' ' << times.at(what) / times.at(y) << " |";
        else
          out << " |";
      out << '\n';
    };
    for (const std::string& what : ours) row(what);
    for (const std::string& what : yardsticks) row(what);
  }
}

}  // namespace onestroke::bench

#include "table.h"

#include "tracking/tracker.h"

#include <iomanip>
#include <ostream>
#include <sstream>

namespace onestroke::accuracy {
namespace {

std::string three(const std::vector<double>& values, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << quantile(values, 0.5) << " / " << quantile(values, 0.95) << " / "
       << quantile(values, 1);
  return text.str();
}

}  // namespace

Score measure(const Catalog& catalog, const std::function<void(const Visit&)>& pictures) {
  Tracker tracker(catalog, {.independent = true});
  FrameRecord record;
  Score score;
  pictures([&](const std::string& name, const Picture& picture, std::span<const Truth> truth) {
    tracker.process(picture, record);
    score.add(name, truth, record);
  });
  return score;
}

void print_table_head(std::ostream& out) {
  out << "| pictures | markers found | false reports | rotation error, degrees (median / 95 % / max) "
         "| distance error, % (median / 95 % / max) | ms a picture (median) |\n"
         "|---|---|---|---|---|---|\n";
}

void print_table_row(std::ostream& out, const std::string& group, const Score& score) {
  std::ostringstream row;
  row << std::fixed << std::setprecision(1) << "| " << group << " (" << score.pictures << ") | " << score.found
      << " of " << score.asked << ", " << score.found_pct() << " % | " << score.wrong.size() << " | "
      << three(score.rotation_deg, 3) << " | " << three(score.distance_pct, 3) << " | " << quantile(score.ms, 0.5)
      << " |\n";
  out << row.str() << std::flush;
}

void print_failures(std::ostream& out, const Score& score) {
  for (const std::string& m : score.missed) out << "missed: " << m << '\n';
  for (const std::string& w : score.wrong) out << "false: " << w << '\n';
}

}  // namespace onestroke::accuracy

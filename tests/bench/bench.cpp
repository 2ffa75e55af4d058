// How long the tracker takes for a picture, and how long other work on the same picture takes.

#include "bench_pictures.h"
#include "growth.h"
#include "ratio_report.h"
#include "tracking/tracker.h"
#include "yardsticks.h"

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <memory>

namespace onestroke::bench {
namespace {

using benchmark::State;

int measured(const FrameRecord& record) {
  const auto seen = record.seen();
  return static_cast<int>(std::count_if(seen.begin(), seen.end(),
                                        [](const MarkerObservation& o) { return o.state == MarkerState::measured; }));
}

// Some pictures take many times as long as most: beside the mean, which the benchmark prints, their median.
class Costs {
 public:
  void add(const FrameRecord& record) { ms_.push_back(record.cost.ms()); }
  void tell(State& state) {
    if (ms_.empty()) return;
    const auto middle = ms_.begin() + static_cast<std::ptrdiff_t>(ms_.size() / 2);
    std::nth_element(ms_.begin(), middle, ms_.end());
    state.counters[median_counter] = *middle;
  }

 private:
  std::vector<double> ms_;
};

// Each picture is older than the one before, so that a tracker that follows starts afresh.
void cold(State& state, const BenchPictures& pictures) {
  Tracker tracker(bench_catalog());
  FrameRecord record;
  Costs costs;
  std::int64_t number = 0;
  for (auto _ : state) {
    Picture picture = pictures.picture(static_cast<std::uint64_t>(number));
    picture.exposure.start = Time{-1'000'000'000 * ++number};
    tracker.process(picture, record);
    costs.add(record);
    if (measured(record) != pictures.scene().markers) state.SkipWithError("a marker was not found");
  }
  costs.tell(state);
}

// A picture that stands alone, searched for whatever can be found in it.
void thorough(State& state, const BenchPictures& pictures) {
  Tracker tracker(bench_catalog(), {.independent = true});
  FrameRecord record;
  std::uint64_t number = 0;
  for (auto _ : state) {
    tracker.process(pictures.picture(number++), record);
    if (measured(record) != pictures.scene().markers) state.SkipWithError("a marker was not found");
  }
}

// The searches of the whole picture for newcomers, every few pictures, are part of it.
void following(State& state, const BenchPictures& pictures) {
  Tracker tracker(bench_catalog());
  FrameRecord record;
  std::uint64_t number = 0;
  for (; number < 8; ++number) tracker.process(pictures.picture(number), record);
  Costs costs;
  for (auto _ : state) {
    tracker.process(pictures.picture(number++), record);
    costs.add(record);
    if (measured(record) != pictures.scene().markers) state.SkipWithError("a marker was lost");
  }
  costs.tell(state);
}

void copying(State& state, const BenchPictures& pictures) {
  std::vector<std::uint8_t> copy(pictures.rgb(0).size());
  std::size_t number = 0;
  for (auto _ : state) {
    std::memcpy(copy.data(), pictures.rgb(number++ % pictures.count()).data(), copy.size());
    benchmark::ClobberMemory();
  }
}

void tags(State& state, const BenchPictures& pictures, Yardstick& yardstick) {
  for (auto _ : state)
    if (yardstick.tags(pictures) != tags_in_sight) state.SkipWithError("not both tags were found");
}

// The pictures of the scene that was asked for last: benchmarks of one scene follow one another.
const BenchPictures& pictures_of(const Scene& scene) {
  static std::unique_ptr<BenchPictures> last;
  if (!last || last->scene() != scene) {
    last.reset();
    last = std::make_unique<BenchPictures>(scene);
  }
  return *last;
}

template <typename Function>
void add(const std::string& what, const std::string& picture, Function function) {
  benchmark::RegisterBenchmark((what + '/' + picture).c_str(), function)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void add_costs(const std::string& name, const Scene& scene) {
  add("cold", name, [=](State& s) { cold(s, pictures_of(scene)); });
  add("following", name, [=](State& s) { following(s, pictures_of(scene)); });
}

void add_all(const std::string& name, const Scene& scene) {
  add_costs(name, scene);
  add("thorough", name, [=](State& s) { thorough(s, pictures_of(scene)); });
  add("memcpy", name, [=](State& s) { copying(s, pictures_of(scene)); });
  add("ArUco", name, [=](State& s) { tags(s, pictures_of(scene), *aruco_yardstick(false)); });
  add("ArUco 3", name, [=](State& s) { tags(s, pictures_of(scene), *aruco_yardstick(true)); });
#ifdef ONESTROKE_WITH_APRILTAG
  add("AprilTag", name, [=](State& s) { tags(s, pictures_of(scene), *april_yardstick()); });
#endif
}

int run(int argc, char** argv) {
  // Medians of seven, unless the command line says otherwise: of two equal options the last counts.
  std::string repetitions = "--benchmark_repetitions=7", aggregates = "--benchmark_report_aggregates_only=true";
  std::vector<char*> arguments{argv[0], repetitions.data(), aggregates.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  // One thread, for them as for us.
  cv::setNumThreads(1);
  add_all("1600x1200", {});
  add_all("1280x800", {.width = 1280, .height = 800, .fov_deg = 60});
  const std::vector<Series> growth = all_series();
  for (const Series& series : growth)
    for (const Series::Step& step : series.steps) add_costs(step.name, step.scene);
  RatioReport report;
  benchmark::RunSpecifiedBenchmarks(&report);
  report.print_ratios({"cold", "thorough", "following"}, {"memcpy", "ArUco", "ArUco 3", "AprilTag"});
  print_growth(report.GetOutputStream(), report, growth);
  return report.failed() ? 1 : 0;
}

}  // namespace
}  // namespace onestroke::bench

int main(int argc, char** argv) {
  return onestroke::bench::run(argc, argv);
}

// How long it takes to measure how far one surface of a million triangles lies from another, and how far off the answer
// is: difference_bench [--triangles=N] [Google Benchmark's options]
#include "difference_scenes.h"
#include "ratio_report.h"

#include <benchmark/benchmark.h>

#include <charconv>
#include <cstring>
#include <iostream>
#include <string_view>

namespace onestroke::bench {
namespace {

using benchmark::State;

constexpr int threads = 2;
constexpr double most_seconds = 10, most_error = 1e-3;  // the error as a share of the models' size
// Points for which every triangle is looked at.
constexpr std::size_t checked = 100, timed = 4;

/// What one scene was measured to be.
struct Outcome {
  double error = 0, brute_error = 0;  // largest, as shares of the models' size
};

void measure_all(State& state, const DifferenceScene& scene, Outcome& outcome) {
  SurfaceDifference difference;
  for (auto _ : state) difference = measure_difference(scene.own, scene.other, glm::dmat4(1), {.threads = threads});
  outcome.error = largest_error(scene, difference) / scene.size;
}

void copy_all(State& state, const DifferenceScene& scene) {
  Surface copy = scene.own;
  for (auto _ : state)
    for (const Surface* surface : {&scene.own, &scene.other}) {
      copy.vertices.resize(surface->vertices.size());
      std::memcpy(copy.vertices.data(), surface->vertices.data(), sizeof(ModelVertex) * copy.vertices.size());
      benchmark::ClobberMemory();
    }
}

/// Without a tree: the distances of a few points, by every triangle.
void look_at_all(State& state, const DifferenceScene& scene) {
  std::size_t next = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i < timed; ++i) {
      next = (next + 7919) % scene.own.vertices.size();
      benchmark::DoNotOptimize(brute_distance(scene.other, position_of(scene.own, next)));
    }
}

/// Independent of formulas and of what facets leave out: the same surfaces, another way.
double largest_brute_error(const DifferenceScene& scene) {
  const SurfaceDifference difference = measure_difference(scene.own, scene.other, glm::dmat4(1), {.threads = threads});
  double largest = 0;
  for (std::size_t i = 0; i < checked; ++i) {
    const std::size_t v = i * 7919 % scene.own.vertices.size();
    const double exact = brute_distance(scene.other, position_of(scene.own, v));
    largest = std::max(largest, std::abs(std::abs(double{difference.distances[v]}) - exact));
  }
  return largest / scene.size;
}

/// Takes --triangles=N out of the arguments.
int take_triangles(std::vector<char*>& arguments) {
  int triangles = 1'000'000;
  std::erase_if(arguments, [&](const char* argument) {
    std::string_view text = argument;
    if (!text.starts_with("--triangles=")) return false;
    text.remove_prefix(12);
    return std::from_chars(text.data(), text.data() + text.size(), triangles).ec == std::errc{} && triangles > 0;
  });
  return triangles;
}

int run(int argc, char** argv) {
  // Of two equal options the last counts.
  std::string repetitions = "--benchmark_repetitions=7", aggregates = "--benchmark_report_aggregates_only=true";
  std::vector<char*> arguments{argv[0], repetitions.data(), aggregates.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  const int triangles = take_triangles(arguments);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  const std::vector<DifferenceScene> scenes{two_balls(triangles), wavy_ball_and_box(triangles)};
  std::vector<Outcome> outcomes(scenes.size());
  const std::string brute = "every triangle, " + std::to_string(timed) + " points";
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto add = [&](const std::string& what, auto function) {
      benchmark::RegisterBenchmark((what + '/' + scenes[i].name).c_str(), function)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
    };
    add("measure", [&, i](State& s) { measure_all(s, scenes[i], outcomes[i]); });
    add("memcpy", [&, i](State& s) { copy_all(s, scenes[i]); });
    add(brute, [&, i](State& s) { look_at_all(s, scenes[i]); });
  }
  RatioReport report;
  benchmark::RunSpecifiedBenchmarks(&report);
  report.print_ratios({"measure"}, {"memcpy", brute});

  std::ostream& out = report.GetOutputStream();
  out << std::scientific << "\n| scene | triangles | seconds, " << threads << " threads | largest error / size | of "
      << checked << " points, to every triangle |\n|---|---|---|---|---|\n";
  bool good = !report.failed();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double seconds = report.median("measure", scenes[i].name) / 1000;
    outcomes[i].brute_error = largest_brute_error(scenes[i]);
    good = good && seconds < most_seconds && std::max(outcomes[i].error, outcomes[i].brute_error) < most_error;
    out << "| " << scenes[i].name << " | " << scenes[i].own.indices.size() / 3 << " and "
        << scenes[i].other.indices.size() / 3 << " | " << seconds << " | " << outcomes[i].error << " | "
        << outcomes[i].brute_error << " |\n";
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace onestroke::bench

int main(int argc, char** argv) {
  return onestroke::bench::run(argc, argv);
}

// How long a frame takes to draw, and how long the least takes that fills the same image; what a frame allocates and
// what many frames leave behind: render_bench [--frames=N] [Google Benchmark's options]
#include "allocation/allocation_counter.h"
#include "ratio_report.h"
#include "render_stage.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <charconv>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <string_view>

namespace onestroke::bench {
namespace {

using benchmark::State;

struct ViewSize {
  int width, height, views;
  std::string name() const {
    const std::string one = std::to_string(width) + "x" + std::to_string(height);
    return views == 1 ? one : std::to_string(views) + " x " + one;
  }
};

constexpr std::array sizes{ViewSize{640, 480, 1}, ViewSize{1280, 720, 1}, ViewSize{1920, 1080, 1}};
constexpr ViewSize stereo{640, 720, 2};
// A model costs the same in each: as many pixels, seen twice.
constexpr std::array model_sizes{sizes[1], stereo};
constexpr std::array formats{std::pair{"rgb", PixelFormat::rgb8}, std::pair{"gray", PixelFormat::gray8},
                             std::pair{"nv12", PixelFormat::nv12}, std::pair{"yuyv", PixelFormat::yuyv}};
constexpr std::array triangle_counts{1'000, 10'000, 50'000, 200'000};
constexpr std::array model_counts{1, 2, 4};
constexpr const char* in_two_passes = " in two passes";

/// One stage a size, made when it is first asked for: the benchmarks take turns.
class Stages {
 public:
  explicit Stages(Gpu& gpu) : gpu_(gpu) {}
  RenderStage& of(const ViewSize& size, bool multiview = true) {
    auto& stage = stages_[size.name() + (multiview ? "" : in_two_passes)];
    if (!stage) stage = std::make_unique<RenderStage>(gpu_, size.width, size.height, size.views, multiview);
    return *stage;
  }

 private:
  Gpu& gpu_;
  std::map<std::string, std::unique_ptr<RenderStage>> stages_;
};

void add(const std::string& what, const ViewSize& size, std::function<void(State&)> function) {
  benchmark::RegisterBenchmark((what + '/' + size.name()).c_str(), std::move(function))
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

/// Frames of one scene, each with a new picture of the views' size.
template <typename SceneOf>
void frames(State& state, RenderStage& stage, const ViewSize& size, PixelFormat format, SceneOf&& scene_of) {
  const BenchPicture picture(size.width, size.height, format);
  const FrameScene scene = scene_of(stage);
  const auto frame = [&] {
    stage.renderer().set_picture(picture.picture());
    stage.draw(scene);
  };
  for (int i = 0; i < 4; ++i) frame();
  for (auto _ : state) frame();
}

FrameScene picture_alone(RenderStage&) {
  return {};
}

void add_floor(Stages& stages, const ViewSize& size) {
  add("cleared", size, [&stages, size](State& state) {
    for (auto _ : state) stages.of(size).floor().clear();
  });
  add("textured triangle", size, [&stages, size](State& state) {
    for (auto _ : state) stages.of(size).floor().draw_texture();
  });
}

void add_passthrough(Stages& stages, const ViewSize& size) {
  add("background", size, [&stages, size](State& state) {
    for (auto _ : state) stages.of(size).draw({.passthrough_distance = {}});
  });
  add("passthrough again", size, [&stages, size](State& state) {
    RenderStage& stage = stages.of(size);
    const BenchPicture picture(size.width, size.height, PixelFormat::rgb8);
    stage.renderer().set_picture(picture.picture());
    for (auto _ : state) stage.draw({});
  });
  for (const auto& [name, format] : formats)
    add(format == PixelFormat::rgb8 ? "passthrough" : std::string("passthrough ") + name, size,
        [&stages, size, format = format](State& state) {
          frames(state, stages.of(size), size, format, picture_alone);
        });
}

std::string name_of(int models, int triangles) {
  return std::to_string(models) + (models == 1 ? " model" : " models") + " of " + std::to_string(triangles / 1000) +
         "k";
}

void add_models(Stages& stages, const ViewSize& size) {
  for (const int models : model_counts)
    for (const int triangles : triangle_counts)
      add(name_of(models, triangles), size, [&stages, size, models, triangles](State& state) {
        frames(state, stages.of(size), size, PixelFormat::rgb8,
               [=](RenderStage& stage) { return stage.scene_of(models, triangles); });
      });
}

/// The same frames without multiview, which a driver may not have: see multiview_probe.h.
void add_two_passes(Stages& stages) {
  const auto two_passes = [&stages](const std::string& what, auto scene_of) {
    add(what + in_two_passes, stereo, [&stages, scene_of](State& state) {
      frames(state, stages.of(stereo, false), stereo, PixelFormat::rgb8, scene_of);
    });
  };
  two_passes("passthrough", picture_alone);
  for (const int triangles : triangle_counts)
    two_passes(name_of(2, triangles), [triangles](RenderStage& stage) { return stage.scene_of(2, triangles); });
}

/// Of this program, MiB, the driver with it.
double resident() {
  std::ifstream in("/proc/self/statm");
  long pages = 0, resident_pages = 0;
  in >> pages >> resident_pages;
  return static_cast<double>(resident_pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Of many warm frames.
struct Endurance {
  int frames = 0;
  long allocations = 0;
  double start = 0, most = 0, end = 0;  // Resident memory, MiB.
};

/// Everything that a frame may hold, many times over.
Endurance endure(Gpu& gpu, int count) {
  RenderStage stage(gpu, 320, 240, 1);
  const BenchPicture rgb(320, 240, PixelFormat::rgb8);
  FrameScene scene = stage.scene_of(2, 1'000);
  const std::array labels{Label{.text = "a label\nof two lines", .position_world = {0, 0, 300}}};
  const std::array lines{Line{.from_world = {0, 0, 300}, .to_world = {50, 0, 300}}};
  const std::array hud{HudText{.text = "words on the screen", .x = 5, .y = 5}};
  const std::array gauges{Gauge{.position_world = {0, 50, 300}, .progress = 0.5}};
  const std::array boxes{HudBox{.x = 5, .y = 50, .width = 10, .height = 20}};
  std::vector<ModelInstance> instances(scene.instances.begin(), scene.instances.end());
  instances.front().clip_plane = ClipPlane{.a = 0, .b = 0, .c = -1, .d = -0.3F};
  instances.front().fill_cut = true;
  scene.instances = instances;
  scene.gauges = gauges;
  scene.boxes = boxes;
  scene.labels = labels;
  scene.lines = lines;
  scene.hud = hud;
  Endurance result{.frames = count};
  const auto frame = [&] {
    const long before = test::allocations_of_this_thread();
    stage.renderer().set_picture(rgb.picture());
    stage.draw(scene);
    result.allocations += test::allocations_of_this_thread() - before;
  };
  for (int i = 0; i < 100; ++i) frame();
  result.allocations = 0;
  result.start = result.most = resident();
  for (int i = 0; i < count; ++i) {
    frame();
    if (i % 100 == 0) result.most = std::max(result.most, resident());
  }
  result.end = resident();
  return result;
}

void print(std::ostream& out, const Endurance& e) {
  out << "\n| warm frames | allocations a frame | resident memory, MiB: start | most | end |\n|---|---|---|---|---|\n| "
      << e.frames << " | " << static_cast<double>(e.allocations) / e.frames << " | " << e.start << " | " << e.most
      << " | " << e.end << " |\n";
}

/// Takes --frames=N out of the arguments.
int take_frames(std::vector<char*>& arguments) {
  int frames = 10'000;
  std::erase_if(arguments, [&](const char* argument) {
    std::string_view text = argument;
    if (!text.starts_with("--frames=")) return false;
    text.remove_prefix(9);
    return std::from_chars(text.data(), text.data() + text.size(), frames).ec == std::errc{} && frames > 0;
  });
  return frames;
}

int run(int argc, char** argv) {
  // Of two equal options the last counts. The rounds of all benchmarks are mixed, so that what else the machine does
  // meets them alike.
  std::array<std::string, 4> usual{"--benchmark_repetitions=7", "--benchmark_report_aggregates_only=true",
                                   "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.1"};
  std::vector<char*> arguments{argv[0]};
  for (std::string& option : usual) arguments.push_back(option.data());
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  const int frames = take_frames(arguments);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  Gpu gpu(GpuOptions{});
  // First, while the program holds little else.
  const Endurance endurance = endure(gpu, frames);
  Stages stages(gpu);
  for (const ViewSize& size : {sizes[0], sizes[1], sizes[2], stereo}) {
    add_floor(stages, size);
    add_passthrough(stages, size);
  }
  for (const ViewSize& size : model_sizes) add_models(stages, size);
  add_two_passes(stages);
  RatioReport report;
  benchmark::RunSpecifiedBenchmarks(&report);
  std::vector<std::string> ours{"background",       "passthrough again", "passthrough gray",
                                "passthrough nv12", "passthrough yuyv",  std::string("passthrough") + in_two_passes};
  for (const int models : model_counts)
    for (const int triangles : triangle_counts) {
      ours.push_back(name_of(models, triangles));
      if (models == 2) ours.push_back(name_of(models, triangles) + in_two_passes);
    }
  report.GetOutputStream() << "\n" << gpu.name() << "\n";
  report.print_ratios(ours, {"passthrough", "textured triangle", "cleared"});
  print(report.GetOutputStream(), endurance);
  return report.failed() ? 1 : 0;
}

}  // namespace
}  // namespace onestroke::bench

int main(int argc, char** argv) {
  try {
    return onestroke::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "render_bench: " << error.what() << "\n";
    return 1;
  }
}

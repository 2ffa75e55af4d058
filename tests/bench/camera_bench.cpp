// From a device's buffer to the poses in the queue: how long a picture takes, and how often its bytes are written on
// the way. The device is a scripted one that plays at its own rate: camera_bench [Google Benchmark's options]

#include "../unit/camera/coded_picture.h"
#include "../unit/camera/scripted_device.h"
#include "bench_pictures.h"
#include "camera/live_camera.h"
#include "ratio_report.h"
#include "tracking/tracking_thread.h"

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <iostream>
#include <numbers>
#include <string>
#include <thread>

namespace onestroke::bench {
namespace {

using benchmark::State;
using test::ScriptedDevice;

/// What a device sends, and how many buffers it has: with many its own memory is lent, with few its pictures are
/// copied.
struct Feed {
  const char* name;
  CaptureCoding coding;
  std::size_t buffers;
};
constexpr std::size_t many = 8, few = 4;
constexpr std::array feeds{
    Feed{"NV12 lent", CaptureCoding::nv12, many},    Feed{"NV12 copied", CaptureCoding::nv12, few},
    Feed{"YUYV lent", CaptureCoding::yuyv, many},    Feed{"YUYV copied", CaptureCoding::yuyv, few},
    Feed{"RGB lent", CaptureCoding::rgb8, many},     Feed{"BGR turned", CaptureCoding::bgr8, few},
    Feed{"MJPEG decoded", CaptureCoding::mjpeg, few}};

constexpr double fov_deg = 62;

class Film {
 public:
  Film(PictureSize size, const Feed& feed)
      : pictures_({.width = size.width, .height = size.height, .fov_deg = fov_deg, .tags = false}),
        size_(size),
        feed_(feed) {
    for (std::size_t i = 0; i < pictures_.count(); ++i)
      coded_.push_back(test::coded(pictures_.rgb(i).data(), size, feed.coding));
  }
  const std::vector<std::uint8_t>& picture(std::uint64_t number) const { return coded_[number % coded_.size()]; }
  ScriptedDevice device() const {
    return ScriptedDevice(test::format_of(size_, feed_.coding), feed_.buffers,
                          3 * static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height));
  }
  std::size_t rgb_bytes() const { return pictures_.rgb(0).size(); }

 private:
  BenchPictures pictures_;
  PictureSize size_;
  Feed feed_;
  std::vector<std::vector<std::uint8_t>> coded_;
};

std::unique_ptr<Camera> open(ScriptedDevice& device) {
  return make_live_camera(device.source(), LensSource({}, fov_deg * std::numbers::pi / 180), {}, {});
}

/// The camera's own part: from the buffer to a picture that can be tracked.
void handing_on(State& state, const Film& film) {
  ScriptedDevice device = film.device();
  const auto camera = open(device);
  std::uint64_t number = 0;
  PictureHandle picture;
  for (auto _ : state) {
    state.PauseTiming();
    picture.reset();
    device.send(film.picture(number), number, Time::now().ns);
    ++number;
    state.ResumeTiming();
    if (camera->next(picture) != Camera::Status::ok) state.SkipWithError("no picture came");
  }
}

void copying(State& state, const Film& film) {
  const std::vector<std::uint8_t> from(film.rgb_bytes());
  std::vector<std::uint8_t> to(film.rgb_bytes());
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), to.size());
    benchmark::ClobberMemory();
  }
}

/// The whole way, at 30 pictures a second, with threads between: half of the pictures take less than the median, one of
/// a hundred more than p99.
void to_the_queue(State& state, const Film& film) {
  constexpr Duration period = Duration::from_ms(1000.0 / 30);
  constexpr std::uint64_t warm = 40;
  ScriptedDevice device = film.device();
  const auto camera = open(device);
  Tracker tracker(bench_catalog());
  TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::newest);
  std::vector<double> ms;
  std::uint64_t number = 0, measured = 0;
  const Time began = Time::now();
  const auto play = [&] {
    const Time due = began + static_cast<std::int64_t>(number) * period;
    std::this_thread::sleep_for(std::chrono::nanoseconds((due - Time::now()).ns));
    const auto& bytes = film.picture(number);
    const Time available = Time::now();
    device.send(bytes, number, due.ns);
    ++number;
    Duration way;
    for (bool got = false; !got && Time::now() - available < Duration::from_seconds(2);) {
      tracking.drain([&](TrackedFrame& frame) {
        way = frame.record.tracked - available;
        measured += frame.record.marker_count == 2;
        frame.picture.reset();
        got = true;
      });
      if (!got) std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return way;
  };
  while (number < warm) play();
  measured = 0;
  for (auto _ : state) {
    const Duration way = play();
    state.SetIterationTime(way.seconds());
    ms.push_back(way.ms());
  }
  if (measured + 1 < ms.size()) state.SkipWithError("a marker was lost");
  std::ranges::sort(ms);
  const double median = ms[ms.size() / 2], p99 = ms[std::min(ms.size() - 1, ms.size() * 99 / 100)];
  state.counters[median_counter] = median;
  state.counters["p99_ms"] = p99;
  state.counters["p99_over_median"] = p99 / median;
}

const Film& film_of(PictureSize size, const Feed& feed) {
  static std::unique_ptr<Film> last;
  static const Feed* of = nullptr;
  static int width = 0;
  if (of != &feed || width != size.width) {
    last.reset();
    last = std::make_unique<Film>(size, feed);
    of = &feed;
    width = size.width;
  }
  return *last;
}

void add(PictureSize size, const Feed& feed) {
  const std::string picture =
      "/" + std::string(feed.name) + " " + std::to_string(size.width) + "x" + std::to_string(size.height);
  benchmark::RegisterBenchmark(("memcpy" + picture).c_str(), [=, &feed](State& s) {
    copying(s, film_of(size, feed));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("handing on" + picture).c_str(), [=, &feed](State& s) {
    handing_on(s, film_of(size, feed));
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("to the queue" + picture).c_str(),
                               [=, &feed](State& s) { to_the_queue(s, film_of(size, feed)); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

int run(int argc, char** argv) {
  std::string repetitions = "--benchmark_repetitions=3";
  std::vector<char*> arguments{argv[0], repetitions.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  cv::setNumThreads(1);
  for (const PictureSize size : {PictureSize{640, 480}, PictureSize{1280, 720}})
    for (const Feed& feed : feeds) add(size, feed);
  RatioReport report;
  benchmark::RunSpecifiedBenchmarks(&report);
  report.print_ratios({"handing on", "to the queue"}, {"memcpy"});
  return report.failed() ? 1 : 0;
}

}  // namespace
}  // namespace onestroke::bench

int main(int argc, char** argv) {
  return onestroke::bench::run(argc, argv);
}

// From the device to the queue nothing is allocated once warm, whatever the device sends.

#include "../tracking/scene_fixture.h"
#include "allocation/allocation_counter.h"
#include "camera/live_camera.h"
#include "coded_picture.h"
#include "scripted_device.h"
#include "tracking/tracking_thread.h"

#include <gtest/gtest.h>

#include <thread>

namespace onestroke::test {
namespace {

class LiveAllocation : public testing::TestWithParam<std::tuple<CaptureCoding, std::size_t>> {};

TEST_P(LiveAllocation, NothingOnceWarm) {
  const auto [coding, buffers] = GetParam();
  const Catalog catalog = catalog_of(3);
  std::vector<std::vector<std::uint8_t>> pictures;
  PictureSize size;
  constexpr int round = 12;
  for (int i = 0; i < round; ++i) {
    const double phase = 2 * std::numbers::pi * i / round;
    const Quat turn = exp_so3({0.1 * std::sin(phase), 0, 0.1 * std::cos(phase)}) * exp_so3({0.3, -0.2, 0.4});
    const Shot shot = shoot({{&catalog.markers[1], about_middle(turn, {4 * std::cos(phase), 0, 420})}});
    const Picture picture = shot.picture(0);
    size = {picture.width, picture.height};
    pictures.push_back(coded(picture.planes[0], size, coding));
  }
  ScriptedDevice device(format_of(size, coding), buffers, 3 * static_cast<std::size_t>(size.width * size.height));
  const auto camera = make_live_camera(device.source(), LensSource({}, 0.6), {}, {});
  Tracker tracker(catalog);
  TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::newest);
  std::size_t got = 0, measured = 0;
  const Time began = Time::now();
  long before = 0;
  constexpr std::uint64_t warm = 130, all = 260;
  constexpr Duration period = Duration::from_ms(33);
  for (std::uint64_t i = 0; i < all; ++i) {
    // What the tracker's first threads and the sending itself need is no part of it.
    if (i == warm) before = allocations_of_all_threads();
    const long sending = allocations_of_this_thread();
    ASSERT_TRUE(device.send(pictures[i % pictures.size()], i, (began + static_cast<std::int64_t>(i) * period).ns));
    before += allocations_of_this_thread() - sending;
    const std::size_t expected = got + 1;
    for (const Time end = Time::now() + Duration::from_seconds(10); got < expected && Time::now() < end;) {
      tracking.drain([&](TrackedFrame& frame) {
        ++got;
        measured += frame.record.marker_count == 1 && frame.record.markers[0].state == MarkerState::measured;
        frame.picture.reset();
      });
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  EXPECT_EQ(allocations_of_all_threads() - before, 0);
  EXPECT_EQ(got, all);
  EXPECT_GT(measured, all - 5);
}

INSTANTIATE_TEST_SUITE_P(Formats, LiveAllocation,
                         testing::Combine(testing::Values(CaptureCoding::yuyv, CaptureCoding::nv12, CaptureCoding::rgb8,
                                                          CaptureCoding::bgr8, CaptureCoding::mjpeg),
                                          testing::Values(std::size_t{4}, std::size_t{8})));

}  // namespace
}  // namespace onestroke::test

// A camera that is started and stopped as often as a program that runs for years does. For ThreadSanitizer.

#include "camera/synthetic_camera.h"
#include "scene_fixture.h"
#include "tracking/tracking_thread.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace onestroke::test {
namespace {

TEST(StartStop, TenThousandTimesAndThePoolNeverGrows) {
  constexpr int cameras = 100, times = 100;
  constexpr std::size_t most_buffers = 7;
  SyntheticOptions options = parse_synthetic_options("width=16,height=16,threads=1,script=still,live=1,fps=1000");
  const Catalog catalog = two_markers();
  Tracker tracker(catalog, {.independent = true});
  int returned = 0;
  for (int i = 0; i < cameras; ++i) {
    options.seed = static_cast<std::uint64_t>(i);
    const auto camera = make_synthetic_camera(options, catalog);
    std::set<const std::uint8_t*> buffers;
    for (int k = 0; k < times; ++k) {
      TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::newest);
      std::size_t got = 0;
      while (got == 0) {
        got = tracking.drain([&](TrackedFrame& frame) {
          buffers.insert(frame.picture->planes[0]);
          frame.picture.reset();
          ++returned;
        });
        if (got == 0) std::this_thread::sleep_for(std::chrono::microseconds(20));
      }
    }
    // Both threads are away, and all has come back.
    std::vector<PictureHandle> all;
    for (PictureHandle picture; camera->next(picture) == Camera::Status::ok; picture.reset()) {
      buffers.insert(picture->planes[0]);
      all.push_back(picture);
    }
    EXPECT_EQ(all.size(), most_buffers);
    EXPECT_EQ(buffers.size(), most_buffers) << "camera " << i;
  }
  EXPECT_GE(returned, cameras * times);
}

}  // namespace
}  // namespace onestroke::test

#include "app/session_options.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

TEST(SessionOptions, FilesAreNamedByTheirWholePaths) {
  const fs::path here = fs::current_path();
  const SessionHeader header = session_header(
      {.source = {.camera = "file:a/../b.mp4", .fov_deg = {}, .calibration = "lens.yaml", .readout_ms = 20},
       .display = {},
       .catalog = "c.json",
       .stereo = true,
       .fingers = false},
      30);
  EXPECT_EQ(header.camera, "file:" + (here / "b.mp4").string());
  EXPECT_EQ(header.calibration, (here / "lens.yaml").string());
  EXPECT_EQ(header.catalog, (here / "c.json").string());
  EXPECT_EQ(header.readout_ms, 20);
  EXPECT_EQ(header.rate, 30);
  EXPECT_TRUE(header.stereo);
  EXPECT_FALSE(header.fingers);
}

TEST(SessionOptions, AReplayIsAsTheLogSays) {
  const SessionHeader header{.camera = "synthetic:noise=2,live=1",
                             .catalog = "/c.json",
                             .fov_deg = 50,
                             .readout_ms = 20,
                             .stereo = true,
                             .fingers = false};
  RunOptions given;
  given.source.camera.clear();
  given.display = "offscreen:again";
  given.frames = 5;
  const RunOptions options = replay_options(header, given);
  EXPECT_EQ(options.source.camera, "synthetic:noise=2,live=0") << "its pictures need no clock any more";
  EXPECT_EQ(options.source.fov_deg, 50);
  EXPECT_EQ(options.source.readout_ms, 20);
  EXPECT_EQ(options.catalog, "/c.json");
  EXPECT_TRUE(options.stereo);
  EXPECT_FALSE(options.fingers);
  EXPECT_EQ(options.display, "offscreen:again");
  EXPECT_EQ(options.frames, 5);
  given.source.camera = "file:other.mp4";
  EXPECT_EQ(replay_options(header, given).source.camera, "file:other.mp4");
}

}  // namespace
}  // namespace onestroke

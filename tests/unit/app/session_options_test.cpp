#include "app/session_options.h"

#include "core/error.h"
#include "session_example.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <optional>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

TEST(SessionOptions, FilesAreNamedByTheirWholePaths) {
  const fs::path here = fs::current_path();
  RunOptions options;
  options.source.camera = "file:a/../b.mp4";
  options.source.calibration = "lens.yaml";
  options.source.readout_ms = 20;
  options.catalog = "c.json";
  options.stereo = true;
  options.fingers = false;
  const SessionHeader header = session_header(options, 30, std::nullopt);
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

TEST(SessionOptions, AReplayHasBothCamerasOfThePair) {
  RunOptions live;
  live.source.camera = "file:l.mp4";
  live.source.second_camera = "synthetic:live=1";
  live.source.rig = "stereo.yml";
  const SessionHeader header = session_header(live, 30, std::nullopt);
  EXPECT_EQ(header.rig, (fs::current_path() / "stereo.yml").string());
  RunOptions given;
  given.source.camera.clear();
  EXPECT_EQ(replay_options(header, given).source.second_camera, "synthetic:live=0");
  EXPECT_EQ(replay_options(header, given).source.rig, header.rig);
  given.source.camera = "file:other.mp4";
  EXPECT_FALSE(replay_options(header, given).source.pair()) << "the other camera's eye is not there";
  given.source.second_camera = "file:other_right.mp4";
  EXPECT_EQ(replay_options(header, given).source.second_camera, "file:other_right.mp4");
  EXPECT_EQ(replay_options(header, given).source.rig, header.rig);
  EXPECT_THROW(replay_options({.camera = "file:l.mp4"}, given), UsageError);
}

class UsualLog : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    if (const char* before = std::getenv("XDG_STATE_HOME")) before_ = before;
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
  }
  void TearDown() override {
    if (before_)
      setenv("XDG_STATE_HOME", before_->c_str(), 1);
    else
      unsetenv("XDG_STATE_HOME");
    FolderTest::TearDown();
  }

 private:
  std::optional<std::string> before_;
};

TEST_F(UsualLog, OfAWindowIsAmongTheSessions) {
  const auto log = open_session_log({}, "window", {});
  ASSERT_NE(log, nullptr);
  EXPECT_EQ(log->file().parent_path(), folder / "onestroke" / "sessions");
  EXPECT_TRUE(fs::exists(log->file()));
}

TEST_F(UsualLog, ThatCannotBeHadCostsAMessage) {
  write("in the way");
  fs::rename(file, folder / "onestroke");
  testing::internal::CaptureStderr();
  EXPECT_EQ(open_session_log({}, "window", {}), nullptr);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, testing::AllOf(testing::HasSubstr("this session is not logged"), testing::HasSubstr("--log none")));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

TEST_F(UsualLog, OfFilesIsAmongThem) {
  const auto log = open_session_log({}, "offscreen:" + folder.string(), {});
  ASSERT_NE(log, nullptr);
  EXPECT_EQ(log->file(), folder / "session.jsonl");
  RunOptions none;
  none.log = "none";
  EXPECT_EQ(open_session_log(none, "offscreen:" + folder.string(), {}), nullptr);
  RunOptions named;
  named.log = (folder / "b.jsonl").string();
  EXPECT_EQ(open_session_log(named, "window", {})->file(), folder / "b.jsonl");
}

}  // namespace
}  // namespace onestroke

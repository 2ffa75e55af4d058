// What the command line says of cameras, recordings and calibrations.

#include "command_line_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

namespace onestroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(CommandLine, SaysHowAConnectedCameraTakesItsPictures) {
  const LiveOptions live = parsed<TrackOptions>(
                               "track --camera libcamera:Logitech --fov 78 --catalog c.db --size 1280x720 --format "
                               "mjpeg --rate 30 --exposure-ms 3.5 "
                               "--gain 4 --white-balance 4500 --clock-offset-ms -12.25")
                               .source.live;
  ASSERT_TRUE(live.size && live.exposure);
  EXPECT_EQ(live.size->width, 1280);
  EXPECT_EQ(live.size->height, 720);
  EXPECT_EQ(live.format, "mjpeg");
  EXPECT_EQ(live.rate, 30);
  EXPECT_EQ(*live.exposure, Duration::from_ms(3.5));
  EXPECT_EQ(live.gain, 4);
  EXPECT_EQ(live.white_balance, 4500);
  EXPECT_EQ(live.clock_offset, Duration::from_ms(-12.25));
  const LiveOptions none = parsed<RunOptions>("run --camera libcamera --fov 60").source.live;
  EXPECT_FALSE(none.size || none.rate || none.exposure || none.gain || none.white_balance);
  EXPECT_EQ(none.format, "");
  EXPECT_THAT(refusal("run --exposure-ms 4"), HasSubstr("--exposure-ms is for a camera that is connected"));
}

TEST(CommandLine, CalibratesTheClockOfACamera) {
  const auto options = parsed<CalibrateOptions>("calibrate camera --clock --camera folder:rec --fov 60 --catalog c.db");
  EXPECT_EQ(options.what, CalibrateOptions::What::clock);
  EXPECT_TRUE(options.recorded);
  EXPECT_FALSE(
      parsed<CalibrateOptions>("calibrate camera --clock --camera libcamera --fov 60 --catalog c.db").recorded);
  EXPECT_EQ(parsed<CalibrateOptions>("calibrate head --replay a.jsonl --output h.json").what,
            CalibrateOptions::What::head);
}

TEST(CommandLine, TwoCamerasAreTwoOrOneThatShowsBoth) {
  const auto run = parsed<RunOptions>("run --camera file:l.mp4 --second-camera file:r.mp4 --rig stereo.yml");
  EXPECT_EQ(run.source.second_camera, "file:r.mp4");
  EXPECT_EQ(run.source.rig, "stereo.yml");
  EXPECT_FALSE(run.source.side_by_side || run.source.baseline_mm);
  EXPECT_TRUE(run.source.pair());
  const auto track =
      parsed<TrackOptions>("track --camera folder:a --side-by-side --baseline-mm 63.5 --fov 90 --catalog c.db");
  EXPECT_TRUE(track.source.side_by_side);
  EXPECT_EQ(track.source.baseline_mm, 63.5);
  EXPECT_TRUE(track.source.pair());
  EXPECT_FALSE(parsed<RunOptions>("run").source.pair());
  EXPECT_EQ(parsed<RunOptions>("run --second-camera synthetic --baseline-mm 64").source.second_camera, "synthetic");
  EXPECT_EQ(parsed<RunOptions>("run --replay a.jsonl --camera file:l --second-camera file:r").source.second_camera,
            "file:r");
}

TEST(CommandLine, HalfAPairIsRefused) {
  for (const auto& [line, what] : std::initializer_list<std::pair<const char*, const char*>>{
           {"run --baseline-mm 64", "--baseline-mm is for two cameras: add --second-camera SPEC or --side-by-side"},
           {"run --rig stereo.yml", "--rig is for two cameras"},
           {"run --second-camera synthetic", "where the second camera sits is unknown: give --rig FILE.yaml or"},
           {"track --camera folder:a --side-by-side --fov 60 --catalog c", "where the second camera sits is unknown"},
           {"run --side-by-side --baseline-mm 64", "give --second-camera synthetic in place of --side-by-side"},
           {"run --camera file:a --second-camera file:b --baseline-mm 64", "the lens of file:a is unknown"},
           {"run --second-camera file:b --baseline-mm 64", "the lens of file:b is unknown"},
           {"run --second-camera synthetic --side-by-side --baseline-mm 64", "--second-camera excludes --side-by-side"},
           {"run --second-camera synthetic --rig a.yml --baseline-mm 64", "--rig excludes --baseline-mm"},
           {"run --second-camera synthetic --baseline-mm 2", "from 5 to 1000 millimetres"},
           {"run --second-camera webcam --baseline-mm 64",
            "must be synthetic[:KEY=VALUE,...], libcamera[:NAME], file:VIDEO"},
           {"run --replay a.jsonl --second-camera file:b", "give --camera with it"},
           {"run --replay a.jsonl --baseline-mm 64", "the log knows how its two cameras sat"}})
    EXPECT_THAT(refusal(line), AllOf(HasSubstr(what), HasSubstr("--help"))) << line;
}

TEST(CommandLine, CalibrateHeadIsLiveOrFromARecording) {
  const auto live = parsed<CalibrateOptions>(
      "calibrate head --camera synthetic:live=1 --catalog c.db --output h.json --seconds 60 --gpu radeon");
  EXPECT_EQ(live.display, "openxr");
  EXPECT_EQ(live.source.camera, "synthetic:live=1");
  EXPECT_EQ(live.output, "h.json");
  EXPECT_EQ(live.seconds, 60);
  EXPECT_TRUE(live.replay.empty() && live.head_poses.empty());
  const auto poses = parsed<CalibrateOptions>(
      "calibrate head --camera folder:a --fov 90 --catalog c.db --head-poses p.jsonl --headset Index --output h.json");
  EXPECT_EQ(poses.head_poses, "p.jsonl");
  EXPECT_EQ(poses.headset, "Index");
  EXPECT_EQ(parsed<CalibrateOptions>("calibrate head --replay a.jsonl --output h.json").replay, "a.jsonl");
  EXPECT_EQ(parsed<RunOptions>("run --head-camera h.json").head_camera, "h.json");
}

TEST(CommandLine, ALensMustBeKnown) {
  for (const std::string command : {"run", "track --catalog c.db"}) {
    for (const std::string camera : {"file:a.mp4", "libcamera"}) {
      const std::string line = command + " --camera " + camera;
      EXPECT_THAT(refusal(line), AllOf(HasSubstr("--fov DEG or --calibration FILE.yaml"), HasSubstr(camera)));
      EXPECT_EQ(refusal(line + " --fov 35"), "accepted");
      EXPECT_EQ(refusal(line + " --calibration lens.yaml"), "accepted");
    }
    EXPECT_EQ(refusal(command + " --camera folder:a"), "accepted") << "it may be a recording, which knows its lens";
  }
}

TEST(CommandLine, RecordingsAreMadeAndPlayed) {
  for (const std::string line : {"run --camera folder:a --loop --from 2.5 --record b",
                                 "track --catalog c.db --camera folder:a --loop --from 2.5 --record b"}) {
    const Command command = parse(line);
    const bool run = std::holds_alternative<RunOptions>(command);
    const SourceOptions& source = run ? std::get<RunOptions>(command).source : std::get<TrackOptions>(command).source;
    EXPECT_TRUE(source.playback.loop);
    EXPECT_EQ(source.playback.from, Duration::from_ms(2500));
    EXPECT_EQ(run ? std::get<RunOptions>(command).record : std::get<TrackOptions>(command).record, "b");
  }
  EXPECT_FALSE(parsed<RunOptions>("run").source.playback.loop);
  EXPECT_EQ(parsed<RunOptions>("run").record, "");
  for (const char* line : {"run --loop", "run --camera libcamera --fov 60 --from 1", "track --catalog c.db --from 1"})
    EXPECT_THAT(refusal(line), HasSubstr("--loop and --from are for recordings"));
  EXPECT_THAT(refusal("run --camera folder:a --from -1"), HasSubstr("from 0 to 1e+06 seconds"));
  for (const std::string known : {"--loop", "--from 1", "--record a", "--head-camera a.json"})
    EXPECT_THAT(refusal("run --replay a.jsonl " + known),
                HasSubstr(known.substr(0, known.find(' ')) + " is for new sessions"));
}

}  // namespace
}  // namespace onestroke

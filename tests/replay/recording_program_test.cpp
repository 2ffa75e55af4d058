// `--record`, and what it wrote played again, by the built program as a person runs it.
#include "shell.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace onestroke {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class RecordingProgram : public ProgramTest {
 protected:
  const std::string hands = "--camera synthetic:script=side,width=640,height=480,fov_deg=50,readout_ms=20 ";
  const std::string catalog = "--catalog " + demo_catalog + " ";

  std::vector<json> lines_of(const std::string& file) const {
    std::vector<json> lines;
    std::istringstream in(read(file));
    for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line));
    return lines;
  }
  /// All but the time that the tracker took, and with its numbers as they are written.
  std::vector<std::string> poses_of(const std::string& file) const {
    std::vector<std::string> poses;
    for (json& line : lines_of(file)) {
      line.erase("ms");
      poses.push_back(line.dump());
    }
    return poses;
  }
};

TEST_F(RecordingProgram, TrackGivesTheSamePosesAgain) {
  const Ended first = run("track " + hands + catalog + "--frames 10 --record rec --output first.jsonl");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "onestroke: wrote 10 pictures, 0 left out, to rec\n");
  const Ended again = run("track --camera folder:rec --catalog rec/catalog.json --output again.jsonl");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  const std::vector<std::string> poses = poses_of("first.jsonl");
  ASSERT_EQ(poses.size(), 10u);
  EXPECT_THAT(poses.back(), HasSubstr("measured"));
  EXPECT_EQ(poses_of("again.jsonl"), poses);
  const Ended part = run("track --camera folder:rec --from 0.2 --loop --frames 6 --output part.jsonl " + catalog);
  EXPECT_EQ(part.code, 0) << part.err;
  std::vector<std::string> images;
  for (const json& line : lines_of("part.jsonl")) images.push_back(line["image"]);
  EXPECT_EQ(images, (std::vector<std::string>{"frame_000006", "frame_000007", "frame_000008", "frame_000009",
                                              "frame_000010", "frame_000011"}));
}

TEST_F(RecordingProgram, RunRecordsWhatItShows) {
  const Ended shown = run("run --camera synthetic:script=side,seconds=0.25,width=640,height=480,fov_deg=50 " + catalog +
                          "--display offscreen:film --record rec");
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, AllOf(HasSubstr("wrote 8 pictures, 0 left out, to rec\n"), HasSubstr("film.mp4")));
  const Ended again = run("run --camera folder:rec --catalog rec/catalog.json --display offscreen:again --loop");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("film.mp4, 8 frames")) << "of what begins again, files have one round";
  const std::vector<json> first = lines_of("film/session.jsonl"), second = lines_of("again/session.jsonl");
  ASSERT_EQ(first.size(), 9u);
  ASSERT_EQ(second.size(), 9u);
  for (std::size_t i = 1; i < first.size(); ++i)
    EXPECT_EQ(first[i]["record"]["markers"], second[i]["record"]["markers"]);
  const Ended replayed = run("run --replay again/session.jsonl --display offscreen:replayed");
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(replayed.err, "") << "no picture is missing";
  EXPECT_EQ(read("again/frame_000005.png"), read("replayed/frame_000005.png"));
}

TEST_F(RecordingProgram, SaysWhatIsWrong) {
  write("taken", "a file");
  const Ended file = run("track " + hands + catalog + "--frames 1 --record taken");
  EXPECT_EQ(file.code, 1);
  EXPECT_THAT(file.err, HasSubstr("taken is no folder"));
  const Ended full = run("track " + hands + catalog + "--frames 1 --record /proc/rec");
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.err, HasSubstr("/proc/rec cannot be made"));
  ASSERT_EQ(run("track " + hands + catalog + "--frames 1 --record rec").code, 0);
  const Ended twice = run("track " + hands + catalog + "--frames 1 --record rec");
  EXPECT_EQ(twice.code, 1);
  EXPECT_THAT(twice.err, HasSubstr("folder rec is not empty"));
  const Ended lens = run("track --camera folder:. " + catalog);
  EXPECT_EQ(lens.code, 2);
  EXPECT_THAT(lens.err, HasSubstr("give --fov DEG or --calibration FILE.yaml"));
  for (const Ended& ended : {file, full, twice, lens}) EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
}

TEST_F(RecordingProgram, AFullDiskEndsTheRecordingAndNotTheTracking) {
  const Ended ended =
      run("track " + hands + catalog + "--frames 6 --record rec --output poses.jsonl", "ulimit -f 1200; trap '' XFSZ;");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("the recording ends early: cannot write rec/pictures.mkv"),
                               HasSubstr("left out, to rec")));
  EXPECT_EQ(lines_of("poses.jsonl").size(), 6u);
  EXPECT_EQ(run("track --camera folder:rec " + catalog + "--output again.jsonl").code, 0);
  const std::size_t kept = lines_of("again.jsonl").size();
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, 6u);
}

TEST_F(RecordingProgram, EndedByForceItCanBeRead) {
  run("track " + hands + "--catalog " + demo_catalog + " --record rec --output poses.jsonl", "timeout -s KILL 2");
  const Ended again = run("track --camera folder:rec --output again.jsonl " + catalog);
  EXPECT_EQ(again.code, 0) << again.err;
  const std::vector<std::string> first = poses_of("poses.jsonl"), second = poses_of("again.jsonl");
  ASSERT_GT(second.size(), 3u);
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) EXPECT_EQ(first[i], second[i]);
}

TEST_F(RecordingProgram, EndsInGoodOrderWhenInterrupted) {
  const Ended ended = run("track " + hands + catalog + "--record rec --output poses.jsonl", "timeout -s INT 2");
  EXPECT_EQ(ended.code, 124) << "timeout's own";
  EXPECT_THAT(ended.err, HasSubstr("0 left out, to rec"));
  EXPECT_EQ(lines_of("poses.jsonl").size(), lines_of("rec/pictures.jsonl").size());
}

}  // namespace
}  // namespace onestroke

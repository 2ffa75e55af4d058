// `onestroke track`, the built program as a person runs it.
#include "golden/comparator.h"
#include "shell.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace onestroke {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line));
  return lines;
}

/// What two runs have in common: all but the time that the tracker took.
std::vector<json> without_cost(std::vector<json> lines) {
  for (json& line : lines) line.erase("ms");
  return lines;
}

class TrackProgram : public ProgramTest {
 protected:
  const std::string stick = "track --camera synthetic:script=turn_z,width=640,height=480,fov_deg=35 --catalog " +
                            demo_catalog + " --independent --frames 6 ";
};

TEST_F(TrackProgram, TellsWhatTwoCamerasSeeTogether) {
  const Ended ended = run(stick + "--second-camera synthetic --baseline-mm 64 --output poses.jsonl");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::vector<json> lines = lines_of(read("poses.jsonl"));
  ASSERT_EQ(lines.size(), 6u);
  for (const json& line : lines) {
    ASSERT_EQ(line["markers"].size(), 1u);
    const json& marker = line["markers"][0];
    EXPECT_EQ(marker["state"], "measured");
    EXPECT_GT(marker["cells_seen"].get<int>(), 30);
    EXPECT_GT(marker["second_cells"].size(), 30u);
  }
  const Ended alone = run("track --camera folder:nowhere --side-by-side --fov 60 --catalog " + demo_catalog);
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.err, HasSubstr("where the second camera sits is unknown"));
}

TEST_F(TrackProgram, WritesALineAndADrawingAPicture) {
  const Ended ended = run(stick + "--output poses.jsonl --overlay drawn");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err, "");
  const std::vector<json> lines = lines_of(read("poses.jsonl"));
  ASSERT_EQ(lines.size(), 6u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string name = "frame_00000" + std::to_string(i);
    EXPECT_EQ(lines[i]["image"], name);
    EXPECT_EQ(lines[i]["time_ns"], std::lround(static_cast<double>(i) / 30 * 1e9));
    EXPECT_GT(lines[i]["ms"].get<double>(), 0);
    const json& markers = lines[i]["markers"];
    ASSERT_EQ(markers.size(), 1u) << "picture " << i;
    EXPECT_EQ(markers[0]["id"], 1);
    EXPECT_EQ(markers[0]["name"], "bracket v1");
    EXPECT_EQ(markers[0]["state"], "measured");
    EXPECT_EQ(markers[0]["covariance"].size(), 36u);
    EXPECT_EQ(markers[0]["cell_centres"].size(), markers[0]["cells_seen"].get<std::size_t>());
    EXPECT_GT(markers[0]["cells_seen"].get<int>(), 30);
    // The script turns the stick by 6 degrees a picture about the camera's axis.
    const auto r = markers[0]["R"].get<std::vector<std::vector<double>>>();
    const double turned = std::atan2(r[1][0], r[0][0]) * 180 / std::numbers::pi;
    EXPECT_NEAR(turned, 6.0 * static_cast<double>(i), 0.5);
    const golden::Picture drawn = golden::read_png(folder / "drawn" / (name + ".png"));
    EXPECT_EQ(drawn.width, 640);
    EXPECT_EQ(drawn.height, 480);
  }
}

TEST_F(TrackProgram, ReadsItsOwnPicturesBackFromAFolder) {
  // Drawn over, yet pictures; what matters is their names, their order and that they are not overwritten.
  ASSERT_EQ(run(stick + "--output poses.jsonl --overlay drawn").code, 0);
  const std::string folder_camera = "track --camera folder:drawn --fov 35 --independent --catalog " + demo_catalog;
  const Ended ended = run(folder_camera + " --frames 3");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::vector<json> lines = lines_of(ended.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[2]["image"], "frame_000002.png");
  const Ended onto_itself = run(folder_camera + " --overlay drawn/../drawn");
  EXPECT_EQ(onto_itself.code, 2);
  EXPECT_THAT(onto_itself.err, HasSubstr("another folder"));
}

TEST_F(TrackProgram, ThreadsChangeNothingButTheTime) {
  const Ended one = run(stick), three = run(stick + "--threads 3");
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(three.code, 0) << three.err;
  EXPECT_EQ(without_cost(lines_of(one.out)), without_cost(lines_of(three.out)));
}

TEST_F(TrackProgram, FollowsMarkersUnlessEachPictureStandsAlone) {
  const Ended ended =
      run("track --camera synthetic:script=turn_z,width=640,height=480,fov_deg=35,step_deg=2 --catalog " +
          demo_catalog + " --frames 4");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const json& line : lines_of(ended.out)) EXPECT_EQ(line["markers"].size(), 1u);
}

TEST_F(TrackProgram, SaysWhatIsWrong) {
  const Ended usage = run("track --threads 2 --catalog " + demo_catalog);
  EXPECT_EQ(usage.code, 2);
  EXPECT_THAT(usage.err, AllOf(HasSubstr("--independent"), HasSubstr("onestroke track --help")));
  EXPECT_EQ(run("track --camera synthetic:colour=red --catalog " + demo_catalog).code, 2);
  const Ended missing = run("track --catalog none.json");
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("none.json cannot be read"));
  EXPECT_EQ(run(stick + "--output none/poses.jsonl").code, 1);
  const Ended full = run(stick + "--output /dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.err, AllOf(HasSubstr("/dev/full"), HasSubstr("the disk is not full")));
  write("taken", "a file");
  const Ended overlay = run(stick + "--overlay taken");
  EXPECT_EQ(overlay.code, 1);
  EXPECT_THAT(overlay.err, HasSubstr("folder taken cannot be made"));
}

TEST_F(TrackProgram, KeepsWhatItWroteWhenTheCameraFails) {
  ASSERT_EQ(run(stick + "--overlay pictures").code, 0);
  write("pictures/frame_000004.png", "no picture");
  const Ended ended =
      run("track --camera folder:pictures --fov 35 --independent --catalog " + demo_catalog + " --output poses.jsonl");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("frame_000004.png"));
  EXPECT_EQ(lines_of(read("poses.jsonl")).size(), 4u);
}

TEST_F(TrackProgram, AMistypedCameraLeavesTheOldOutputAlone) {
  write("poses.jsonl", "precious\n");
  EXPECT_EQ(run("track --camera folder:none --fov 35 --output poses.jsonl --catalog " + demo_catalog).code, 1);
  EXPECT_EQ(read("poses.jsonl"), "precious\n");
}

}  // namespace
}  // namespace onestroke

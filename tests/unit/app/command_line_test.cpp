#include "command_line_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

namespace onestroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(CommandLine, RunAloneIsTheDemo) {
  const auto run = parsed<RunOptions>("run");
  EXPECT_EQ(run.source.camera, "synthetic");
  EXPECT_EQ(run.display, "");
  EXPECT_TRUE(run.catalog.empty());
  EXPECT_EQ(run.gpu, "");
  EXPECT_FALSE(run.stereo);
  EXPECT_TRUE(run.fingers);
  EXPECT_TRUE(run.mirror);
  EXPECT_EQ(run.mode, PictureTime::exposure);
  EXPECT_FALSE(run.source.fov_deg || run.source.readout_ms || run.frames || run.seconds);
}

TEST(CommandLine, RunTakesEveryOption) {
  const auto run = parsed<RunOptions>(
      "run --camera file:a.mp4 --fov 62.5 --readout-ms 16.6 --display offscreen:film --stereo --no-mirror --no-fingers "
      "--catalog "
      "c.db --gpu radeon "
      "--mode fresh "
      "--frames 300 --seconds 2.5");
  EXPECT_EQ(run.source.camera, "file:a.mp4");
  EXPECT_EQ(run.source.fov_deg, 62.5);
  EXPECT_EQ(run.source.readout_ms, 16.6);
  EXPECT_EQ(run.display, "offscreen:film");
  EXPECT_EQ(run.catalog, "c.db");
  EXPECT_EQ(run.gpu, "radeon");
  EXPECT_TRUE(run.stereo);
  EXPECT_FALSE(run.mirror);
  EXPECT_FALSE(run.fingers);
  EXPECT_EQ(run.mode, PictureTime::fresh);
  EXPECT_EQ(run.frames, 300);
  EXPECT_EQ(run.seconds, 2.5);
}

TEST(CommandLine, RunAsksAHeadsetForAWorld) {
  EXPECT_EQ(parsed<RunOptions>("run --display openxr").world, World::automatic);
  for (std::size_t i = 0; i < world_names.size(); ++i)
    EXPECT_EQ(parsed<RunOptions>("run --display openxr --world " + std::string(world_names[i])).world,
              static_cast<World>(i));
  for (const char* line : {"run --world alpha", "run --world alpha --display window"})
    EXPECT_THAT(refusal(line), HasSubstr("--world alpha is for a headset alone: add --display openxr; see"));
}

TEST(CommandLine, RunWaitsForAHeadset) {
  EXPECT_FALSE(parsed<RunOptions>("run --display openxr").wait);
  EXPECT_TRUE(parsed<RunOptions>("run --display openxr --wait").wait);
}

TEST(CommandLine, RunWritesASessionDownOrShowsItAgain) {
  EXPECT_EQ(parsed<RunOptions>("run").log, "");
  EXPECT_EQ(parsed<RunOptions>("run --log none").log, "none");
  EXPECT_TRUE(parsed<RunOptions>("run --log a.jsonl").replay.empty());
  const auto again = parsed<RunOptions>("run --replay a.jsonl --display offscreen:a --gpu 1 --frames 3 --seconds 2");
  EXPECT_EQ(again.replay, "a.jsonl");
  EXPECT_EQ(again.source.camera, "") << "the log knows";
  EXPECT_EQ(parsed<RunOptions>("run --replay a.jsonl --camera file:b.mp4").source.camera, "file:b.mp4");
  for (const std::string fixed : {"--fov 60", "--calibration l.yaml", "--readout-ms 3", "--world camera", "--stereo",
                                  "--no-fingers", "--catalog c.db", "--mode fresh", "--log b.jsonl"})
    EXPECT_THAT(refusal("run --replay a.jsonl " + fixed),
                AllOf(HasSubstr(fixed.substr(0, fixed.find(' ')) + " excludes --replay"), HasSubstr("run --help")));
}

TEST(CommandLine, TrackTakesEveryOption) {
  const auto track = parsed<TrackOptions>(
      "track --camera=folder:a,b=c:d --calibration lens.yaml --readout-ms 0 --catalog c.json --output p.jsonl "
      "--overlay o "
      "--independent --threads 4 --frames 7");
  EXPECT_EQ(track.source.camera, "folder:a,b=c:d");
  EXPECT_EQ(track.source.calibration, "lens.yaml");
  EXPECT_EQ(track.source.readout_ms, 0);
  EXPECT_EQ(track.catalog, "c.json");
  EXPECT_EQ(track.output, "p.jsonl");
  EXPECT_EQ(track.overlay, "o");
  EXPECT_TRUE(track.independent);
  EXPECT_EQ(track.threads, 4);
  EXPECT_EQ(track.frames, 7);
}

TEST(CommandLine, TrackHasDefaults) {
  const auto track = parsed<TrackOptions>("track --catalog c.db");
  EXPECT_EQ(track.source.camera, "synthetic");
  EXPECT_TRUE(track.output.empty());
  EXPECT_TRUE(track.overlay.empty());
  EXPECT_FALSE(track.independent);
  EXPECT_EQ(track.threads, 1);
}

TEST(CommandLine, LeavesTheSyntheticCamerasOptionsToIt) {
  const std::string camera = "synthetic:noise=2,blur=1,readout_ms=20,fingers=1,width=1280,height=720,seed=3";
  EXPECT_EQ(parsed<RunOptions>("run --camera " + camera).source.camera, camera);
}

TEST(CommandLine, MarkerActions) {
  using Action = MarkerOptions::Action;
  const auto import = parsed<MarkerOptions>("marker import in.json --catalog c.db --replace");
  EXPECT_EQ(import.action, Action::import);
  EXPECT_EQ(import.input, "in.json");
  EXPECT_EQ(import.catalog, "c.db");
  EXPECT_TRUE(import.replace);
  EXPECT_FALSE(parsed<MarkerOptions>("marker import --catalog c.db in.json").replace);
  const auto write = parsed<MarkerOptions>("marker export --catalog c.db --output out.json");
  EXPECT_EQ(write.action, Action::export_);
  EXPECT_EQ(write.output, "out.json");
  EXPECT_TRUE(parsed<MarkerOptions>("marker export --catalog c.db").output.empty());
  EXPECT_EQ(parsed<MarkerOptions>("marker list --catalog c.db").action, Action::list);
  const auto show = parsed<MarkerOptions>("marker show m03 --catalog c.db");
  EXPECT_EQ(show.action, Action::show);
  EXPECT_EQ(show.which, "m03");
}

TEST(CommandLine, RefusesInOneLineWithARemedy) {
  const char* wrong[] = {"",
                         "bla",
                         "run run",
                         "run --bla",
                         "run --camera",
                         "run --camera webcam",
                         "run --camera file:",
                         "run --camera synthetic:",
                         "run --display offscreen",
                         "run --display window:2",
                         "run --display openxr:2",
                         "run --display openxr --world",
                         "run --display openxr --world blue",
                         "run --world auto",
                         "run --wait",
                         "run --display window --wait",
                         "run --gpu",
                         "run --gpu=",
                         "run --mode slow",
                         "run --frames 0",
                         "run --frames 1.5",
                         "run --frames 99999999999",
                         "run --seconds 0",
                         "run --seconds -1",
                         "run --fov 0",
                         "run --fov nan",
                         "run --fov 180",
                         "run --fov 35deg",
                         "run --readout-ms -1",
                         "run --readout-ms inf",
                         "run --fov 35 --calibration lens.yaml",
                         "run --fov 35 --fov 36",
                         "track",
                         "track --catalog c.db --threads 0",
                         "track --catalog c.db --threads 2",
                         "track --catalog c.db --display window",
                         "marker",
                         "marker bla",
                         "marker list",
                         "marker import --catalog c.db",
                         "marker show --catalog c.db",
                         "marker list more --catalog c.db",
                         "calibrate",
                         "calibrate bla",
                         "calibrate head",
                         "calibrate head --output h.json --catalog c.db",
                         "calibrate head --output h.json --camera synthetic",
                         "calibrate head --output h.json --camera file:a.mp4 --catalog c.db",
                         "calibrate head --output h.json --camera synthetic --catalog c.db --headset Index",
                         "calibrate head --output h.json --camera synthetic --catalog c.db --display window",
                         "calibrate head --output h.json --replay a.jsonl --camera synthetic",
                         "calibrate head --output h.json --replay a.jsonl --seconds 3",
                         "calibrate head --replay a.jsonl",
                         "calibrate camera",
                         "calibrate camera --camera synthetic --catalog c.db",
                         "calibrate camera --clock --camera synthetic",
                         "calibrate camera --clock --catalog c.db",
                         "calibrate camera --clock --camera libcamera --catalog c.db",
                         "run --camera synthetic --exposure-ms 4",
                         "run --camera file:a.mp4 --fov 60 --size 640x480",
                         "track --camera folder:a --fov 60 --catalog c.db --clock-offset-ms 3",
                         "run --camera libcamera",
                         "run --camera libcamera --fov 60 --size 640",
                         "run --camera libcamera --fov 60 --size 640x480x3",
                         "run --camera libcamera --fov 60 --size 0x480",
                         "run --camera libcamera --fov 60 --format grey",
                         "run --camera libcamera --fov 60 --exposure-ms 0",
                         "run --camera libcamera: --fov 60",
                         "doctor more",
                         "run --replay a.jsonl --head-camera h.json",
                         "--completion fish"};
  for (const char* line : wrong) {
    const std::string message = refusal(line);
    EXPECT_THAT(message, HasSubstr("; see `onestroke")) << line;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(CommandLine, DoctorSpeaksTextOrJson) {
  EXPECT_FALSE(parsed<DoctorOptions>("doctor").json);
  EXPECT_TRUE(parsed<DoctorOptions>("doctor --json").json);
}

TEST(CommandLine, RefusalsNameTheThing) {
  EXPECT_THAT(refusal(""), HasSubstr("run, track, marker, calibrate or doctor"));
  EXPECT_THAT(refusal("run --bla"), AllOf(HasSubstr("--bla"), HasSubstr("`onestroke run --help`")));
  EXPECT_THAT(refusal("run --camera webcam"), AllOf(HasSubstr("\"webcam\""), HasSubstr("file:VIDEO")));
  EXPECT_THAT(refusal("run --fov 180"), AllOf(HasSubstr("--fov"), HasSubstr("from 1 to 170 degrees")));
  EXPECT_THAT(refusal("track"), HasSubstr("--catalog is required; see `onestroke track --help`"));
  EXPECT_THAT(refusal("marker"), HasSubstr("import, export, list or show"));
}

TEST(CommandLine, HelpTeaches) {
  EXPECT_THAT(printed("--help"), AllOf(HasSubstr("Examples:"), HasSubstr("Units:"), HasSubstr("Exit codes:")));
  EXPECT_THAT(printed("run --help"), AllOf(HasSubstr("onestroke run --camera"), HasSubstr("Default: exposure"),
                                           HasSubstr("--gpu NAME|NUMBER"), HasSubstr("Keys")));
  EXPECT_THAT(printed("track --help"), HasSubstr("p_camera = R p_marker + t"));
  EXPECT_THAT(printed("marker --help"), HasSubstr("onestroke marker import"));
  EXPECT_THAT(printed("marker import --help"), HasSubstr("--replace"));
  EXPECT_THAT(printed("calibrate head --help"), HasSubstr("Lay a marker down"));
  for (const char* line : {"--help", "run --help", "track --help", "marker --help", "marker show --help",
                           "calibrate --help", "calibrate head --help", "doctor --help"}) {
    std::istringstream lines(printed(line));
    for (std::string text; std::getline(lines, text);) EXPECT_LE(text.size(), 125u) << text;
  }
}

TEST(CommandLine, ExamplesOfTheHelpAreAccepted) {
  int examples = 0;
  for (const char* command : {"--help", "run --help", "track --help", "marker --help", "calibrate head --help"}) {
    std::istringstream lines(printed(command));
    for (std::string line; std::getline(lines, line);) {
      const std::string start = "  onestroke ";
      if (!line.starts_with(start)) continue;
      line.erase(0, start.size());
      line.erase(std::min(line.size(), line.find("   ")));
      EXPECT_EQ(refusal(line), "accepted") << line;
      ++examples;
    }
  }
  EXPECT_GE(examples, 14);
}

TEST(CommandLine, VersionIsOneLine) {
  EXPECT_THAT(printed("--version"), testing::MatchesRegex("onestroke [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

/// What bash offers after these words; the last is what has been typed so far of the next.
std::string offered(const std::string& words, int last) {
  const std::string file = testing::TempDir() + "onestroke-completion.bash";
  std::ofstream(file) << printed("--completion bash") << "COMP_WORDS=(" << words << ")\nCOMP_CWORD=" << last
                      << "\n_onestroke\necho \"${COMPREPLY[@]}\"\n";
  const std::unique_ptr<FILE, int (*)(FILE*)> shell(popen(("bash " + file).c_str(), "r"), pclose);
  std::string text;
  for (int c = std::fgetc(shell.get()); c != EOF && c != '\n'; c = std::fgetc(shell.get()))
    text += static_cast<char>(c);
  return text;
}

TEST(CommandLine, CompletesInBash) {
  EXPECT_EQ(offered("onestroke ''", 1), "run track marker calibrate doctor --help --version --completion");
  EXPECT_EQ(offered("onestroke tr", 1), "track");
  EXPECT_EQ(offered("onestroke track --o", 2), "--output --overlay");
  EXPECT_EQ(offered("onestroke marker ''", 2), "import export list show --help");
  EXPECT_EQ(offered("onestroke marker import --r", 3), "--replace");
  EXPECT_EQ(offered("onestroke calibrate ''", 2), "head camera --help");
  EXPECT_EQ(offered("onestroke calibrate head --head", 3), "--head-poses --headset");
  EXPECT_EQ(offered("onestroke doctor --j", 2), "--json");
  EXPECT_EQ(offered("onestroke run --g", 2), "--gain --gpu");
  EXPECT_EQ(offered("onestroke run --no-m", 2), "--no-mirror");
  EXPECT_EQ(offered("onestroke track --re", 2), "--readout-ms --record");
  EXPECT_EQ(offered("onestroke run --mode f", 3), "fresh");
  EXPECT_EQ(offered("onestroke run --camera f", 3), "file: folder:");
  EXPECT_EQ(offered("onestroke run --camera file : /etc/host", 5).substr(0, 9), "/etc/host");
}

}  // namespace
}  // namespace onestroke

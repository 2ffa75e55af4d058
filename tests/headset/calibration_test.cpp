// The whole way of `onestroke calibrate head`: a program of its own, before a head that looks round a stick that lies
// still.
#include "scripted_head.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace onestroke {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Slowly to and fro about all three axes, the stick in sight.
Pose looking_round(double seconds) {
  const Vec3 turned{0.2 * std::sin(turn * seconds / 7), 0.3 * std::sin(turn * seconds / 11),
                    0.25 * std::sin(turn * seconds / 9)};
  return {exp_so3(turned), {80 * std::sin(turn * seconds / 8), -1600 + 40 * std::sin(turn * seconds / 6), 0}};
}

// The synthetic camera sits where the head is, and is to be found there.
TEST(LiveCalibration, FindsTheCameraOnAMovingHead) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / ("onestroke-calibration-" + std::to_string(getpid()));
  fs::create_directories(folder);
  ScriptedHead head(looking_round);
  head.move();
  const std::string command =
      "XDG_CONFIG_HOME=" + folder.string() + " timeout 120 " + std::getenv("MONADO_RUN") +
      " " ONESTROKE_PROGRAM
      " calibrate head --display openxr --camera synthetic:script=still,distance=400,live=1,fps=15 --catalog " +
      ONESTROKE_SOURCE_DIR "/assets/catalog.json --output " + (folder / "head.json").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(folder / "head.json");
  const auto found = nlohmann::json::parse(file);
  const auto T = found.at("T_head_camera").get<std::vector<double>>();
  ASSERT_EQ(T.size(), 7U);
  EXPECT_LT(std::hypot(T[4], T[5], T[6]), 2) << "mm";
  EXPECT_LT(angle_between({T[0], T[1], T[2], T[3]}, {}), 0.005) << "rad";
  EXPECT_EQ(found.at("headset"), "Monado: Remote HMD");
  EXPECT_TRUE(fs::exists(folder / "onestroke" / "headsets.json"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace onestroke

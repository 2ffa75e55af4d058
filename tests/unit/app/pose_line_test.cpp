#include "app/pose_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace onestroke {
namespace {

using Json = nlohmann::ordered_json;

FrameRecord record_of_one() {
  FrameRecord record;
  record.time = {123'456'789'012'345};
  record.cost = {3'123'456};
  record.marker_count = 1;
  MarkerObservation& m = record.markers[0];
  m.id = 3;
  std::strcpy(m.name.data(), "m03");
  m.state = MarkerState::measured;
  m.T_camera_marker = {exp_so3({0.1, -0.7, 2.0 / 3}), {1.0 / 3, -20, 450.25}};
  for (std::size_t i = 0; i < 36; ++i) m.covariance[i] = 1e-7 * static_cast<double>(i);
  m.velocity = {{0.5, 0, -2}, {10, 20, 30}};
  m.cells_seen = 2;
  m.cells[0] = {4, 100.5, 200.25};
  m.cells[1] = {5, 104.1, 0.1};
  return record;
}

TEST(PoseLine, NamesTheCellsThatTheSecondCameraSees) {
  FrameRecord record = record_of_one();
  EXPECT_FALSE(Json::parse(pose_line({}, record))["markers"][0].contains("second_cells"));
  record.markers[0].second_cells = 1ULL << 63 | 1ULL << 5 | 1;
  EXPECT_EQ(Json::parse(pose_line({}, record))["markers"][0]["second_cells"], (Json{0, 5, 63}));
}

TEST(PoseLine, HasTheDocumentedForm) {
  Picture picture;
  picture.source = "sphere_00.jpg";
  const std::string line = pose_line(picture, record_of_one());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_TRUE(line.starts_with(
      R"({"image":"sphere_00.jpg","time_ns":123456789012345,"ms":3.123,"markers":[{"id":3,"name":"m03","R":[[)"))
      << line;
  const Json marker = Json::parse(line)["markers"][0];
  std::vector<std::string> keys;
  for (const auto& [key, value] : marker.items()) keys.push_back(key);
  EXPECT_THAT(keys, testing::ElementsAre("id", "name", "R", "rvec", "t", "covariance", "cells_seen", "state",
                                         "cell_centres", "velocity"));
  EXPECT_EQ(marker["velocity"], Json::parse(R"({"angular": [0.5, 0.0, -2.0], "linear": [10.0, 20.0, 30.0]})"));
  EXPECT_EQ(marker["cell_centres"], Json::parse("[[4, 100.5, 200.25], [5, 104.1, 0.1]]"));
  EXPECT_EQ(marker["state"], "measured");
  EXPECT_EQ(marker["cells_seen"], 2);
}

TEST(PoseLine, NumbersReadBackExactly) {
  const FrameRecord record = record_of_one();
  const MarkerObservation& m = record.markers[0];
  const Json marker = Json::parse(pose_line({}, record))["markers"][0];
  EXPECT_EQ((marker["t"].get<std::array<double, 3>>()), (std::array<double, 3>{1.0 / 3, -20, 450.25}));
  EXPECT_EQ((marker["R"].get<Mat3>()), to_matrix(m.T_camera_marker.rotation));
  EXPECT_EQ((marker["covariance"].get<std::array<double, 36>>()), m.covariance);
  const auto rvec = marker["rvec"].get<std::array<double, 3>>();
  EXPECT_NEAR(rvec[0], 0.1, 1e-12);
  EXPECT_NEAR(rvec[1], -0.7, 1e-12);
  EXPECT_NEAR(rvec[2], 2.0 / 3, 1e-12);
}

TEST(PoseLine, IsSoundJsonWhateverHappens) {
  FrameRecord record = record_of_one();
  record.markers[0].state = MarkerState::lost;
  record.markers[0].T_camera_marker.translation.x = std::numeric_limits<double>::quiet_NaN();
  record.markers[0].covariance[7] = std::numeric_limits<double>::infinity();
  std::strcpy(record.markers[0].name.data(), "a \"quoted\" \xff name");
  Picture picture;
  picture.source = "caf\xe9.png";
  const Json line = Json::parse(pose_line(picture, record));
  EXPECT_EQ(line["image"], "caf\xef\xbf\xbd.png");
  EXPECT_EQ(line["markers"][0]["name"], "a \"quoted\" \xef\xbf\xbd name");
  EXPECT_TRUE(line["markers"][0]["t"][0].is_null());
  EXPECT_TRUE(line["markers"][0]["covariance"][7].is_null());
  EXPECT_EQ(line["markers"][0]["state"], "lost");
}

TEST(PoseLine, APictureWithoutANameIsANumber) {
  Picture picture;
  picture.sequence = 42;
  EXPECT_EQ(picture_name(picture), "frame_000042");
  picture.sequence = 12'345'678;
  EXPECT_EQ(picture_name(picture), "frame_12345678");
}

}  // namespace
}  // namespace onestroke

// The library as its users see it: the marker is found, and nothing that they may hand over by mistake is read.

#include "held_marker.h"
#include "library/onestroke.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>

namespace onestroke::test {
namespace {

using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t second = 1'000'000'000;

const HeldMarker& scene() {
  static const HeldMarker drawn{};
  return drawn;
}

CameraLens ideal_lens() {
  return {.horizontal_fov_deg = HeldMarker::fov_deg};
}

/// The same lens in the numbers of a calibration, which counts pixels from the first one's centre.
CameraLens calibrated_lens() {
  CameraLens lens;
  lens.fx = lens.fy = HeldMarker::width / 2.0 / std::tan(HeldMarker::fov_deg * std::numbers::pi / 360);
  lens.cx = HeldMarker::width / 2.0 - 0.5;
  lens.cy = HeldMarker::height / 2.0 - 0.5;
  return lens;
}

CameraPicture good_picture() {
  CameraPicture picture;
  picture.data = scene().image.rgb.data();
  picture.stride = 3 * std::size_t{HeldMarker::width};
  picture.width = HeldMarker::width;
  picture.height = HeldMarker::height;
  return picture;
}

MarkerTracker tracker_with(const CameraLens& lens = ideal_lens(), const MarkerTrackerOptions& options = {}) {
  return MarkerTracker::from_json(to_json(scene().catalog), lens, options);
}

/// The message of the std::runtime_error that work throws; empty, and a failure, where it throws none.
std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

void expect_held(const TrackedPicture& seen) {
  ASSERT_EQ(seen.markers.size(), 1u);
  const TrackedMarker& marker = seen.markers[0];
  EXPECT_EQ(marker.id, scene().held.id);
  EXPECT_EQ(marker.name, scene().held.name);
  EXPECT_EQ(marker.state, TrackedState::measured);
  EXPECT_GT(marker.cells_seen, 30);
  const Mat3 R = to_matrix(scene().T_camera_marker.rotation);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(marker.rotation[i], R[i / 3][i % 3], 0.01) << i;
  const Vec3 t = scene().T_camera_marker.translation;
  EXPECT_NEAR(marker.translation_mm[0], t.x, 0.5);
  EXPECT_NEAR(marker.translation_mm[1], t.y, 0.5);
  EXPECT_NEAR(marker.translation_mm[2], t.z, 1.5);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_GT(marker.covariance[7 * i], 0) << i;
}

TEST(MarkerTracker, FindsTheMarker) {
  MarkerTracker tracker = tracker_with();
  expect_held(tracker.process(good_picture()));
}

TEST(MarkerTracker, FindsTheMarkerInAPictureThatStandsAlone) {
  MarkerTracker tracker = tracker_with(ideal_lens(), {.independent = true});
  expect_held(tracker.process(good_picture()));
}

TEST(MarkerTracker, ACalibrationCountsFromTheFirstPixelsCentre) {
  MarkerTracker ideal = tracker_with(), calibrated = tracker_with(calibrated_lens());
  const TrackedPicture one = ideal.process(good_picture()), other = calibrated.process(good_picture());
  expect_held(other);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(one.markers[0].translation_mm[i], other.markers[0].translation_mm[i], 1e-6);
}

TEST(MarkerTracker, PaddedRowsGiveTheMarker) {
  const std::size_t row = good_picture().stride, stride = row + 32;
  std::vector<std::uint8_t> padded(stride * HeldMarker::height - 32);
  for (std::size_t y = 0; y < HeldMarker::height; ++y)
    std::copy_n(good_picture().data + y * row, row, padded.data() + y * stride);
  CameraPicture picture = good_picture();
  picture.data = padded.data();
  picture.stride = stride;
  MarkerTracker tracker = tracker_with();
  expect_held(tracker.process(picture));
}

TEST(MarkerTracker, TellsTheTimeAndTheSequenceOfThePicture) {
  CameraPicture picture = good_picture();
  picture.sequence = 41;
  picture.exposure_start_ns = 5 * second;
  picture.exposure_length_ns = 4'000'000;
  picture.readout_ns = 10'000'000;
  MarkerTracker tracker = tracker_with();
  const TrackedPicture seen = tracker.process(picture);
  EXPECT_EQ(seen.sequence, 41u);
  EXPECT_EQ(seen.time_ns, 5 * second + 7'000'000);
  EXPECT_GT(seen.cost_ns, 0);
}

TEST(MarkerTracker, AMarkerThatIsCoveredIsPredictedThenLost) {
  const std::vector<std::uint8_t> gray(scene().image.rgb.size(), 128);
  MarkerTracker tracker = tracker_with();
  CameraPicture picture = good_picture();
  tracker.process(picture);
  picture.data = gray.data();
  for (const auto& [ns, state] : {std::pair{second / 10, TrackedState::predicted}, {second / 2, TrackedState::lost}}) {
    picture.exposure_start_ns = ns;
    const TrackedPicture seen = tracker.process(picture);
    ASSERT_EQ(seen.markers.size(), 1u);
    EXPECT_EQ(seen.markers[0].state, state);
    EXPECT_EQ(seen.markers[0].cells_seen, 0);
  }
}

TEST(MarkerTracker, EveryLayoutIsRead) {
  MarkerTracker tracker = tracker_with();
  CameraPicture picture;
  picture.width = 64;
  picture.height = 48;
  for (const PictureLayout layout :
       {PictureLayout::rgb, PictureLayout::gray, PictureLayout::nv12, PictureLayout::yuyv}) {
    const bool nv12 = layout == PictureLayout::nv12;
    picture.layout = layout;
    picture.stride = 64 * (layout == PictureLayout::rgb ? 3u : layout == PictureLayout::yuyv ? 2u : 1u);
    const std::vector<std::uint8_t> bytes(picture.stride * (nv12 ? 72 : 48), 100), uv(70 * 23 + 64, 128);
    picture.data = bytes.data();
    EXPECT_TRUE(tracker.process(picture).markers.empty());
    picture.uv_data = uv.data();
    picture.uv_stride = 70;
    EXPECT_TRUE(tracker.process(picture).markers.empty());
    picture.uv_data = nullptr;
    picture.uv_stride = 0;
  }
}

TEST(MarkerTracker, APictureThatCannotBeReadIsRefusedAndTheNextIsTaken) {
  struct Case {
    const char* message;
    std::function<void(CameraPicture&)> spoil;
  };
  const Case cases[] = {
      {"data is null", [](CameraPicture& p) { p.data = nullptr; }},
      {"stride is 1919 bytes, but a row has 1920", [](CameraPicture& p) { p.stride = 1919; }},
      {"not 0 x 480", [](CameraPicture& p) { p.width = 0; }},
      {"not 640 x -1", [](CameraPicture& p) { p.height = -1; }},
      {"not 640 x 16385", [](CameraPicture& p) { p.height = 16385; }},
      {"layout 4 is unknown", [](CameraPicture& p) { p.layout = static_cast<PictureLayout>(4); }},
      {"layout -1 is unknown", [](CameraPicture& p) { p.layout = static_cast<PictureLayout>(-1); }},
      {"an even width, not 639", [](CameraPicture& p) { p.layout = PictureLayout::yuyv, p.width = 639; }},
      {"an even width, not 639", [](CameraPicture& p) { p.layout = PictureLayout::nv12, p.width = 639; }},
      {"an even height, not 1", [](CameraPicture& p) { p.layout = PictureLayout::nv12, p.height = 1; }},
      {"uv_stride is 639", [](CameraPicture& p) { p.layout = PictureLayout::nv12, p.uv_stride = 639; }},
      {"exposure_length_ns must be 0 to 10 s, not -1", [](CameraPicture& p) { p.exposure_length_ns = -1; }},
      {"readout_ns must be 0 to 10 s", [](CameraPicture& p) { p.readout_ns = 11 * second; }},
      {"exposure_start_ns is out of range",
       [](CameraPicture& p) { p.exposure_start_ns = std::numeric_limits<std::int64_t>::max(); }},
  };
  MarkerTracker tracker = tracker_with();
  for (const Case& c : cases) {
    CameraPicture picture = good_picture();
    c.spoil(picture);
    EXPECT_THAT(error_of([&] { tracker.process(picture); }), HasSubstr(c.message));
  }
  expect_held(tracker.process(good_picture()));
}

TEST(MarkerTracker, ALensThatIsNoneIsRefused) {
  const auto message = [](const CameraLens& lens) { return error_of([&] { tracker_with(lens); }); };
  EXPECT_THAT(message({}), HasSubstr("give horizontal_fov_deg, or fx and fy"));
  for (const double fov : {-20.0, 180.0, nan}) EXPECT_THAT(message({fov}), HasSubstr("horizontal_fov_deg must be"));
  CameraLens lens = calibrated_lens();
  lens.fy = nan;
  EXPECT_THAT(message(lens), HasSubstr("fx and fy"));
  lens.fy = 5 * lens.fx;
  EXPECT_THAT(message(lens), HasSubstr("fx and fy differ"));
  lens = calibrated_lens();
  lens.cx = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(lens), HasSubstr("cx and cy"));
  lens = calibrated_lens();
  lens.distortion[4] = nan;
  EXPECT_THAT(message(lens), HasSubstr("distortion"));
}

TEST(MarkerTracker, ABadCatalogueIsRefusedByName) {
  const auto message = [](const std::string& text) {
    return error_of([&] { MarkerTracker::from_json(text, ideal_lens()); });
  };
  EXPECT_THAT(message("{"), HasSubstr("catalogue: not valid JSON"));
  EXPECT_THAT(message(R"({"sticks": []})"), HasSubstr("\"markers\" is missing"));
  std::string text = to_json(scene().catalog);
  text.replace(text.find("\"pitch\""), 7, "\"patch\"");
  EXPECT_THAT(message(text), HasSubstr("catalogue: marker 1 (\"seven\"): key \"pitch\" is missing"));
}

TEST(MarkerTracker, ACatalogueIsReadFromAFile) {
  const std::string file = ::testing::TempDir() + "marker_tracker_test.json";
  std::ofstream(file) << to_json(scene().catalog);
  MarkerTracker tracker = MarkerTracker::from_file(file, ideal_lens());
  expect_held(tracker.process(good_picture()));
  std::ofstream(file) << "[]";
  EXPECT_THAT(error_of([&] { MarkerTracker::from_file(file, ideal_lens()); }), HasSubstr(file));
  EXPECT_THAT(error_of([] { MarkerTracker::from_file("/no/such.json", ideal_lens()); }), HasSubstr("/no/such.json"));
}

TEST(MarkerTracker, MayBeMoved) {
  MarkerTracker first = tracker_with();
  MarkerTracker second_one = std::move(first);
  expect_held(second_one.process(good_picture()));
  first = tracker_with();
  std::swap(first, second_one);
  expect_held(first.process(good_picture()));
}

}  // namespace
}  // namespace onestroke::test

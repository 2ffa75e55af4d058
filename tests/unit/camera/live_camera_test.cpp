// What a live camera makes of what a device does. Run under AddressSanitizer and ThreadSanitizer too.

#include "camera/live_camera.h"

#include "../core/error_of.h"
#include "camera/live_session.h"
#include "camera/open_camera.h"
#include "core/error.h"
#include "core/latest_exchange.h"
#include "scripted_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <atomic>
#include <numbers>
#include <thread>

namespace onestroke::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr PictureSize size{32, 24};
constexpr CaptureFormat yuyv{.coding = CaptureCoding::yuyv, .size = size, .strides = {80, 0}};
constexpr CaptureFormat mjpeg{.coding = CaptureCoding::mjpeg, .size = size, .strides = {}};
constexpr std::size_t yuyv_bytes = 80 * 24;

std::int64_t now_ns() {
  return Time::now().ns;
}

std::vector<std::uint8_t> jpeg_of(int shade, PictureSize of = size) {
  cv::Mat picture(of.height, of.width, CV_8UC3, cv::Scalar(shade, 80, 160));
  cv::randu(picture.rowRange(0, of.height / 2), 0, 255);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return bytes;
}

class LiveCameraTest : public testing::Test {
 protected:
  std::vector<std::string> said_;
  LiveOptions options_{.patience = Duration::from_ms(200),
                       .say = [this](const std::string& line) { said_.push_back(line); }};

  std::unique_ptr<Camera> open(ScriptedDevice& device, Duration readout = {}) {
    return make_live_camera(device.source(), LensSource({}, std::numbers::pi / 3), readout, options_);
  }

  /// Asks until there is a picture, or too long.
  static PictureHandle next(Camera& camera, Duration most = Duration::from_seconds(5)) {
    PictureHandle picture;
    for (const Time end = Time::now() + most; Time::now() < end;)
      if (camera.next(picture) == Camera::Status::ok) break;
    return picture;
  }
};

TEST_F(LiveCameraTest, LendsTheDevicesOwnMemory) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device, Duration::from_ms(12));
  const std::vector<std::uint8_t> bytes(yuyv_bytes, 77);
  const std::int64_t stamp = now_ns();
  ASSERT_TRUE(device.send(bytes, 5, stamp, Duration::from_ms(4)));
  PictureHandle picture = next(*camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->format, PixelFormat::yuyv);
  EXPECT_EQ(picture->width, 32);
  EXPECT_EQ(picture->strides[0], 80u);
  EXPECT_EQ(picture->planes[0][yuyv_bytes - 20], 77);
  EXPECT_EQ(picture->sequence, 0u);
  EXPECT_EQ(picture->exposure.start.ns, stamp);
  EXPECT_EQ(picture->exposure.length, Duration::from_ms(4));
  EXPECT_EQ(picture->exposure.readout, Duration::from_ms(12));
  EXPECT_TRUE(picture->jpeg.empty());
  EXPECT_EQ(device.free_buffers(), 7);
  picture.reset();
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_EQ(device.free_buffers(), 8);
  EXPECT_EQ(device.misgiven(), 0);
}

TEST_F(LiveCameraTest, CopiesOutOfADeviceWithFewBuffersAndGivesThemBackAtOnce) {
  ScriptedDevice device(yuyv, 4, yuyv_bytes);
  const auto camera = open(device);
  std::vector<PictureHandle> held;
  for (std::uint64_t i = 0; i < LiveSession::pictures; ++i) {
    const std::vector<std::uint8_t> bytes(yuyv_bytes, static_cast<std::uint8_t>(i));
    ASSERT_TRUE(device.send(bytes, i, now_ns()));
    held.push_back(next(*camera));
    ASSERT_TRUE(held.back());
    EXPECT_EQ(held.back()->strides[0], 64u);
    EXPECT_EQ(device.free_buffers(), 4);
  }
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i]->planes[0][100], i);
  ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes), 99, now_ns()));
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::busy) << "every picture is held";
  EXPECT_EQ(device.free_buffers(), 4);
}

TEST_F(LiveCameraTest, DecodesJpegAsAFileIsDecoded) {
  ScriptedDevice device(mjpeg, 4, 20000);
  const auto camera = open(device);
  const std::vector<std::uint8_t> bytes = jpeg_of(30);
  ASSERT_TRUE(device.send(bytes, 0, now_ns()));
  const PictureHandle picture = next(*camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->format, PixelFormat::rgb8);
  EXPECT_TRUE(std::ranges::equal(picture->jpeg, bytes));
  const cv::Mat bgr = cv::imdecode(bytes, cv::IMREAD_COLOR);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(picture->planes[0][static_cast<std::size_t>(3 * (y * size.width + x) + c)],
                  bgr.at<cv::Vec3b>(y, x)[2 - c]);
}

TEST_F(LiveCameraTest, LeavesOutDamagedPicturesAndCountsThem) {
  ScriptedDevice device(mjpeg, 4, 20000);
  const auto camera = open(device);
  const std::vector<std::uint8_t> whole = jpeg_of(30), large = jpeg_of(30, {64, 48});
  std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2));
  std::vector<std::uint8_t> spoilt = whole;
  std::fill(spoilt.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2), spoilt.end() - 2, std::uint8_t{0x55});
  std::uint64_t sequence = 0;
  for (const auto& bad : {cut, spoilt, large}) {
    ASSERT_TRUE(device.send(bad, sequence++, now_ns()));
    PictureHandle none;
    EXPECT_EQ(camera->next(none), Camera::Status::busy);
    ASSERT_TRUE(device.send(whole, sequence++, now_ns()));
    const PictureHandle good = next(*camera);
    ASSERT_TRUE(good);
    EXPECT_EQ(good->sequence, sequence - 1);
  }
  ASSERT_TRUE(device.send(whole, sequence++, now_ns(), {}, true)) << "damaged by the driver's word";
  ASSERT_TRUE(device.send({}, sequence++, now_ns()));
  ASSERT_TRUE(device.send(whole, sequence, now_ns()));
  ASSERT_TRUE(next(*camera));
  EXPECT_EQ(camera->lost(), 5u);
  EXPECT_EQ(camera->trouble(), "") << "now and then one is nothing to tell";
}

TEST_F(LiveCameraTest, LeavesOutShortRawPictures) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes / 2), 0, now_ns()));
  // The last row may lack what follows its pixels.
  ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes - 16, 9), 1, now_ns()));
  const PictureHandle picture = next(*camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->planes[0][0], 9);
  EXPECT_EQ(camera->lost(), 1u);
}

TEST_F(LiveCameraTest, SaysWhenNothingButDamageComes) {
  ScriptedDevice device(mjpeg, 4, 20000);
  const auto camera = open(device);
  PictureHandle none;
  for (std::uint64_t i = 0; i < 20; ++i) {
    ASSERT_TRUE(device.send(std::vector<std::uint8_t>(100, 1), i, now_ns()));
    EXPECT_EQ(camera->next(none), Camera::Status::busy);
  }
  EXPECT_THAT(std::string(camera->trouble()), HasSubstr("damaged"));
  EXPECT_EQ(std::ranges::count_if(said_, [](const auto& line) { return line.find("damaged") != line.npos; }), 1);
  ASSERT_TRUE(device.send(jpeg_of(1), 20, now_ns()));
  EXPECT_TRUE(next(*camera));
  EXPECT_EQ(camera->trouble(), "");
}

TEST_F(LiveCameraTest, CountsGapsAndLeavesOutWhatComesLate) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  const std::vector<std::uint8_t> bytes(yuyv_bytes);
  std::vector<std::uint64_t> got;
  for (const std::uint64_t sequence : {3u, 8u, 5u, 6u, 7u, 9u}) {
    ASSERT_TRUE(device.send(bytes, sequence, now_ns()));
    PictureHandle picture;
    if (camera->next(picture) == Camera::Status::ok) got.push_back(picture->sequence);
  }
  EXPECT_THAT(got, ElementsAre(0, 5, 6));
  EXPECT_EQ(camera->lost(), 4u) << "4 to 7";
}

TEST_F(LiveCameraTest, TheNewestWinWhereManyWait) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  for (std::uint64_t i = 0; i < 6; ++i) ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes), i, now_ns()));
  EXPECT_EQ(next(*camera)->sequence, 0u) << "the first that is given";
  EXPECT_EQ(device.free_buffers(), 6);
  EXPECT_TRUE(next(*camera));
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::busy);
}

TEST_F(LiveCameraTest, ComesBackAfterItWasUnplugged) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  const std::vector<std::uint8_t> bytes(yuyv_bytes, 50);
  ASSERT_TRUE(device.send(bytes, 0, now_ns()));
  PictureHandle shown = next(*camera);
  ASSERT_TRUE(shown);
  device.refuse(CaptureSource::Refused{CaptureRefusal::absent, "nobody is here"});
  device.unplug();
  PictureHandle none;
  for (int i = 0; i < 30; ++i) EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_EQ(device.stops(), 1);
  EXPECT_THAT(std::string(camera->trouble()), HasSubstr("unplugged"));
  EXPECT_EQ(shown->planes[0][0], 50) << "the last picture stays";
  device.refuse(std::nullopt);
  std::jthread player([&](const std::stop_token& stop) {
    for (std::uint64_t i = 0; !stop.stop_requested(); ++i) {
      device.send(bytes, i, now_ns());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  const PictureHandle again = next(*camera);
  ASSERT_TRUE(again);
  EXPECT_GT(again->sequence, shown->sequence);
  EXPECT_EQ(camera->trouble(), "");
  EXPECT_EQ(device.starts(), 2);
  ASSERT_EQ(said_.size(), 3u);
  EXPECT_THAT(said_[1], HasSubstr("scripted is gone"));
  EXPECT_THAT(said_[2], HasSubstr("gives pictures again"));
}

TEST_F(LiveCameraTest, StartsASilentDeviceAgain) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  PictureHandle none;
  for (const Time end = Time::now() + Duration::from_ms(900); Time::now() < end;)
    EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_GE(device.starts(), 3);
  EXPECT_THAT(std::string(camera->trouble()), HasSubstr("sends nothing"));
  EXPECT_THAT(said_, ElementsAre(HasSubstr("has sent nothing for 0.2 s")));
}

TEST_F(LiveCameraTest, DoesNotTakeAHeldDeviceForASilentOne) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  const auto camera = open(device);
  std::vector<PictureHandle> held;
  for (std::uint64_t i = 0; i < 8; ++i) {
    ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes), i, now_ns()));
    held.push_back(next(*camera));
  }
  PictureHandle none;
  for (const Time end = Time::now() + Duration::from_ms(600); Time::now() < end;)
    EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_EQ(device.starts(), 1);
  held.clear();
  EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_EQ(device.free_buffers(), 8);
}

TEST_F(LiveCameraTest, WaitsForADeviceThatAnotherProgramHas) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  device.refuse(CaptureSource::Refused{CaptureRefusal::busy, "another program has it"});
  const auto camera = open(device);
  PictureHandle none;
  for (int i = 0; i < 30; ++i) EXPECT_EQ(camera->next(none), Camera::Status::busy);
  EXPECT_THAT(std::string(camera->trouble()), HasSubstr("another program"));
  EXPECT_THAT(said_, ElementsAre(StartsWith("camera scripted: another program has it")));
  device.refuse(std::nullopt);
  for (const Time end = Time::now() + Duration::from_seconds(5); device.starts() == 0 && Time::now() < end;)
    EXPECT_EQ(camera->next(none), Camera::Status::busy);
  ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes), 0, now_ns()));
  EXPECT_TRUE(next(*camera));
}

TEST_F(LiveCameraTest, AWrongNameIsAnErrorAtOnce) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  device.refuse(CaptureSource::Refused{CaptureRefusal::absent, "no camera is called \"x\""});
  EXPECT_EQ(error_of([&] { open(device); }), "no camera is called \"x\"");
  device.refuse(CaptureSource::Refused{CaptureRefusal::denied, "this user may not"});
  EXPECT_EQ(error_of([&] { open(device); }), "this user may not");
}

TEST_F(LiveCameraTest, TheExposureIsReckonedFromWhatTheDriverStamps) {
  options_.exposure = Duration::from_ms(5);
  options_.clock_offset = Duration::from_ms(-2);
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  device.set_stamped(StampMoment::reception);
  const auto camera = open(device);
  const std::int64_t stamp = now_ns();
  ASSERT_TRUE(device.send(std::vector<std::uint8_t>(yuyv_bytes), 0, stamp));
  const PictureHandle picture = next(*camera);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->exposure.start.ns, stamp - 7'000'000);
  EXPECT_EQ(picture->exposure.length, Duration::from_ms(5));
}

// One thread starts and stops, another sends, a third and a fourth give pictures back.
TEST_F(LiveCameraTest, ManyStartsStopsAndReturnsOnManyThreads) {
  ScriptedDevice device(yuyv, 8, yuyv_bytes);
  options_.patience = Duration::from_seconds(5);
  std::atomic<bool> over{false};
  std::jthread player([&] {
    const std::vector<std::uint8_t> bytes(yuyv_bytes, 1);
    for (std::uint64_t i = 0; !over; ++i) {
      if (!device.send(bytes, i, now_ns())) std::this_thread::yield();
      if (i % 50 == 49) device.unplug();
    }
  });
  LatestExchange<PictureHandle> first, second;
  std::jthread keeper([&] {
    while (!over) first.take().reset();
  });
  std::jthread other([&] {
    while (!over) second.take().reset();
  });
  const auto camera = open(device);
  int pictures = 0;
  for (int i = 0; i < 20000 && pictures < 5000; ++i) {
    PictureHandle picture;
    if (camera->next(picture) != Camera::Status::ok) continue;
    ++pictures;
    EXPECT_EQ(picture->planes[0][5], 1);
    first.publish(picture);
    second.publish(std::move(picture));
  }
  over = true;
  player.join();
  keeper.join();
  other.join();
  EXPECT_EQ(pictures, 5000);
  EXPECT_GT(device.starts(), 10);
  EXPECT_EQ(device.misgiven(), 0);
  first.take();
  second.take();
}

}  // namespace
}  // namespace onestroke::test

// What was tracked while it was recorded is tracked again bit for bit, and recording holds nobody back. Run under
// ThreadSanitizer too.

#include "../core/scratch_folder.h"
#include "camera/jpeg_decoder.h"
#include "camera/open_camera.h"
#include "camera/recorder.h"
#include "core/picture_planes.h"
#include "core/picture_pool.h"
#include "marker_fixture.h"
#include "tracking/tracking_thread.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cstring>
#include <fstream>
#include <future>
#include <numbers>
#include <vector>

namespace onestroke::test {
namespace {

using Pacing = TrackingThread::Pacing;

enum class Form { rgb8, nv12, yuyv, jpeg };

/// BT.601 in limited range.
std::array<double, 3> yuv_of(const std::uint8_t* rgb) {
  const double r = rgb[0], g = rgb[1], b = rgb[2];
  return {16 + 0.257 * r + 0.504 * g + 0.098 * b, 128 - 0.148 * r - 0.291 * g + 0.439 * b,
          128 + 0.439 * r - 0.368 * g - 0.071 * b};
}

/// Another camera's pictures, as a device would send them in this form.
class DeviceLike : public Camera {
 public:
  DeviceLike(std::unique_ptr<Camera> from, Form form, PictureSize size)
      : from_(std::move(from)), form_(form), pool_(7, 3 * static_cast<std::size_t>(size.width * size.height)) {}

  Status next(PictureHandle& picture) override {
    PictureHandle drawn;
    const Status status = from_->next(drawn);
    if (status != Status::ok) return status;
    PictureHandle::Loan* loan = pool_.acquire();
    while (!loan) loan = (std::this_thread::yield(), pool_.acquire());
    Picture& p = loan->picture = *drawn;
    p.format = form_ == Form::nv12 ? PixelFormat::nv12 : form_ == Form::yuyv ? PixelFormat::yuyv : PixelFormat::rgb8;
    std::uint8_t* bytes = pool_.bytes(*loan).data();
    set_planes(p, bytes);
    if (form_ == Form::rgb8) copy_planes(*drawn, bytes);
    if (form_ == Form::jpeg) code(*drawn, jpegs_[pool_.index(*loan)], bytes, p);
    if (form_ == Form::nv12 || form_ == Form::yuyv) convert(*drawn, bytes);
    picture = PictureHandle(*loan);
    return status;
  }
  std::string message() const override { return from_->message(); }
  bool live() const override { return from_->live(); }
  double rate() const override { return from_->rate(); }
  std::size_t length() const override { return from_->length(); }

 private:
  static void code(const Picture& drawn, std::vector<std::uint8_t>& jpeg, std::uint8_t* rgb, Picture& p) {
    const cv::Mat as_drawn(p.height, p.width, CV_8UC3, const_cast<std::uint8_t*>(drawn.planes[0]), drawn.strides[0]);
    cv::Mat swapped;
    cv::extractChannel(as_drawn, swapped, 0);
    std::array<cv::Mat, 3> channels;
    for (int c = 0; c < 3; ++c) cv::extractChannel(as_drawn, channels[static_cast<std::size_t>(2 - c)], c);
    cv::merge(channels.data(), channels.size(), swapped);
    cv::imencode(".jpg", swapped, jpeg, {cv::IMWRITE_JPEG_QUALITY, 92});
    EXPECT_EQ(JpegDecoder().decode(jpeg, {p.width, p.height}, rgb, p.strides[0]), JpegDecoder::Result::ok);
    p.jpeg = jpeg;
  }

  void convert(const Picture& drawn, std::uint8_t* to) const {
    const auto width = static_cast<std::size_t>(drawn.width), height = static_cast<std::size_t>(drawn.height);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const auto yuv = yuv_of(drawn.planes[0] + y * drawn.strides[0] + 3 * x);
        const auto level = [&](std::size_t i) { return static_cast<std::uint8_t>(yuv[i] + 0.5); };
        const std::size_t chroma = 1 + x % 2;
        if (form_ == Form::yuyv) {
          to[2 * (y * width + x)] = level(0);
          to[2 * (y * width + x) + 1] = level(chroma);
        } else {
          to[y * width + x] = level(0);
          if (y % 2 == 0) to[(height + y / 2) * width + x] = level(chroma);
        }
      }
  }

  std::unique_ptr<Camera> from_;
  const Form form_;
  PicturePool pool_;
  std::array<std::vector<std::uint8_t>, 7> jpegs_;
};

/// All that was tracked, in order.
std::vector<FrameRecord> track(Camera& camera, const Catalog& catalog, FrameSink* sink, Pacing pacing = Pacing::every) {
  Tracker tracker(catalog);
  TrackingThread thread(camera, tracker, pacing, sink);
  std::vector<FrameRecord> records;
  for (bool last = false; !last;) {
    last = thread.finished();
    if (thread.drain([&](TrackedFrame& frame) { records.push_back(frame.record); }) == 0) std::this_thread::yield();
  }
  return records;
}

/// Of all but the time that it took.
void expect_same(const FrameRecord& a, const FrameRecord& b) {
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(std::memcmp(&a.T_world_camera, &b.T_world_camera, sizeof(Pose)), 0);
  ASSERT_EQ(a.marker_count, b.marker_count);
  for (std::size_t i = 0; i < a.seen().size(); ++i) {
    const MarkerObservation &m = a.markers[i], &n = b.markers[i];
    EXPECT_EQ(m.id, n.id);
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.state, n.state);
    EXPECT_EQ(std::memcmp(&m.T_camera_marker, &n.T_camera_marker, sizeof(Pose)), 0) << "picture " << a.sequence;
    EXPECT_EQ(std::memcmp(&m.covariance, &n.covariance, sizeof m.covariance), 0);
    EXPECT_EQ(std::memcmp(&m.velocity, &n.velocity, sizeof m.velocity), 0);
    ASSERT_EQ(m.cells_seen, n.cells_seen);
    for (std::size_t c = 0; c < static_cast<std::size_t>(m.cells_seen); ++c) {
      EXPECT_EQ(m.cells[c].index, n.cells[c].index);
      EXPECT_EQ(m.cells[c].u, n.cells[c].u);
      EXPECT_EQ(m.cells[c].v, n.cells[c].v);
    }
  }
}

class RecordedTracking : public testing::Test {
 protected:
  const Catalog catalog_ = catalog_of(2);
  ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path() / "recording";
  const RecordingHeader header_{.program = "1.0", .camera = "synthetic", .rate = 30};

  std::unique_ptr<Camera> synthetic(const std::string& settings, Form form) const {
    CameraOptions options;
    options.spec = "synthetic:width=640,height=480,fov_deg=50," + settings;
    options.catalog = &catalog_;
    return std::make_unique<DeviceLike>(open_camera(options), form, PictureSize{640, 480});
  }
  std::unique_ptr<Camera> recorded() const {
    CameraOptions options;
    options.spec = "folder:" + folder_.string();
    return open_camera(options);
  }
  std::vector<FrameRecord> written() const {
    std::vector<FrameRecord> records;
    std::ifstream in(folder_ / "pictures.jsonl");
    for (std::string line; std::getline(in, line);) record_of_line(line, records.emplace_back());
    return records;
  }
};

class RecordedForms : public RecordedTracking, public testing::WithParamInterface<Form> {};

// Two hands, a head that moves and a rolling shutter; markers are followed from picture to picture.
TEST_P(RecordedForms, AreTrackedAgainBitForBit) {
  const auto camera = synthetic("script=side,seconds=0.4,readout_ms=20,exposure_ms=4,noise=1.5", GetParam());
  Recorder recorder(folder_, header_, catalog_);
  const std::vector<FrameRecord> live = track(*camera, catalog_, &recorder);
  recorder.close();
  EXPECT_EQ(recorder.failure(), "");
  EXPECT_EQ(recorder.left_out(), 0u) << "where every picture counts, each is waited for";
  ASSERT_EQ(live.size(), 12u);
  EXPECT_EQ(live.back().marker_count, 2);
  EXPECT_EQ(live.back().markers[0].state, MarkerState::measured);
  EXPECT_GT(norm(live.back().T_world_camera.translation - live.front().T_world_camera.translation), 0.01);
  EXPECT_NE(live.back().markers[0].velocity.angular, Vec3{});
  const std::vector<FrameRecord> again = track(*recorded(), catalog_, nullptr), told = written();
  ASSERT_EQ(again.size(), live.size());
  ASSERT_EQ(told.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    expect_same(live[i], again[i]);
    expect_same(live[i], told[i]);
  }
}

std::string name_of(const testing::TestParamInfo<Form>& form) {
  constexpr const char* names[] = {"rgb8", "nv12", "yuyv", "jpeg"};
  return names[static_cast<int>(form.param)];
}

INSTANTIATE_TEST_SUITE_P(Of, RecordedForms, testing::Values(Form::rgb8, Form::nv12, Form::yuyv, Form::jpeg), name_of);

// Nothing is written before all is tracked: the slowest disk there can be.
TEST_F(RecordedTracking, ADiskThatStandsStillHoldsNobodyBack) {
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  const auto camera = synthetic("script=still,live=1,fps=60,seconds=2", Form::rgb8);
  Recorder recorder(folder_, header_, catalog_, {.failed = {}, .writes = [gate] { gate.wait(); }});
  const std::vector<FrameRecord> live = track(*camera, catalog_, &recorder, Pacing::newest);
  ASSERT_GT(live.size(), Recorder::waiting + 1) << "so many wait, and one is being written";
  go_on.set_value();
  recorder.close();
  EXPECT_EQ(recorder.failure(), "");
  EXPECT_GT(recorder.left_out(), 0u);
  EXPECT_LE(recorder.written(), Recorder::waiting);
  EXPECT_GE(recorder.written() + recorder.left_out(), live.size());
  const auto camera_again = recorded();
  EXPECT_EQ(camera_again->length(), recorder.written());
}

}  // namespace
}  // namespace onestroke::test

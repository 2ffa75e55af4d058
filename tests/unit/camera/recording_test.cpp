// What is recorded comes back as it was. Run under ThreadSanitizer too.

#include "../core/full_disk.h"
#include "allocation/allocation_counter.h"
#include "camera/jpeg_decoder.h"
#include "camera/open_camera.h"
#include "recording_fixture.h"
#include "scene_fixture.h"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include <fstream>
#include <future>

namespace onestroke::test {
namespace {

using testing::HasSubstr;

class Recording : public testing::Test {
 protected:
  const RecordingHeader header_{.program = "1.0", .camera = "synthetic", .rate = 30};
  ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_ / "recording";
  Album album_;

  std::unique_ptr<Camera> open(const CameraOptions& more = {}) const {
    CameraOptions options = more;
    options.spec = "folder:" + folder_.string();
    return open_camera(options);
  }
  std::string text_of(const char* file) const {
    std::ifstream in(folder_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Pictures of a small size, their numbers in steps of 2.
  void record(int pictures) {
    Recorder recorder(folder_, header_, two_markers());
    for (int i = 0; i < pictures; ++i)
      add_to(recorder, album_.noise(PixelFormat::gray8, 16, 16, static_cast<std::uint64_t>(2 * i)));
    recorder.close();
    ASSERT_EQ(recorder.failure(), "");
  }
};

void expect_same(const Picture& a, const Picture& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(a.format, b.format);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.exposure.start, b.exposure.start);
  EXPECT_EQ(a.exposure.length, b.exposure.length);
  EXPECT_EQ(a.exposure.readout, b.exposure.readout);
  EXPECT_EQ(std::memcmp(&a.intrinsics, &b.intrinsics, sizeof a.intrinsics), 0);
  EXPECT_EQ(std::memcmp(&a.T_world_camera, &b.T_world_camera, sizeof a.T_world_camera), 0);
  EXPECT_STREQ(a.source, b.source);
  EXPECT_EQ(pixels_of(a), pixels_of(b)) << "picture " << a.sequence;
}

TEST_F(Recording, GivesEveryFormatBackBitForBit) {
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::gray8, PixelFormat::nv12, PixelFormat::yuyv}) {
    std::filesystem::remove_all(folder_);
    std::vector<PictureHandle> taken;
    Recorder recorder(folder_, header_, two_markers());
    for (const std::uint64_t sequence : {17u, 18u, 21u, 40u}) {
      taken.push_back(album_.noise(format, 54, 38, sequence));
      album_.of(taken.back()).intrinsics.cx += sequence == 21 ? 0.25 : 0;
      album_.of(taken.back()).source = sequence == 18 ? "a \"b\",\"record\":.png" : "";
      add_to(recorder, taken.back());
    }
    recorder.close();
    EXPECT_EQ(recorder.failure(), "");
    EXPECT_EQ(recorder.written(), 4u);
    EXPECT_EQ(recorder.left_out(), 0u);
    const auto camera = open();
    EXPECT_EQ(camera->length(), 4u);
    EXPECT_EQ(camera->rate(), 30);
    EXPECT_FALSE(camera->live());
    for (const PictureHandle& picture : taken) expect_same(*picture, *take(*camera));
    PictureHandle none;
    EXPECT_EQ(camera->next(none), Camera::Status::end);
    EXPECT_EQ(camera->message(), "");
  }
}

TEST_F(Recording, KeepsJpegsAsTheyCame) {
  const PictureHandle picture = album_.noise(PixelFormat::rgb8, 64, 48, 5);
  std::vector<std::uint8_t> jpeg, rgb(3 * 64 * 48);
  ASSERT_TRUE(cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, pixels_of(*picture).data()), jpeg));
  ASSERT_EQ(JpegDecoder().decode(jpeg, {64, 48}, rgb.data(), 3 * 64), JpegDecoder::Result::ok);
  Picture& p = album_.of(picture);
  p.planes[0] = rgb.data();
  p.strides[0] = 3 * 64;
  p.jpeg = jpeg;
  Recorder recorder(folder_, header_, two_markers());
  add_to(recorder, picture);
  recorder.close();
  const std::string kept = text_of("pictures/000000.jpg");
  EXPECT_EQ(std::vector<std::uint8_t>(kept.begin(), kept.end()), jpeg);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pictures.mkv"));
  const auto camera = open();
  expect_same(*picture, *take(*camera));
}

TEST_F(Recording, KeepsTheRightEyesPicture) {
  const PictureHandle left = album_.noise(PixelFormat::nv12, 32, 24, 3),
                      right = album_.noise(PixelFormat::rgb8, 40, 30, 9);
  album_.of(right).exposure.start = {77};
  album_.of(left).second = &*right;
  Recorder recorder(folder_, header_, two_markers());
  add_to(recorder, left);
  recorder.close();
  const auto camera = open();
  const PictureHandle pair = take(*camera);
  expect_same(*left, *pair);
  ASSERT_NE(pair->second, nullptr);
  expect_same(*right, *pair->second);
}

TEST_F(Recording, TellsWhatWasFoundAndExplainsItself) {
  record(2);
  std::istringstream lines(text_of("pictures.jsonl"));
  std::string line;
  std::getline(lines, line);
  FrameRecord record;
  record_of_line(line, record);
  const auto camera = open();
  const FrameRecord found = found_in(*take(*camera));
  EXPECT_EQ(record.sequence, found.sequence);
  EXPECT_EQ(record.time, found.time);
  ASSERT_EQ(record.marker_count, 1);
  EXPECT_EQ(std::memcmp(&record.markers[0].T_camera_marker, &found.markers[0].T_camera_marker, sizeof(Pose)), 0);
  EXPECT_EQ(record.markers[0].covariance, found.markers[0].covariance);
  EXPECT_EQ(to_json(load_catalog(folder_ / "catalog.json")), to_json(two_markers()));
  EXPECT_THAT(text_of("README.txt"), HasSubstr("pictures.jsonl"));
}

TEST_F(Recording, ALensThatIsKnownOtherwiseCounts) {
  record(1);
  CameraOptions options;
  options.fov_rad = 0.5;
  options.readout = Duration::from_ms(3);
  const auto camera = open(options);
  const PictureHandle p = take(*camera);
  EXPECT_EQ(p->intrinsics.fx, Intrinsics::from_fov(16, 16, 0.5).fx);
  EXPECT_EQ(p->exposure.readout, Duration::from_ms(3));
}

TEST_F(Recording, IsEnteredAnywhereAndPlayedAgain) {
  record(40);
  CameraOptions options;
  options.playback = {.loop = true, .from = Duration::from_ms(66)};
  const auto camera = open(options);
  EXPECT_EQ(camera->length(), 0u) << "it has no end";
  const auto once = open();
  const std::vector<std::uint8_t> first = pixels_of(*take(*once));
  PictureHandle p = take(*camera);
  EXPECT_EQ(p->sequence, 2u) << "66.7 ms after the first";
  camera->seek(Duration::from_ms(990));
  p = take(*camera);
  EXPECT_EQ(p->sequence, 30u);
  EXPECT_EQ((p->exposure.start - camera->began()).ns, 30 * 33'333'333);
  camera->seek(Duration::from_ms(-5));
  p = take(*camera);
  EXPECT_EQ(p->sequence, 0u);
  EXPECT_EQ(pixels_of(*p), first);
  for (int i = 1; i < 40; ++i) p = take(*camera);
  EXPECT_EQ(p->sequence, 78u);
  const Time last = p->exposure.start;
  p = take(*camera);
  EXPECT_EQ(p->sequence, 79u) << "numbers go on growing";
  EXPECT_EQ((p->exposure.start - last).ns, 33'333'333) << "and so do times";
  EXPECT_EQ(pixels_of(*p), first);
  options.playback = {.loop = false, .from = Duration::from_seconds(3)};
  EXPECT_THAT(error_of([&] { open(options); }), HasSubstr("has no picture 3 seconds after its first"));
}

TEST_F(Recording, AFolderWithSomethingInItIsRefused) {
  std::filesystem::create_directory(folder_);
  record(1);
  EXPECT_THAT(error_of([&] { Recorder(folder_, header_, two_markers()); }), HasSubstr("is not empty"));
  EXPECT_THAT(error_of([&] { Recorder(folder_ / "README.txt", header_, two_markers()); }), HasSubstr("is no folder"));
  EXPECT_THAT(error_of([&] { Recorder("/proc/here", header_, two_markers()); }),
              HasSubstr("/proc/here cannot be made"));
}

TEST_F(Recording, EndedByForceIsWholeUpToItsLastLine) {
  record(6);
  // As its files are while it is being written: no end of the video, half a line, and a picture without one.
  const std::string lines = text_of("pictures.jsonl");
  std::size_t end = 0;
  for (int i = 0; i < 4; ++i) end = lines.find('\n', end) + 1;
  for (const std::size_t more : {0u, 1u, 200u, 700u}) {
    std::ofstream(folder_ / "pictures.jsonl", std::ios::binary) << lines.substr(0, end + more);
    const auto camera = open();
    EXPECT_EQ(camera->length(), 4u) << more;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(take(*camera)->sequence, static_cast<std::uint64_t>(2 * i));
  }
}

// So it is, too, where its writer is ended by force: its video has no end.
TEST_F(Recording, CanBeReadWhileItIsWritten) {
  Recorder recorder(folder_, header_, two_markers());
  std::vector<PictureHandle> taken;
  for (std::uint64_t i = 0; i < 5; ++i)
    add_to(recorder, taken.emplace_back(album_.noise(PixelFormat::rgb8, 32, 24, i)));
  const auto lines = [&] { return std::ranges::count(text_of("pictures.jsonl"), '\n'); };
  while (lines() < 5) std::this_thread::yield();
  const auto camera = open();
  for (const PictureHandle& picture : taken) expect_same(*picture, *take(*camera));
  camera->seek({});
  expect_same(*taken[0], *take(*camera));
}

TEST_F(Recording, DamageBeforeTheLastLineIsSaid) {
  record(3);
  const std::string lines = text_of("pictures.jsonl");
  std::ofstream(folder_ / "pictures.jsonl", std::ios::binary) << "{\"sequence\": 1}\n" << lines;
  EXPECT_THAT(error_of([&] { open(); }), HasSubstr("pictures.jsonl, line 1: "));
  std::ofstream(folder_ / "pictures.jsonl", std::ios::binary) << "";
  EXPECT_THAT(error_of([&] { open(); }), HasSubstr("holds no picture"));
  std::ofstream(folder_ / "pictures.jsonl", std::ios::binary) << lines;
  std::ofstream(folder_ / "pictures.mkv", std::ios::binary) << "no video";
  const auto camera = open();
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::end);
  EXPECT_THAT(camera->message(), HasSubstr("pictures.mkv"));
  std::ofstream(folder_ / "recording.json", std::ios::binary) << "{\"onestroke_recording\": 2}";
  EXPECT_THAT(error_of([&] { open(); }), HasSubstr("update the program"));
}

TEST_F(Recording, AFullDiskEndsItAndNothingElse) {
  const auto recorder = std::make_unique<Recorder>(folder_, header_, two_markers());
  {
    const FullDisk disk(60'000);
    for (std::uint64_t i = 0; i < 30; ++i) add_to(*recorder, album_.noise(PixelFormat::rgb8, 64, 48, i));
    recorder->close();
  }
  EXPECT_THAT(recorder->failure(), HasSubstr("the recording ends early: "));
  EXPECT_THAT(recorder->failure(), HasSubstr("pictures.mkv"));
  EXPECT_GT(recorder->written(), 0u);
  EXPECT_EQ(recorder->written() + recorder->left_out(), 30u);
  const auto camera = open();
  EXPECT_EQ(camera->length(), recorder->written());
  for (std::size_t i = 0; i < recorder->written(); ++i) EXPECT_EQ(take(*camera)->sequence, i);
}

TEST_F(Recording, WhoeverTracksAllocatesNothing) {
  Recorder recorder(folder_, header_, two_markers());
  for (std::uint64_t i = 0; i < 20; ++i) {
    const PictureHandle picture = album_.noise(PixelFormat::rgb8, 64, 48, i);
    const FrameRecord found = found_in(*picture);
    const long before = allocations_of_this_thread();
    while (!recorder.add(picture, found)) std::this_thread::yield();
    EXPECT_EQ(allocations_of_this_thread(), before);
  }
}

TEST_F(Recording, OtherSizesEndIt) {
  Recorder recorder(folder_, header_, two_markers());
  add_to(recorder, album_.noise(PixelFormat::rgb8, 64, 48, 0));
  add_to(recorder, album_.noise(PixelFormat::rgb8, 32, 48, 1));
  recorder.close();
  EXPECT_THAT(recorder.failure(), HasSubstr("changed their size or format"));
  EXPECT_EQ(open()->length(), 1u);
}

TEST_F(Recording, ADiskThatStandsStillLeavesPicturesOutAndHoldsNoBuffers) {
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  PicturePool pool(4, 3 * 64 * 48);
  Recorder recorder(folder_, header_, two_markers(), {.failed = {}, .writes = [gate] { gate.wait(); }});
  std::uint64_t refused = 0;
  constexpr std::uint64_t offered = 60;
  for (std::uint64_t i = 0; i < offered; ++i) {
    PictureHandle::Loan* loan = pool.acquire();
    ASSERT_NE(loan, nullptr) << "two buffers at most are held";
    Picture& p = loan->picture;
    p.width = 64;
    p.height = 48;
    p.sequence = i;
    set_planes(p, pool.bytes(*loan).data());
    const PictureHandle picture(*loan);
    if (!recorder.add(picture, found_in(p))) {
      recorder.leave_out();
      ++refused;
    }
  }
  EXPECT_GE(refused, offered - Recorder::waiting);
  while (pool.lent() > 0) std::this_thread::yield();
  go_on.set_value();
  recorder.close();
  EXPECT_EQ(recorder.failure(), "");
  EXPECT_EQ(recorder.left_out(), refused);
  EXPECT_EQ(recorder.written(), offered - refused);
  EXPECT_EQ(open()->length(), offered - refused);
  RecordingLines format;
  std::uint64_t told = 0;
  std::istringstream lines(text_of("pictures.jsonl"));
  for (std::string line; std::getline(lines, line);) format.shot_of(line, told);
  EXPECT_EQ(told, refused);
}

}  // namespace
}  // namespace onestroke::test

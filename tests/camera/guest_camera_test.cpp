// Our live camera on the real stack: in a guest whose kernel, driver and libcamera are Debian's, before a USB camera
// that is played to it.
#include "guest_run.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iostream>
#include <map>

namespace onestroke {
namespace {

using nlohmann::json;

const std::string mjpeg = " --format MJPG:640x480:" CAMERA_PLAYED "/mjpeg ",
                  yuyv = " --format YUYV:640x480:" CAMERA_PLAYED "/yuyv ";
const std::string take = TAKE_PICTURES " ", plain = PLAIN_CAPTURE " ";

std::string name_of_test() {
  return testing::UnitTest::GetInstance()->current_test_info()->name();
}

GuestRun run(const std::string& camera, const std::string& program) {
  return run_in_guest(name_of_test(), camera, program);
}

std::uint64_t fingerprint_of(const json& frame) {
  const std::string picture = frame["picture"];
  return fingerprint_of_file(std::string(CAMERA_PLAYED) + (picture.ends_with(".jpg") ? "/mjpeg/" : "/yuyv/") + picture);
}

Duration median_of(std::vector<Duration> spans) {
  const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
  std::ranges::nth_element(spans, middle);
  return *middle;
}

Duration share_of(std::vector<Duration> spans, double share) {
  std::ranges::sort(spans);
  return spans[static_cast<std::size_t>(share * static_cast<double>(spans.size() - 1))];
}

/// When the driver had the first bytes, by what our camera made of it.
Time stamp_of(const json& picture) {
  return Time{picture["start_ns"].get<std::int64_t>() + picture["length_ns"].get<std::int64_t>() +
              picture["readout_ns"].get<std::int64_t>()};
}

/// Every picture is one that was played whole, and they come in the order in which they were played.
void expect_played(const GuestRun& run) {
  std::map<std::uint64_t, std::vector<std::int64_t>> sent;
  for (const json& frame : run.events_of("frame"))
    if (!frame["cut"].get<bool>()) sent[fingerprint_of(frame)].push_back(frame["time_ns"]);
  std::int64_t last = 0;
  std::int64_t number = -1;
  for (const json& picture : run.pictures) {
    const auto times = sent.find(picture["fingerprint"].get<std::uint64_t>());
    ASSERT_NE(times, sent.end()) << "not as it was played: " << picture;
    const auto next = std::ranges::upper_bound(times->second, last);
    ASSERT_NE(next, times->second.end()) << "out of order: " << picture;
    last = *next;
    EXPECT_GT(picture["sequence"].get<std::int64_t>(), number);
    number = picture["sequence"];
  }
}

/// As expect_played(), and none is missing.
void expect_all_played(const GuestRun& run) {
  const std::vector<json> frames = run.events_of("frame");
  ASSERT_EQ(run.pictures.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(run.pictures[i]["sequence"], i);
    EXPECT_EQ(run.pictures[i]["fingerprint"], fingerprint_of(frames[i])) << frames[i];
  }
}

TEST(PlainProgram, GetsWhatIsPlayed) {
  const GuestRun taken = run(mjpeg + yuyv + "--loop", plain + "MJPEG 60");
  ASSERT_EQ(taken.code, 0) << taken.output;
  ASSERT_EQ(taken.pictures.size(), 60u);
  expect_played(taken);
}

/// All of 300 pictures, at a rate that the emulated processor keeps up with, stamped when they were sent.
void expect_all_of_300(const GuestRun& taken, double rate) {
  ASSERT_EQ(taken.code, 0) << taken.output;
  ASSERT_EQ(taken.pictures.size(), 300u);
  EXPECT_EQ(taken.end["lost"], 0);
  expect_all_played(taken);

  std::vector<Duration> late, steps;
  const std::vector<json> frames = taken.events_of("frame");
  for (std::size_t i = 0; i < std::min(frames.size(), taken.pictures.size()); ++i) {
    const Time sent{frames[i]["time_ns"]};
    late.push_back(taken.on_this_machine(stamp_of(taken.pictures[i])) - sent);
    if (i > 0) steps.push_back(stamp_of(taken.pictures[i]) - stamp_of(taken.pictures[i - 1]));
  }
  const Duration usual = median_of(late), most = share_of(late, 0.9), error{taken.clock.at(1)["error_ns"]};
  std::cout << "stamped after it was sent, ms: median " << usual.ms() << ", 90 of 100 within " << most.ms()
            << ", at most " << share_of(late, 1).ms() << "; the clocks are known to " << error.ms() << " ms; "
            << taken.events_of("late").size() << " pictures were held up\n";
  EXPECT_GT(share_of(late, 0), -Duration::from_ms(1));
  EXPECT_LT(usual, Duration::from_ms(3));
  EXPECT_LT(most, Duration::from_ms(10));
  EXPECT_NEAR(median_of(steps).ms(), 1000 / rate, 1);
}

TEST(LiveCamera, TakesEveryYuyvPicture) {
  expect_all_of_300(run(yuyv + "--rate 30", take + "--count 300 --seconds 25"), 30);
}

TEST(LiveCamera, TakesEveryMjpegPicture) {
  expect_all_of_300(run(mjpeg + "--rate 12", take + "--count 300 --seconds 45"), 12);
}

TEST(LiveCamera, SetsWhatIsAsked) {
  const GuestRun taken =
      run(yuyv, take + "--camera 'Played camera' --exposure-ms 8 --gain 2 --white-balance 5000 --count 5");
  ASSERT_EQ(taken.code, 0) << taken.output;
  std::map<std::string, int> set;
  for (const json& control : taken.events_of("control")) set[control["name"]] = control["value"];
  constexpr int manual = 1;
  EXPECT_EQ(set["exposure_mode"], manual);
  EXPECT_EQ(set["exposure_100us"], 80);
  EXPECT_TRUE(set.contains("gain"));
  EXPECT_EQ(set["white_balance_auto"], 0);
  EXPECT_EQ(set["white_balance_kelvin"], 5000);
  ASSERT_EQ(taken.pictures.size(), 5u);
  for (const json& picture : taken.pictures) EXPECT_EQ(picture["length_ns"], 8'000'000);
}

Time time_of(const json& event) {
  return Time{event["time_ns"].get<std::int64_t>()};
}

/// When a line with these words was said, on this machine's clock.
Time said_at(const GuestRun& taken, const std::string& words) {
  const auto line = std::ranges::find_if(taken.said, [&](const json& l) {
    return l.contains("said") && l["said"].get<std::string>().find(words) != std::string::npos;
  });
  return line == taken.said.end() ? Time{} : taken.on_this_machine(time_of(*line));
}

void expect_soon(const char* what, Duration span, double least_seconds, double most_seconds) {
  std::cout << what << " after " << span.seconds() << " s\n";
  EXPECT_GE(span.seconds(), least_seconds);
  EXPECT_LE(span.seconds(), most_seconds);
}

TEST(LiveCamera, ComesBackWhenPluggedInAgain) {
  const GuestRun taken =
      run(yuyv + "--loop --unplug-after 40 --replug-after 1", take + "--exposure-ms 8 --count 90 --seconds 30");
  ASSERT_EQ(taken.code, 0) << taken.output;
  ASSERT_EQ(taken.events_of("plug").size(), 2u);
  ASSERT_EQ(taken.pictures.size(), 90u);
  expect_played(taken);
  EXPECT_EQ(taken.times_said("is gone"), 1u);
  EXPECT_EQ(taken.times_said("gives pictures again"), 1u);
  expect_soon("gone", said_at(taken, "is gone") - time_of(taken.events_of("unplug").front()), 0, 2);
  expect_soon("back", said_at(taken, "gives pictures again") - time_of(taken.events_of("plug").back()), 0, 5);
  // The camera may have forgotten.
  const auto exposures =
      std::ranges::count(taken.events, "exposure_100us", [](const json& e) { return e.value("name", ""); });
  EXPECT_EQ(exposures, 2);
}

TEST(LiveCamera, StartsASilentCameraAgain) {
  const GuestRun taken = run(yuyv + "--loop --hang-after 40 --hang-for 5", take + "--count 90 --seconds 30");
  ASSERT_EQ(taken.code, 0) << taken.output;
  ASSERT_EQ(taken.events_of("resume").size(), 1u);
  ASSERT_EQ(taken.pictures.size(), 90u);
  expect_played(taken);
  EXPECT_EQ(taken.times_said("has sent nothing"), 1u);
  EXPECT_EQ(taken.times_said("gives pictures again"), 1u);
  // It is patient for two seconds.
  expect_soon("noticed", said_at(taken, "has sent nothing") - time_of(taken.events_of("hang").front()), 1.9, 4);
  expect_soon("back", said_at(taken, "gives pictures again") - time_of(taken.events_of("resume").front()), 0, 5);
}

/// Every tenth was cut; none of those is given, and all that are missing are counted.
void expect_cut_left_out(const GuestRun& taken) {
  ASSERT_EQ(taken.code, 0) << taken.output;
  ASSERT_EQ(taken.pictures.size(), 90u);
  expect_played(taken);
  const std::size_t lost = taken.end["lost"], numbered = taken.pictures.back()["sequence"].get<std::size_t>() + 1;
  EXPECT_GE(lost, 9u);
  EXPECT_EQ(numbered, taken.pictures.size() + lost);
}

TEST(LiveCamera, LeavesOutCutJpegs) {
  expect_cut_left_out(run(mjpeg + "--rate 10 --cut-every 10", take + "--count 90 --seconds 25"));
}

TEST(LiveCamera, LeavesOutCutYuyvPictures) {
  expect_cut_left_out(run(yuyv + "--cut-every 10", take + "--count 90 --seconds 25"));
}

TEST(LiveCamera, WaitsForAnotherProgram) {
  // The other one goes when ours has noticed it.
  const std::string both = "sh -c '" + plain + R"(YUYV 0 100 >$TMPDIR/held & holder=$!
      until grep -q . $TMPDIR/held; do sleep 0.1; done
      (until grep -q another $CAMERA_RESULTS/said.jsonl; do sleep 0.1; done; sleep 2; kill $holder) &
      exec )" + take + "--camera 1d6b:0102 --count 30 --seconds 40'";
  const GuestRun taken = run(yuyv + "--loop", both);
  ASSERT_EQ(taken.code, 0) << taken.output;
  EXPECT_EQ(taken.pictures.size(), 30u);
  EXPECT_EQ(taken.times_said("another program has it"), 1u);
  EXPECT_EQ(taken.times_said("gives pictures again"), 1u);
}

}  // namespace
}  // namespace onestroke

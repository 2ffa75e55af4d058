#include "../core/error_of.h"
#include "../core/full_disk.h"
#include "core/error.h"
#include "session_example.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace onestroke {
namespace {

using test::any_record;
using test::AnyDoubles;
using test::bits_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const SessionHeader plain{.program = "0.1.0", .camera = "synthetic", .catalog = "/c.json", .rate = 30};

class SessionLogTest : public test::FolderTest {
 protected:
  /// A log of so many frames, a new picture each, with a marker in each.
  void make(int frames) {
    SessionLog log(file, plain);
    AnyDoubles any(1);
    for (int i = 0; i < frames; ++i) log.add(any_record(any, 1), Time{i}, true, lens);
  }

  std::string refusal() const {
    return error_of([&] {
      SessionReader session(file);
      while (session.next()) {
      }
    });
  }

  static int frames_of(SessionReader& session) {
    int frames = 0;
    while (session.next()) ++frames;
    return frames;
  }

  const PictureLens lens{640, 360, Intrinsics::from_fov(640, 360, 1)};
};

TEST_F(SessionLogTest, RecordsComeBackBitForBit) {
  AnyDoubles any(7);
  std::vector<FrameRecord> records;
  for (int i = 0; i < 50; ++i) records.push_back(any_record(any, i % (max_markers_per_frame + 1)));
  {
    SessionLog log(file, plain);
    for (std::size_t i = 0; i < records.size(); ++i)
      log.add(records[i], Time{static_cast<std::int64_t>(i) * 1'000'000'007}, true, lens);
    log.close();
    EXPECT_EQ(log.failure(), "");
  }
  SessionReader session(file);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const SessionFrame* frame = session.next();
    ASSERT_NE(frame, nullptr);
    ASSERT_EQ(bits_of(frame->record), bits_of(records[i])) << "frame " << i;
    EXPECT_EQ(frame->now.ns, static_cast<std::int64_t>(i) * 1'000'000'007);
    EXPECT_TRUE(frame->picture);
    EXPECT_EQ(frame->lens.width, 640);
    EXPECT_EQ(frame->lens.height, 360);
    EXPECT_EQ(frame->lens.intrinsics.fx, lens.intrinsics.fx);
  }
  EXPECT_EQ(session.next(), nullptr);
  EXPECT_EQ(session.note(), "");
}

TEST_F(SessionLogTest, TheSecondPictureComesBackWhileThereIsOne) {
  SecondLens second;
  second.width = 320;
  second.height = 240;
  second.intrinsics = Intrinsics::from_fov(320, 240, 0.7);
  second.T_first_second = {exp_so3({0.1, 0.2, 0.3}), {64, 1.0 / 3, 0}};
  {
    SessionLog log(file, plain);
    log.add({}, Time{1}, true, lens);
    for (const std::int64_t frame : {2, 3}) log.add({}, Time{frame}, true, lens, second);
    log.add({}, Time{4}, true, lens);
  }
  const std::string text = content();
  std::size_t said = 0;
  for (std::size_t at = text.find("\"second\""); at != std::string::npos; at = text.find("\"second\"", at + 1)) ++said;
  EXPECT_EQ(said, 2u) << "where it is new, and where it is gone";
  SessionReader session(file);
  for (const int width : {0, 320, 320, 0}) {
    const SessionFrame* frame = session.next();
    ASSERT_NE(frame, nullptr);
    ASSERT_EQ(frame->second.width, width);
    if (width == 0) continue;
    EXPECT_EQ(frame->second.intrinsics.fx, second.intrinsics.fx);
    EXPECT_EQ(frame->second.T_first_second.translation, second.T_first_second.translation);
    EXPECT_EQ(frame->second.T_first_second.rotation.z, second.T_first_second.rotation.z);
  }
}

TEST_F(SessionLogTest, NoNumbersComeBackAsNone) {
  FrameRecord record;
  record.marker_count = 1;
  record.markers[0].covariance[3] = std::numeric_limits<double>::quiet_NaN();
  record.markers[0].covariance[4] = -std::numeric_limits<double>::infinity();
  { SessionLog(file, plain).add(record, {}, true, lens); }
  SessionReader session(file);
  const SessionFrame* frame = session.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(std::isnan(frame->record.markers[0].covariance[3]));
  EXPECT_EQ(frame->record.markers[0].covariance[4], -std::numeric_limits<double>::infinity());
}

TEST_F(SessionLogTest, TheHeaderComesBack) {
  const SessionHeader header{.program = "1.2",
                             .camera = "file:/a \"b\".mp4",
                             .catalog = "/ä.json",
                             .fov_deg = 62.1,
                             .calibration = "/lens.yaml",
                             .readout_ms = 1.0 / 3,
                             .second_camera = "file:/r.mp4",
                             .side_by_side = true,
                             .rig = "/rig.yml",
                             .baseline_mm = 63.1,
                             .rate = 29.97,
                             .stereo = true,
                             .fingers = false,
                             .left_handed = true,
                             .T_head_camera = Pose{exp_so3({0.1, 0, 0}), {1, 2, 3}}};
  { SessionLog log(file, header); }
  const SessionReader session(file);
  const SessionHeader& read = session.header();
  EXPECT_EQ(read.program, header.program);
  EXPECT_EQ(read.camera, header.camera);
  EXPECT_EQ(read.catalog, header.catalog);
  EXPECT_EQ(read.fov_deg, header.fov_deg);
  EXPECT_EQ(read.calibration, header.calibration);
  EXPECT_EQ(read.readout_ms, header.readout_ms);
  EXPECT_EQ(read.second_camera, header.second_camera);
  EXPECT_TRUE(read.side_by_side);
  EXPECT_EQ(read.rig, header.rig);
  EXPECT_EQ(read.baseline_mm, header.baseline_mm);
  EXPECT_EQ(read.rate, header.rate);
  EXPECT_TRUE(read.stereo);
  EXPECT_FALSE(read.fingers);
  EXPECT_TRUE(read.left_handed);
  ASSERT_TRUE(read.T_head_camera);
  EXPECT_NEAR(angle_between(read.T_head_camera->rotation, header.T_head_camera->rotation), 0, 1e-12);
  EXPECT_EQ(read.T_head_camera->translation.y, 2);
}

TEST_F(SessionLogTest, TellsEachPicturesWayToTheEye) {
  {
    SessionLog log(file, plain);
    log.took(Latency{Duration::from_ms(11), Duration::from_ms(14.5), Duration::from_ms(40)});
    log.add({}, Time{1}, false, {});
    log.took(std::nullopt);
    log.add({}, Time{2}, false, {});
  }
  const std::string text = content(), way = R"("latency_ms":{"tracked":11.0,"drawn":14.5,"seen":40.0})";
  EXPECT_THAT(text, HasSubstr(way));
  EXPECT_EQ(text.find("latency_ms"), text.rfind("latency_ms"));
}

TEST_F(SessionLogTest, KeysAndEventsBelongToTheirFrame) {
  {
    SessionLog log(file, plain);
    log.press(Key{'l'});
    log.press(Key::space);
    log.press(Key::left);
    log.happened("Link");
    log.add({}, Time{1}, false, {});
    log.add({}, Time{2}, false, {});
  }
  SessionReader session(file);
  const SessionFrame* frame = session.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_THAT(std::vector<Key>(frame->keys.begin(), frame->keys.end()), ElementsAre(Key{'l'}, Key::space, Key::left));
  ASSERT_EQ(frame->events.size(), 1u);
  EXPECT_EQ(frame->events[0].view(), "Link");
  EXPECT_FALSE(frame->picture);
  frame = session.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frame->keys.empty() && frame->events.empty());
  EXPECT_THAT(content(), HasSubstr(R"("keys":["l",32,256],"events":["Link"])"));
}

TEST_F(SessionLogTest, ARecordIsWrittenWhenItIsNew) {
  AnyDoubles any(3);
  const FrameRecord record = any_record(any, 2);
  FrameRecord costlier = record;
  costlier.cost.ns += 1;
  {
    SessionLog log(file, plain);
    log.add(record, Time{1}, true, lens);
    log.add(record, Time{2}, false, lens);
    log.add(costlier, Time{3}, false, lens);
  }
  const std::string text = content();
  std::size_t records = 0;
  for (std::size_t at = text.find("\"record\""); at != std::string::npos; at = text.find("\"record\"", at + 1))
    ++records;
  EXPECT_EQ(records, 2u);
  EXPECT_EQ(text.find("\"lens\""), text.rfind("\"lens\""));
  SessionReader session(file);
  session.next();
  const SessionFrame* second = session.next();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(bits_of(second->record), bits_of(record));
  EXPECT_EQ(second->now, Time{2});
}

TEST_F(SessionLogTest, FramesThatComeTooFastAreCountedAndTheirKeysKept) {
  constexpr int fast = 1000, slow = 10;
  {
    SessionLog log(file, plain);
    AnyDoubles any(5);
    const FrameRecord record = any_record(any, max_markers_per_frame);
    for (int i = 0; i < fast; ++i) {
      if (i == fast / 2) log.press(Key{'h'});
      log.add(record, Time{i}, true, lens);
    }
    for (int i = fast; i < fast + slow; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      log.add(record, Time{i}, true, lens);
    }
    log.close();
    EXPECT_EQ(log.failure(), "");
  }
  SessionReader session(file);
  int seen = 0, missed = 0;
  std::size_t keys = 0;
  Time last{-1};
  while (const SessionFrame* frame = session.next()) {
    EXPECT_EQ(frame->now.ns - last.ns, 1 + static_cast<std::int64_t>(frame->missed));
    last = frame->now;
    ++seen;
    missed += static_cast<int>(frame->missed);
    keys += frame->keys.size();
  }
  EXPECT_GT(missed, 0) << "so many do not find room";
  EXPECT_EQ(seen + missed, fast + slow);
  EXPECT_EQ(keys, 1u);
  EXPECT_THAT(session.note(), HasSubstr(std::to_string(missed) + " frames are missing"));
}

TEST_F(SessionLogTest, AFullDiskEndsTheLogAndNothingElse) {
  std::string failure;
  {
    SessionLog log(file, plain);
    const FullDisk full(20'000);
    AnyDoubles any(2);
    for (int i = 0; i < 40; ++i) {
      log.add(any_record(any, 4), Time{i}, true, lens);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    log.close();
    failure = log.failure();
  }
  EXPECT_THAT(failure, AllOf(HasSubstr(file.string()), HasSubstr("ends early"), HasSubstr("disk")));
  EXPECT_EQ(std::count(failure.begin(), failure.end(), '\n'), 0);
  SessionReader session(file);
  EXPECT_GT(frames_of(session), 0) << "what found room can be shown";
}

TEST_F(SessionLogTest, AFileThatCannotBeWrittenIsRefused) {
  EXPECT_THAT(error_of([] { SessionLog log("/dev/full", plain); }),
              AllOf(HasSubstr("/dev/full cannot be written"), HasSubstr("disk")));
  EXPECT_THAT(error_of([&] { SessionLog log(folder / "none" / "a.jsonl", plain); }), HasSubstr("cannot be written"));
}

TEST_F(SessionLogTest, RefusesWhatIsNoLog) {
  EXPECT_THAT(refusal(), AllOf(HasSubstr(file.string()), HasSubstr("cannot be read")));
  EXPECT_THAT(error_of([&] { SessionReader session(folder); }), HasSubstr("cannot be read"));
  for (const char* text : {"", "\n", "{\"markers\": []}\n", "\x89PNG\r\n"}) {
    write(text);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(file.string() + " is no log of a session"), HasSubstr("--log")));
  }
  write("{\"onestroke_session\": 2, \"more\": 1}\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr(file.string() + ", line 1: "), HasSubstr("format 2"), HasSubstr("update")));
  write("{\"onestroke_session\": 1}\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("line 1: "), HasSubstr("program")));
}

TEST_F(SessionLogTest, NamesTheLineThatIsWrong) {
  make(5);
  const std::string whole = content();
  for (const auto& [from, to] :
       {std::pair{R"("now_ns":2)", R"("now_ns":"2")"}, std::pair{R"("now_ns":2)", R"("then_ns":2)"},
        std::pair{R"("now_ns":2,)", R"("now_ns":2,,)"}, std::pair{R"("now_ns":2,)", R"("now_ns":2,"keys":["ll"],)"}}) {
    std::string text = whole;
    text.replace(text.find(from), std::string(from).size(), to);
    write(text);
    const std::string message = refusal();
    EXPECT_THAT(message, HasSubstr(file.string() + ", line 4: ")) << to;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
}

TEST_F(SessionLogTest, RefusesRecordsThatDoNotFit) {
  make(1);
  const std::string whole = content();
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    write(text);
    return refusal();
  };
  EXPECT_THAT(changed("\"cells\":[[", "\"cells\":[[64,1.0,1.0],["), HasSubstr("line 2: no marker has a cell 64"));
  EXPECT_THAT(changed("\"covariance\":[", "\"covariance\":[1.0,"), HasSubstr("a list must have 36 numbers"));
  EXPECT_THAT(changed("\"width\":640", "\"width\":0"), HasSubstr("no picture has 0 x 360 pixels"));
  EXPECT_THAT(changed("\"name\":\"", "\"name\":\"" + std::string(48, 'x')), HasSubstr("too long"));
  std::string markers = "\"markers\":[";
  for (int i = 0; i < 16; ++i) markers += "{},";
  EXPECT_THAT(changed("\"markers\":[", markers), HasSubstr("too many markers"));
}

TEST_F(SessionLogTest, ALastLineThatIsCutShortIsLeftOut) {
  make(4);
  const std::string whole = content();
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last + 1; size + 2 < whole.size(); size += 37) {
    write(whole.substr(0, size));
    SessionReader session(file);
    EXPECT_EQ(frames_of(session), 3);
    EXPECT_THAT(session.note(), HasSubstr("line 5 is cut short"));
  }
  write(whole.substr(0, whole.size() - 1));
  SessionReader session(file);
  EXPECT_EQ(frames_of(session), 4) << "only its end is missing";
  EXPECT_EQ(session.note(), "");
}

}  // namespace
}  // namespace onestroke

#include "app/replay_feed.h"

#include "counting_camera.h"
#include "session_example.h"

#include <gmock/gmock.h>

namespace onestroke {
namespace {

using Next = Feed::Next;
using testing::ElementsAre;
using testing::HasSubstr;

bool never() {
  return false;
}
bool always() {
  return true;
}

class ReplayFeedTest : public test::FolderTest {
 protected:
  /// A log whose frames show pictures of these numbers; a number again is the same picture again.
  SessionReader log_of(const std::vector<std::uint64_t>& numbers) {
    {
      SessionLog log(file, {.camera = "counting"});
      std::int64_t frame = 0;
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        FrameRecord record;
        record.sequence = numbers[i];
        record.time = Time{} + static_cast<std::int64_t>(numbers[i]) * Duration::from_ms(10);
        record.T_world_camera.translation = {1, 2, 3};
        log.add(record, Time{++frame}, i == 0 || numbers[i] != numbers[i - 1], lens);
      }
    }
    return SessionReader(file);
  }

  const PictureLens lens{32, 24, Intrinsics::from_fov(32, 24, 1)};
};

TEST_F(ReplayFeedTest, ShowsTheLogsPicturesAsTheLogDid) {
  SessionReader session = log_of({0, 0, 3, 4, 4, 9});
  CountingCamera camera(20, 2);
  ReplayFeed feed(session);
  feed.use(&camera);
  std::vector<std::uint64_t> shown;
  PictureHandle held;  // as a show does
  for (std::int64_t frame = 1; frame <= 6; ++frame) {
    const Next next = feed.advance({}, never);
    EXPECT_EQ(next, frame == 2 || frame == 5 ? Next::same : Next::picture);
    EXPECT_EQ(feed.now(), Time{frame});
    if (next == Next::picture) {
      held = feed.take_picture();
      EXPECT_EQ(held->sequence, feed.record().sequence);
      shown.push_back(held->sequence);
    }
  }
  EXPECT_THAT(shown, ElementsAre(0u, 3u, 4u, 9u));
  EXPECT_EQ(feed.advance({}, never), Next::end);
  EXPECT_EQ(feed.record().sequence, 9u) << "what was shown last stands";
  EXPECT_EQ(feed.message(), "");
  EXPECT_EQ(feed.dark_pictures(), 0u);
}

TEST_F(ReplayFeedTest, DarkPicturesStandForThoseThatTheCameraLacks) {
  SessionReader session = log_of({0, 1, 2, 3, 4, 5});
  CountingCamera camera(2);
  ReplayFeed feed(session);
  feed.use(&camera);
  PictureHandle held;
  for (std::uint64_t i = 0; i < 6; ++i) {
    ASSERT_EQ(feed.advance({}, never), Next::picture);
    held = feed.take_picture();
    ASSERT_TRUE(held);
    EXPECT_EQ(held->sequence, i);
    EXPECT_EQ(held->width, 32);
    EXPECT_EQ(held->height, 24);
    EXPECT_EQ(held->intrinsics.fx, lens.intrinsics.fx);
  }
  EXPECT_EQ(held->planes[0][3 * 32 * 24 - 1], held->planes[0][0]);
  EXPECT_EQ(held->T_world_camera.translation, (Vec3{1, 2, 3})) << "where the head was";
  EXPECT_EQ(feed.dark_pictures(), 4u);
}

TEST_F(ReplayFeedTest, GoesBackWhereTheSessionDid) {
  SessionReader session = log_of({0, 1, 150, 151, 152, 145, 146, 2, 3, 140});
  CountingCamera camera(153);
  ReplayFeed feed(session);
  feed.use(&camera);
  for (const std::uint64_t i : {0u, 1u, 150u, 151u, 152u, 145u, 146u, 2u, 3u, 140u}) {
    ASSERT_EQ(feed.advance({}, never), Next::picture);
    EXPECT_EQ(feed.take_picture()->sequence, i);
  }
  EXPECT_EQ(feed.dark_pictures(), 0u);
}

TEST_F(ReplayFeedTest, NeedsNoCamera) {
  SessionReader session = log_of({7, 8});
  ReplayFeed feed(session);
  EXPECT_EQ(feed.advance({}, never), Next::picture);
  EXPECT_TRUE(feed.take_picture());
  EXPECT_EQ(feed.advance({}, never), Next::picture);
  EXPECT_EQ(feed.dark_pictures(), 2u);
}

TEST_F(ReplayFeedTest, WaitingForACameraCanBeStopped) {
  SessionReader session = log_of({1});
  CountingCamera starved(5, 1);
  PictureHandle held;
  ASSERT_EQ(starved.next(held), Camera::Status::ok);
  ReplayFeed feed(session);
  feed.use(&starved);
  EXPECT_EQ(feed.advance({}, always), Next::picture);
  EXPECT_EQ(feed.dark_pictures(), 1u);
}

TEST_F(ReplayFeedTest, GivesTheKeysThatChangeWhatIsSeen) {
  {
    SessionLog log(file, {});
    for (const Key key : {Key{'l'}, Key::space, Key{'q'}, Key::escape, Key{'h'}}) log.press(key);
    log.add({}, {}, false, {});
    log.add({}, {}, false, {});
  }
  SessionReader session(file);
  ReplayFeed feed(session);
  EXPECT_EQ(feed.advance({}, never), Next::same);
  const auto keys = feed.keys();
  EXPECT_THAT(std::vector<Key>(keys.begin(), keys.end()), ElementsAre(Key{'l'}, Key{'h'}));
  EXPECT_EQ(feed.advance({}, never), Next::same);
  EXPECT_TRUE(feed.keys().empty());
}

TEST_F(ReplayFeedTest, ABadLineEndsTheShowAndSaysWhy) {
  log_of({0, 1, 2});
  std::string text = content();
  text.replace(text.find("\"sequence\":1"), 12, "\"sequence\":x");
  write(text);
  SessionReader session(file);
  ReplayFeed feed(session);
  EXPECT_EQ(feed.advance({}, never), Next::picture);
  EXPECT_EQ(feed.advance({}, never), Next::end);
  EXPECT_THAT(feed.message(), HasSubstr("session.jsonl, line 3: "));
}

}  // namespace
}  // namespace onestroke

#include "app/track_crew.h"

#include "core/error.h"
#include "counting_camera.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace onestroke {
namespace {

Catalog one_marker() {
  return {{{1, "m01", encode(1, 36), Shape::angle(36, 4, 3, 0), ""}}};
}

std::string number_of(const Picture& picture, const FrameRecord&) {
  return std::to_string(picture.sequence);
}

std::vector<int> numbers_from(Camera& camera, int threads, std::optional<int> most = {}) {
  TrackCrew crew(camera, one_marker(), {.independent = true}, threads, most);
  std::vector<int> numbers;
  crew.run(number_of, [&](const std::string& line, const FrameRecord& record) {
    numbers.push_back(std::stoi(line));
    EXPECT_EQ(record.sequence, static_cast<std::uint64_t>(numbers.back()));
  });
  EXPECT_EQ(crew.stopped_early(), most.has_value());
  return numbers;
}

std::vector<int> first(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(TrackCrew, DeliversEveryPictureInOrder) {
  for (const int threads : {1, 2, 5}) {
    CountingCamera camera(60);
    EXPECT_EQ(numbers_from(camera, threads), first(60)) << threads << " threads";
  }
}

TEST(TrackCrew, GetsByWithFewerBuffersThanThreads) {
  CountingCamera camera(30, 1);
  EXPECT_EQ(numbers_from(camera, 4), first(30));
}

/// Takes every other offer.
class Choosy : public FrameSink {
 public:
  bool add(const PictureHandle& picture, const FrameRecord& record) noexcept override {
    if (offers_++ % 2 == 0) return false;
    EXPECT_EQ(picture->sequence, record.sequence);
    taken.push_back(static_cast<int>(record.sequence));
    return true;
  }
  void leave_out() noexcept override { ADD_FAILURE() << "every picture counts"; }
  std::vector<int> taken;

 private:
  int offers_ = 0;
};

TEST(TrackCrew, OffersEveryPictureToTheSinkUntilItIsTaken) {
  for (const int threads : {1, 3}) {
    CountingCamera camera(40, 2);
    Choosy sink;
    TrackCrew crew(camera, one_marker(), {.independent = true}, threads, {}, &sink);
    crew.run(number_of, [](const std::string&, const FrameRecord&) {});
    EXPECT_EQ(sink.taken, first(40));
  }
}

TEST(TrackCrew, StopsWhenAskedTo) {
  CountingCamera camera(60);
  TrackCrew crew(camera, one_marker(), {.independent = true}, 2, {});
  crew.stop_when([] { return true; });
  crew.run(number_of, [](const std::string&, const FrameRecord&) { ADD_FAILURE() << "nothing was to be taken"; });
  EXPECT_TRUE(crew.stopped_early());
}

TEST(TrackCrew, StopsWhenEnoughPicturesAreDone) {
  CountingCamera camera(60);
  EXPECT_EQ(numbers_from(camera, 3, 7), first(7));
}

TEST(TrackCrew, PassesOnWhatGoesWrong) {
  for (const int threads : {1, 3}) {
    CountingCamera camera(60);
    TrackCrew crew(camera, one_marker(), {.independent = true}, threads, {});
    std::vector<std::string> lines;
    const auto deliver = [&](const std::string& line, const FrameRecord&) {
      if (line == "5") throw Error("the disk is full");
      lines.push_back(line);
    };
    EXPECT_THROW(crew.run(number_of, deliver), Error);
    EXPECT_EQ(lines, (std::vector<std::string>{"0", "1", "2", "3", "4"}));

    CountingCamera again(60);
    TrackCrew other(again, one_marker(), {.independent = true}, threads, {});
    const auto describe = [](const Picture& picture, const FrameRecord&) -> std::string {
      if (picture.sequence == 9) throw Error("no room to draw");
      return "";
    };
    EXPECT_THROW(other.run(describe, [](const std::string&, const FrameRecord&) {}), Error);
  }
}

}  // namespace
}  // namespace onestroke

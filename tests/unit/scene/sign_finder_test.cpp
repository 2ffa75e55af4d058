// What the hands do, as the tracker sees it, through the whole comparison.
#include "hand_motion.h"
#include "scene/comparison.h"
#include "sticks.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace onestroke {
namespace {

constexpr double rate = 30, arm = 72;  // pictures a second; mm
constexpr StickPoints stick_points{Vec3{0, -arm, 0}, Vec3{}, Vec3{arm, 0, 0}};

/// A comparison that sees what noisy eyes see of two sticks.
class Session {
 public:
  explicit Session(std::uint32_t seed) : eyes_(seed) {}

  const ComparisonView& show(const Pose& left, const Pose& right) {
    const double t = frame_ / rate;
    const auto seen = eyes_.see(left, right, t);
    std::array sticks{Stick{.id = 1}, Stick{.id = 2}};
    for (std::size_t i = 0; i < sticks.size(); ++i) {
      if (seen[i])
        sticks[i].place = seen[i]->translation, sticks[i].rotation = seen[i]->rotation;
      else
        sticks[i].state = MarkerState::lost;
    }
    return comparison_.update(record_of({sticks[0], sticks[1]}), Time{} + Duration::from_seconds(frame_++ / rate));
  }
  double seconds() const { return frame_ / rate; }
  void press(char key) { comparison_.press(key); }

 private:
  static CarriedModel carried(int id) {
    return {.marker_id = id,
            .pivot = {38, -30, 0},
            .reach = 35,
            .marker_from_model = {{0, 1, 0, 0}, {}, 1000},
            .points = stick_points};
  }

  const std::array<CarriedModel, 2> carried_{carried(1), carried(2)};
  Comparison comparison_{carried_};
  NoisyEyes eyes_;
  int frame_ = 0;
};

/// One thing that is meant: places brought together, then a twist or a parting where that is what is meant.
struct Meant {
  StickPoint left, right;
  std::string_view words;
  double twist = 0;  // degrees, once the corners are together
};

constexpr std::array meant_signs{Meant{StickPoint::start, StickPoint::start, "Link"},
                                 Meant{StickPoint::corner, StickPoint::corner, "Lay over"},
                                 Meant{StickPoint::corner, StickPoint::corner, "Best fit", 65},
                                 Meant{StickPoint::corner, StickPoint::start, "Cut"},
                                 Meant{StickPoint::start, StickPoint::corner, "Cut"},
                                 Meant{StickPoint::end, StickPoint::start, "Measure"},
                                 Meant{StickPoint::start, StickPoint::end, "Measure"},
                                 Meant{StickPoint::corner, StickPoint::end, "Freeze"},
                                 Meant{StickPoint::end, StickPoint::corner, "Freeze"},
                                 Meant{StickPoint::end, StickPoint::end, "Snapshot"}};

/// What was done in a trial, in order, and how far the view came.
std::vector<std::string> done_in_trial(const Meant& meant, std::mt19937& random) {
  std::normal_distribution<double> miss(0, 2);
  std::uniform_real_distribution<double> turn(-0.6, 0.6);
  const auto seed = [&random] { return static_cast<std::uint32_t>(random()); };
  HandMotion left_hand(seed(), -1);
  Session session(seed());
  const Pose left = left_hand.at(0);
  const Vec3 inside{24, -24, 0};
  const Vec3 outwards = -1 * normalized(stick_points[static_cast<std::size_t>(meant.left)] - inside);
  const Vec3 own = stick_points[static_cast<std::size_t>(meant.right)] - inside;
  const Quat facing = exp_so3({0, 0, std::atan2(outwards.y, outwards.x) - std::atan2(own.y, own.x)});
  const Quat rotation = left.rotation * facing * exp_so3({turn(random), turn(random), turn(random)});
  const bool corners = meant.left == StickPoint::corner && meant.right == StickPoint::corner;
  const Vec3 target = left * stick_points[static_cast<std::size_t>(meant.left)] +
                      rotate(left.rotation, (corners ? -18.0 : -6.0) * outwards) +
                      Vec3{miss(random), miss(random), miss(random)};
  std::vector<std::string> done;
  while (session.seconds() < (meant.twist > 0 ? 6 : 3.5)) {
    const double t = session.seconds(), u = std::min(t / 0.9, 1.0), s = u * u * u * (10 + u * (6 * u - 15));
    const double v = std::clamp((t - 2.8) / 0.8, 0.0, 1.0), twisted = meant.twist * v * v * (3 - 2 * v);
    const Vec3 shake{std::sin(47 * t), std::sin(53 * t + 1), std::sin(61 * t + 2)};
    const Quat q = rotation * exp_so3({0, twisted * std::numbers::pi / 180, 0});
    const Vec3 place = target - rotate(q, stick_points[static_cast<std::size_t>(meant.right)]);
    for (const std::string_view word :
         session.show(left, {q, place + (1 - s) * Vec3{180, 40, 30} + 0.7 * shake}).happened())
      done.emplace_back(word);
  }
  return done;
}

TEST(Signs, AreFoundWhenTheyAreMeant) {
  std::mt19937 random(11);
  constexpr int trials = 1000;
  std::map<std::string_view, std::array<int, 3>> counts;  // trials, found, something else done
  int found = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Meant& meant = meant_signs[static_cast<std::size_t>(trial) % meant_signs.size()];
    std::vector<std::string> done = done_in_trial(meant, random);
    if (meant.twist > 0 && !done.empty() && done.front() == "Lay over") done.erase(done.begin());
    auto& count = counts[meant.words];
    ++count[0];
    const bool right = !done.empty() && done.front() == meant.words;
    count[1] += right;
    count[2] += done.size() > (right ? 1U : 0U);
    found += right;
  }
  for (const auto& [words, count] : counts)
    std::printf("%-10s %3d of %3d, %d with something else\n", std::string(words).c_str(), count[1], count[0], count[2]);
  std::printf("signs: %d of %d found\n", found, trials);
  EXPECT_GE(found, trials * 99 / 100);
}

// In each mode, for its own signs.
TEST(Signs, AreNotMadeByHandsThatMoveFreely) {
  constexpr int seconds = 600;
  int total = 0;
  std::uint32_t seed = 1000;
  for (const std::string_view keys : {"", "", "", "", "l", "ll", "o", "ob", "c", "m"}) {
    int made = 0;
    seed += 3;
    HandMotion left(seed, -1), right(seed + 1, 1);
    Session session(seed + 2);
    session.show(left.at(0), right.at(0));
    for (const char key : keys) session.press(key);
    session.show(left.at(0), right.at(0));
    while (session.seconds() < seconds) {
      const double t = session.seconds();
      for (const std::string_view word : session.show(left.at(t), right.at(t)).happened()) {
        if (word == "End") continue;  // of what was made before
        std::printf("  after %.0f s: %s\n", t, std::string(word).c_str());
        ++made;
      }
    }
    std::printf("free motion, keys \"%s\": %d in 10 minutes\n", std::string(keys).c_str(), made);
    total += made;
  }
  EXPECT_LT(total, 10);
}

}  // namespace
}  // namespace onestroke

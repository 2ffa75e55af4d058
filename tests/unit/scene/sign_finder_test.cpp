// What the hands do, as the tracker sees it, through the whole comparison.
#include "noisy_session.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace onestroke {
namespace {

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
                                 Meant{StickPoint::end, StickPoint::end, "Snapshot"},
                                 Meant{StickPoint::arm, StickPoint::arm, "Menu"}};

/// How the right stick comes to touch the left one, in the left one's frame: its rotation, and where its place comes.
struct Placed {
  Quat rotation;
  Vec3 place;
};

Placed placed(StickPoint left, StickPoint right) {
  const Vec3 target = place_of(stick_points, left);
  // It comes from the side and crosses in front.
  if (left == StickPoint::arm) return {exp_so3({0, 0, -std::numbers::pi / 2}), target - Vec3{0, 0, 8}};
  const Vec3 inside{24, -24, 0};
  const Vec3 outwards = -1 * normalized(target - inside), own = place_of(stick_points, right) - inside;
  const bool corners = left == StickPoint::corner && right == StickPoint::corner;
  return {exp_so3({0, 0, std::atan2(outwards.y, outwards.x) - std::atan2(own.y, own.x)}),
          target - (corners ? 18.0 : 6.0) * outwards};
}

/// What was done in a trial, in order, and how far the view came.
std::vector<std::string> done_in_trial(const Meant& meant, std::mt19937& random) {
  std::normal_distribution<double> miss(0, 2);
  std::uniform_real_distribution<double> turn(-0.6, 0.6);
  const auto seed = [&random] { return static_cast<std::uint32_t>(random()); };
  HandMotion left_hand(seed(), -1);
  Session session(seed());
  const Pose left = left_hand.at(0);
  const Placed to = placed(meant.left, meant.right);
  const Quat rotation = left.rotation * to.rotation * exp_so3({turn(random), turn(random), turn(random)});
  const Vec3 target = left * to.place + Vec3{miss(random), miss(random), miss(random)};
  std::vector<std::string> done;
  while (session.seconds() < (meant.twist > 0 ? 6 : 3.5)) {
    const double t = session.seconds(), u = std::min(t / 0.9, 1.0), s = u * u * u * (10 + u * (6 * u - 15));
    const double v = std::clamp((t - 2.8) / 0.8, 0.0, 1.0), twisted = meant.twist * v * v * (3 - 2 * v);
    const Vec3 shake{std::sin(47 * t), std::sin(53 * t + 1), std::sin(61 * t + 2)};
    const Quat q = rotation * exp_so3({0, twisted * std::numbers::pi / 180, 0});
    const Vec3 place = target - rotate(q, place_of(stick_points, meant.right));
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

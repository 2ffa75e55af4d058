// Films of the scripted hands: what the tracker makes of the pictures shows the same touches as the truth does.

#include "camera/open_camera.h"
#include "scene/hands.h"
#include "scene/touch_gesture.h"
#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

namespace onestroke {
namespace {

const Catalog& sticks() {
  static const Catalog catalog = load_catalog(std::string(ONESTROKE_SOURCE_DIR) + "/assets/catalog.json");
  return catalog;
}

StickPoints points_of(int id, const Pose& T_world_marker) {
  const auto spec = std::ranges::find(sticks().markers, id, &MarkerSpec::id);
  const std::vector<Vec3>& vertices = spec->shape.vertices();
  return {T_world_marker * vertices[0], T_world_marker * vertices[1], T_world_marker * vertices[2]};
}

/// The touches of one film as the tracker and as the truth show them.
struct Seen {
  std::vector<Touch> tracked, meant;
  int pictures = 0;
  int held = 0, measured = 0;  // sticks in pictures in which they are together; of these, those that were measured
  int exchanged = 0;           // pictures in which a stick is taken to be in the other hand
};

class Watcher {
 public:
  void take(const FrameRecord& record, std::span<const TrueMarker> truth) {
    ++seen_.pictures;
    const Pose& T_world_camera = record.T_world_camera;
    if (const auto touch =
            true_gesture_.update(std::array{points_of(truth[0].id, T_world_camera * truth[0].T_camera_marker),
                                            points_of(truth[1].id, T_world_camera * truth[1].T_camera_marker)},
                                 record.time)) {
      seen_.meant.push_back(*touch);
    }
    hands_.update(record, record.time);
    const HeldMarker &left = hands_[Hand::left], &right = hands_[Hand::right];
    std::optional<std::array<StickPoints, 2>> points;
    if (left.visible() && right.visible()) {
      points = {points_of(left.id, left.T_world_marker), points_of(right.id, right.T_world_marker)};
    }
    if (const auto touch = gesture_.update(points, record.time)) seen_.tracked.push_back(*touch);
    seen_.exchanged += left.held && left.id != truth[0].id;
    if (!true_gesture_.candidate() && !true_gesture_.held()) return;
    seen_.held += 2;
    seen_.measured +=
        static_cast<int>(std::ranges::count(record.seen(), MarkerState::measured, &MarkerObservation::state));
  }
  const Seen& seen() const { return seen_; }

 private:
  Hands hands_;
  TouchGesture gesture_, true_gesture_;
  Seen seen_;
};

Seen watch(const std::string& script, double seconds) {
  const auto camera =
      open_camera({.spec = "synthetic:fingers=1,noise=2,blur=0.5,width=640,height=360,script=" + script +
                           ",seconds=" + std::to_string(seconds),
                   .fov_rad = {},
                   .calibration = {},
                   .readout = {},
                   .catalog = &sticks()});
  Tracker tracker(sticks());
  Watcher watcher;
  FrameRecord record;
  for (PictureHandle picture; camera->next(picture) == Camera::Status::ok; picture = {}) {
    tracker.process(*picture, record);
    watcher.take(record, camera->truth(*picture));
  }
  return watcher.seen();
}

struct Film {
  const char* script;
  double seconds;
  std::size_t touches;
};

class ModeFilms : public testing::TestWithParam<Film> {};

TEST_P(ModeFilms, ShowTheTouchesThatAreMeant) {
  const Seen seen = watch(GetParam().script, GetParam().seconds);
  EXPECT_EQ(seen.meant.size(), GetParam().touches);
  EXPECT_EQ(seen.tracked, seen.meant);
  EXPECT_EQ(seen.exchanged, 0);
  EXPECT_GE(seen.measured, 0.99 * seen.held);
  std::cout << GetParam().script << ": " << seen.tracked.size() << " touches in " << seen.pictures << " pictures; "
            << seen.measured << " of " << seen.held << " sticks measured while together\n";
}

INSTANTIATE_TEST_SUITE_P(All, ModeFilms,
                         testing::Values(Film{"side", 10, 0}, Film{"link", 13, 1}, Film{"mirror", 13.2, 2},
                                         Film{"overlay", 14, 1}, Film{"section", 14, 2}, Film{"measure", 13.8, 2},
                                         Film{"freeze", 13.4, 2}, Film{"snapshot", 9, 1}, Film{"card", 8.6, 0},
                                         Film{"menu", 13.4, 2}),
                         [](const auto& info) { return std::string(info.param.script); });

}  // namespace
}  // namespace onestroke

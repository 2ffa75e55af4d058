// From pictures to poses to what the wearer sees: the synthetic camera's script, tracked, compared and drawn.
#include "app/model_shelf.h"
#include "app/two_hands.h"
#include "camera/open_camera.h"
#include "golden/stage.h"
#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <numbers>

namespace onestroke {
namespace {

constexpr double degree = std::numbers::pi / 180;
const std::filesystem::path assets = ONESTROKE_SOURCE_DIR "/assets";

// Both sticks are well in the picture and begin to turn.
constexpr int first = 96, count = 40;

class Replay : public golden::Stage {
 protected:
  Replay() {
    for (int i = 0; i < first; ++i) EXPECT_TRUE(take());
    shelf.wait();
  }

  bool take() {
    picture.reset();
    return camera->next(picture) == Camera::Status::ok;
  }

  /// The next picture on its way to the scene.
  const FrameScene& step() {
    EXPECT_TRUE(take());
    tracker.process(*picture, record);
    renderer->set_picture(*picture);
    view = {.T_world_view = picture->T_world_camera,
            .fov = fov_of(picture->intrinsics, picture->width, picture->height),
            .viewport = {0, 0, width, height}};
    return hands.update(record, record.time, {&view, 1}, "");
  }

  golden::Picture drawn(const FrameScene& scene) { return draw(scene, {&view, 1}); }

  const Catalog catalog = load_catalog(assets / "catalog.json");
  const std::unique_ptr<Camera> camera =
      open_camera({.spec = "synthetic:width=960,height=720,fov_deg=50,seed=3,noise=1",
                   .fov_rad = {},
                   .calibration = {},
                   .readout = {},
                   .catalog = &catalog});
  PictureHandle picture;
  Tracker tracker{catalog};
  FrameRecord record;
  ModelShelf shelf{catalog, assets, *renderer};
  TwoHands hands{shelf};
  View view;
};

TEST_F(Replay, PosesAreThoseOfTheScript) {
  int measured = 0;
  for (int i = 0; i < count; ++i) {
    step();
    for (const TrueMarker& truth : camera->truth(*picture))
      for (const MarkerObservation& m : record.seen()) {
        if (m.id != truth.id || m.state != MarkerState::measured) continue;
        ++measured;
        const Pose &found = m.T_camera_marker, &is = truth.T_camera_marker;
        EXPECT_LT(angle_between(found.rotation, is.rotation) / degree, 1) << m.name.data() << " in picture " << i;
        EXPECT_LT(norm(found.translation - is.translation), 0.005 * norm(is.translation))
            << m.name.data() << " in picture " << i;
      }
  }
  EXPECT_GE(measured, 2 * count * 9 / 10);
}

// Wide enough for what a better tracker moves an edge by, narrow enough for a model that stands wrong by a pixel.
constexpr golden::Tolerance tolerance{.level = 24, .pixels = 250};

TEST_F(Replay, ModelsStandOnTheirSticks) {
  hands.toggle_words();
  for (int i = 1; i < count; ++i) step();
  expect_golden("replay_two_hands", drawn(step()), tolerance);
}

TEST_F(Replay, LinkedModelsShowTheSameSide) {
  hands.toggle_words();
  for (int i = 0; i < 10; ++i) step();
  hands.press('l');
  for (int i = 0; i < 10; ++i) step();
  const ComparisonView& compared = hands.comparison();
  ASSERT_EQ(compared.mode.link, Link::same);
  EXPECT_LT(
      angle_between(compared[Hand::left].world_from_marker.rotation, compared[Hand::right].world_from_marker.rotation),
      1e-6);
  expect_golden("replay_linked", drawn(step()), tolerance);
}

TEST_F(Replay, AModelMovesWithItsStickAndNeverJumps) {
  std::array<Similarity, 2> before;
  for (int i = 0; i < count; ++i) {
    step();
    for (const Hand h : both_hands) {
      const HandView& hand = hands.comparison()[h];
      ASSERT_TRUE(hand.held);
      Similarity& last = before[static_cast<std::size_t>(h)];
      if (i > 0) {
        EXPECT_LT(norm(hand.world_from_marker.translation - last.translation), 30) << i;
        EXPECT_LT(angle_between(hand.world_from_marker.rotation, last.rotation) / degree, 12) << i;
      }
      last = hand.world_from_marker;
    }
  }
}

}  // namespace
}  // namespace onestroke

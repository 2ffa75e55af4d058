// A head that moves as told, a stick that stands still, and a camera on the head: what is drawn where the stick is
// found must stay on it, seen through the runtime's own views.
#include "scripted_head.h"

#include "app/frame_feed.h"
#include "app/head_camera.h"
#include "camera/synthetic_camera.h"
#include "display/openxr.h"
#include "golden/solids.h"
#include "marker/catalog.h"
#include "render/renderer.h"
#include "render/target.h"
#include "scene/anchor.h"
#include "scene/frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

namespace onestroke {
namespace {

constexpr double second_turn = 2 * std::numbers::pi;

// Slow enough that the few ms which the head's way through the service takes do not show.
Pose looking_round(double seconds) {
  const double yaw = 0.14 * std::sin(second_turn * seconds / 7), pitch = 0.06 * std::sin(second_turn * seconds / 9);
  return {exp_so3(Vec3{pitch, yaw, 0}),
          {50 * std::sin(second_turn * seconds / 8), -1600 + 15 * std::sin(second_turn * seconds / 6), 0}};
}

// Not in the middle between the eyes, and tilted down.
const Pose T_head_camera{exp_so3(Vec3{-0.12, 0.03, 0.01}), {12, -25, 60}};

struct Spot {
  double u = 0, v = 0;
};

std::optional<Spot> seen(const View& view, Vec3 world) {
  const Vec3 p = inverse(view.T_world_view) * world;
  if (p.z < 1) return std::nullopt;
  const double focal = focal_length_px(view);
  return Spot{(p.x / p.z - view.fov.left) * focal, (p.y / p.z + view.fov.up) * focal};
}

double apart(const View& view, Vec3 a_world, Vec3 b_world) {
  const auto a = seen(view, a_world), b = seen(view, b_world);
  return a && b ? std::hypot(a->u - b->u, a->v - b->v) : INFINITY;
}

/// The program's own way from a camera's picture to a frame, before a head that is told how to move.
class ScriptedHeadTest : public testing::Test {
 protected:
  ScriptedHeadTest() : catalog(load_catalog(ONESTROKE_SOURCE_DIR "/assets/catalog.json")) {
    Gpu gpu({.needs = display.needs(), .validation = true, .validation_messages = &validation_messages});
    display.attach(gpu);
    renderer.emplace(gpu);
    ring = renderer->load(golden::torus(0.02F, 0.006F, {}));
    settle();
    const SyntheticOptions still = parse_synthetic_options("script=still,distance=400,fps=12,live=1");
    camera.emplace(make_synthetic_camera(still, catalog, std::nullopt, {&head, T_head_camera}),
                   HeadMount{&display, T_head_camera});
  }
  ~ScriptedHeadTest() override {
    display.finish();
    renderer.reset();
    EXPECT_EQ(validation_messages, 0);
  }

  /// Lets the runtime show until it knows the head, and finds out where its world lies.
  void settle() {
    const Time until = Time::now() + Duration::from_seconds(60);
    std::optional<Pose> T_world_head;
    for (int frames = 0; frames < 30 && Time::now() < until;) {
      FrameInfo frame = begin();
      if (frame.should_render && renderer->draw({}, frame)) ++frames;
      display.end(frame);
    }
    T_world_head = display.head_at(Time::now());
    ASSERT_TRUE(T_world_head) << "the runtime does not say where the head is";
    head.set_world(*T_world_head * inverse(head.begins_at()));
  }

  FrameInfo begin() {
    display.poll();
    FrameInfo frame;
    display.begin(frame);
    return frame;
  }

  std::atomic<int> validation_messages{0};
  const Catalog catalog;
  ScriptedHead head{looking_round};
  OpenXrDisplay display;
  std::optional<Renderer> renderer;
  ModelHandle ring{};
  std::optional<HeadCamera> camera;
};

TEST_F(ScriptedHeadTest, ModelsStayOnTheStick) {
  // In its script's own world the stick stands still: its first picture tells where.
  Tracker tracker(catalog);
  PictureHandle first;
  ASSERT_EQ(camera->next(first), Camera::Status::ok);
  const Pose T_world_stick = first->T_world_camera * camera->truth(*first)[0].T_camera_marker;
  first.reset();

  TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::newest);
  FrameFeed feed(tracking, Feed::Pace::newest, PictureTime::exposure);
  // The stick's corner, the ends of its arms, and where the model stands.
  const std::array<Vec3, 4> anchors{Vec3{}, Vec3{0, -70, 0}, Vec3{70, 0, 0}, anchor_stand};
  std::vector<double> errors;
  std::vector<Duration> early, late;
  double farthest_turn = 0;
  std::uint64_t sequence = 0, pictures = 0;
  head.move();
  const Time until = Time::now() + Duration::from_seconds(20);
  while (Time::now() < until && !display.closed()) {
    FrameInfo frame = begin();
    feed.advance(frame.time, [] { return false; });
    feed.take_picture();
    const FrameRecord& record = feed.record();
    const MarkerObservation* stick = record.marker_count == 1 ? record.markers.data() : nullptr;
    const bool measured = stick && stick->state == MarkerState::measured;
    const Pose T_world_found = measured ? record.T_world_camera * stick->T_camera_marker : Pose{};
    const glm::mat4 placed = to_graphics(T_world_found);
    ModelInstance model{.model = ring};
    std::copy_n(&placed[0][0], 16, model.world_graphics_from_model.begin());
    if (frame.should_render) {
      const Time first_located = frame.located;
      ASSERT_TRUE(renderer->draw({.instances = std::span(&model, measured ? 1 : 0)}, frame, display));
      early.push_back(Time::now() - first_located);
      late.push_back(Time::now() - frame.located);
    }
    display.end(frame);
    if (!frame.should_render || !measured || !head.on_time(record.time)) continue;
    if (record.sequence != sequence) ++pictures;
    sequence = record.sequence;
    farthest_turn = std::max(farthest_turn, angle_between(record.T_world_camera.rotation, T_head_camera.rotation));
    for (const View& view : frame.seen())
      for (const Vec3 anchor : anchors) errors.push_back(apart(view, T_world_found * anchor, T_world_stick * anchor));
  }
  ASSERT_GT(pictures, 60U);
  EXPECT_GT(farthest_turn, 0.1) << "rad";
  std::ranges::sort(errors);
  std::ranges::sort(early);
  std::ranges::sort(late);
  std::cout << pictures << " pictures, " << errors.size() / 8 << " frames; off the stick by "
            << errors[errors.size() / 2] << " px at the median, " << errors[errors.size() * 99 / 100] << " of 99 %, "
            << errors.back() << " at worst; eyes located " << late[late.size() / 2].ms()
            << " ms before the frame was handed over, and " << early[early.size() / 2].ms()
            << " ms before it at first\n";
  EXPECT_LE(errors.back(), 1);
}

}  // namespace
}  // namespace onestroke

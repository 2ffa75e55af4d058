// Where a model's anchor and its stick's true corner come to lie in the composed picture: of one view from the camera,
// and of two eyes beside it.
#include "app/model_shelf.h"
#include "app/two_hands.h"
#include "camera/open_camera.h"
#include "display/offscreen.h"
#include "golden/solids.h"
#include "render/renderer.h"
#include "scene/frames.h"
#include "tracking/tracker.h"

#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

const std::filesystem::path assets = ONESTROKE_SOURCE_DIR "/assets";
constexpr int width = 960, height = 720;
constexpr float dot_half_size = 0.002F;  // m
constexpr double dot_radius = 2;         // px of the camera's picture

struct Pixel {
  double u = 0, v = 0;
};

Pixel shown_at(const Intrinsics& k, Vec3 point) {
  return {k.fx * point.x / point.z + k.cx, k.fy * point.y / point.z + k.cy};
}

bool well_within(Pixel p) {
  return p.u > 20 && p.v > 20 && p.u < width - 20 && p.v < height - 20;
}

/// A display, and the same grey camera picture over and over, with and without a dot.
class Composed {
 public:
  explicit Composed(int views)
      : views_(views), display_({.width = width * views, .height = height, .views = views, .eye_distance_mm = 63}) {
    Gpu gpu({.needs = display_.needs(), .validation = true, .validation_messages = &messages});
    display_.attach(gpu);
    renderer_.emplace(gpu);
    dot_ = renderer_->load(golden::box({dot_half_size, dot_half_size, dot_half_size},
                                       {.base_color = {0, 0, 0, 1}, .emissive = {1, 1, 1}, .roughness = 1}));
  }

  std::atomic<int> messages{0};

  /// Where the eyes show what the camera saw at a pixel, and where they show a model at a point of the world (mm).
  void find(const Picture& picture, std::span<const DepthSegment> segments, Pixel seen, Vec3 anchor_world,
            std::vector<Pixel>& picture_dots, std::vector<Pixel>& model_dots) {
    const std::vector<std::uint8_t> plain = compose(picture, segments, {}, {});
    picture_dots = centres(plain, compose(picture, segments, seen, {}));
    model_dots = centres(plain, compose(picture, segments, {}, anchor_world));
  }

 private:
  std::vector<std::uint8_t> compose(const Picture& picture, std::span<const DepthSegment> segments,
                                    std::optional<Pixel> dot, std::optional<Vec3> anchor_world) {
    const std::vector<std::uint8_t> grey = painted(dot);
    Picture shown = picture;
    shown.format = PixelFormat::gray8;
    shown.planes = {grey.data(), nullptr};
    shown.strides = {width, 0};
    renderer_->set_picture(shown);
    ModelInstance instance{.model = dot_};
    if (anchor_world) {
      const glm::mat4 at = to_graphics(Pose{{}, *anchor_world});
      std::copy_n(glm::value_ptr(at), 16, instance.world_graphics_from_model.begin());
    }
    FrameInfo frame;
    display_.begin(frame);
    for (View& view : frame.views) {
      view.T_world_view = picture.T_world_camera * view.T_world_view;
      view.fov = fov_of(picture.intrinsics, width, height);
    }
    EXPECT_TRUE(
        renderer_->draw({.passthrough_segments = segments, .instances = {&instance, anchor_world ? 1U : 0U}}, frame));
    display_.end(frame);
    const auto bytes = display_.read_back();
    return {bytes.begin(), bytes.end()};
  }

  static std::vector<std::uint8_t> painted(std::optional<Pixel> dot) {
    std::vector<std::uint8_t> grey(std::size_t{width} * height, 40);
    if (!dot) return grey;
    constexpr int reach = 12;
    const int left = static_cast<int>(dot->u), top = static_cast<int>(dot->v);
    for (int y = top - reach; y <= top + reach; ++y)
      for (int x = left - reach; x <= left + reach; ++x) {
        const double r2 = std::pow(x + 0.5 - dot->u, 2) + std::pow(y + 0.5 - dot->v, 2);
        const double light = 200 * std::exp(-r2 / (2 * dot_radius * dot_radius));
        grey[static_cast<std::size_t>(y * width + x)] = static_cast<std::uint8_t>(std::lround(40 + light));
      }
    return grey;
  }

  /// The centre of what differs, in each view.
  std::vector<Pixel> centres(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) const {
    std::vector<Pixel> found;
    for (int view = 0; view < views_; ++view) {
      double sum = 0, u = 0, v = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const auto at = static_cast<std::size_t>(4 * (y * width * views_ + view * width + x));
          const double light = std::abs(b[at + 1] - a[at + 1]);
          if (light < 3) continue;
          sum += light;
          u += light * (x + 0.5);
          v += light * (y + 0.5);
        }
      found.push_back({u / sum, v / sum});
    }
    return found;
  }

  const int views_;
  OffscreenDisplay display_;
  std::optional<Renderer> renderer_;
  ModelHandle dot_{};
};

/// What one view has to show for all pictures: px.
struct Tally {
  std::vector<double> apart;  // the model's anchor from the stick's true corner
  double worst_own = 0;       // the same without what the tracker was off by

  void add(Pixel truth, Pixel shown, Pixel tracker_off) {
    const double u = shown.u - truth.u, v = shown.v - truth.v;
    apart.push_back(std::hypot(u, v));
    worst_own = std::max(worst_own, std::hypot(u - tracker_off.u, v - tracker_off.v));
  }
  void check(const char* view) {
    std::sort(apart.begin(), apart.end());
    const auto beyond = apart.end() - std::upper_bound(apart.begin(), apart.end(), 0.5);
    std::printf("%s: %zu anchors, median %.3f px, worst %.3f, %td beyond 0.5, without the tracker's part %.3f\n", view,
                apart.size(), apart[apart.size() / 2], apart.back(), beyond, worst_own);
    EXPECT_LT(worst_own, 0.25) << view;
    EXPECT_EQ(beyond, 0) << view;
  }
};

/// How far the tracker has the corners of the sticks that it measures from the true ones, in every picture: px.
class Corners {
 public:
  void add(const Picture& picture, std::span<const TrueMarker> truth, const FrameRecord& record) {
    for (const TrueMarker& t : truth) {
      const auto own = std::ranges::find(record.seen(), t.id, &MarkerObservation::id);
      const Pixel is = shown_at(picture.intrinsics, t.T_camera_marker.translation);
      if (!well_within(is)) continue;
      if (own == record.seen().end() || own->state != MarkerState::measured) {
        ++missed_;
        continue;
      }
      const Pixel found = shown_at(picture.intrinsics, own->T_camera_marker.translation);
      off_.push_back(std::hypot(found.u - is.u, found.v - is.v));
    }
  }
  void check() {
    std::sort(off_.begin(), off_.end());
    std::printf("the tracker's corners: %zu, median %.3f px, 99 %% %.3f, worst %.3f; %d not measured\n", off_.size(),
                off_[off_.size() / 2], off_[off_.size() * 99 / 100], off_.back(), missed_);
    EXPECT_LT(off_.back(), 0.5);
    EXPECT_LT(missed_, 15);
    EXPECT_GT(off_.size(), 1200U);
  }

 private:
  std::vector<double> off_;
  int missed_ = 0;
};

TEST(Registration, AnchorsStayOnTheCornersOfTheirSticksInEveryView) {
  const Catalog catalog = load_catalog(assets / "catalog.json");
  const auto camera = open_camera({.spec = "synthetic:width=960,height=720,fov_deg=50,fingers=1,noise=2,blur=0.5",
                                   .fov_rad = {},
                                   .calibration = {},
                                   .readout = {},
                                   .catalog = &catalog});
  Composed mono(1), stereo(2);
  Gpu gpu(GpuOptions{});
  Renderer renderer(gpu);
  const ModelShelf shelf(catalog, assets, renderer);
  TwoHands hands(shelf);
  Tracker tracker(catalog);
  FrameRecord record;
  Tally one, left, right;
  Corners corners;
  constexpr int length = 24 * 30, every = 36;
  for (int i = 0; i < length; ++i) {
    PictureHandle picture;
    ASSERT_EQ(camera->next(picture), Camera::Status::ok);
    tracker.process(*picture, record);
    corners.add(*picture, camera->truth(*picture), record);
    const View view{.T_world_view = picture->T_world_camera,
                    .fov = fov_of(picture->intrinsics, width, height),
                    .viewport = {0, 0, width, height}};
    const FrameScene& scene = hands.update(record, record.time, {&view, 1}, "");
    if (i % every != 0) continue;
    for (const HandView& hand : hands.comparison().hands) {
      if (!hand.held || hand.state != MarkerState::measured) continue;
      // A linked model that follows the other stick has its corner elsewhere.
      const auto own = std::ranges::find(record.seen(), hand.marker_id, &MarkerObservation::id);
      const Pose T_world_marker = record.T_world_camera * own->T_camera_marker;
      if (angle_between(T_world_marker.rotation, hand.world_from_marker.rotation) > 1e-6) continue;
      const auto truth = std::ranges::find(camera->truth(*picture), hand.marker_id, &TrueMarker::id);
      ASSERT_NE(truth, camera->truth(*picture).end());
      const Pixel seen = shown_at(picture->intrinsics, truth->T_camera_marker.translation);
      if (!well_within(seen)) continue;
      const Pixel found = shown_at(picture->intrinsics, own->T_camera_marker.translation);
      const Pixel off{found.u - seen.u, found.v - seen.v};
      std::vector<Pixel> is, shown;
      mono.find(*picture, scene.passthrough_segments, seen, hand.world_from_marker.translation, is, shown);
      one.add(is[0], shown[0], off);
      stereo.find(*picture, scene.passthrough_segments, seen, hand.world_from_marker.translation, is, shown);
      left.add(is[0], shown[0], off);
      right.add(is[1], shown[1], off);
    }
  }
  ASSERT_GE(one.apart.size(), 25U);
  one.check("one view");
  left.check("left eye");
  right.check("right eye");
  corners.check();
  EXPECT_EQ(mono.messages + stereo.messages, 0);
}

}  // namespace
}  // namespace onestroke

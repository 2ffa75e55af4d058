// A display whose views move once more when a frame has been recorded: the picture is the one that the moved views see.
#include "golden/solids.h"
#include "golden/stage.h"

namespace onestroke::golden {
namespace {

/// Says where the views are by now, and nothing else.
class Latecomer final : public Display {
 public:
  explicit Latecomer(std::span<const View> views) : views_(views) {}

  bool move_views(FrameInfo& frame) override {
    std::copy(views_.begin(), views_.end(), frame.views.begin());
    return !views_.empty();
  }
  GpuNeeds needs() const override { return {}; }
  void attach(Gpu&) override {}
  void begin(FrameInfo&) override {}
  void end(const FrameInfo&) override {}
  std::span<const Key> poll() override { return {}; }
  bool closed() const override { return false; }
  bool tracks_head() const override { return true; }
  void finish() override {}

 private:
  std::span<const View> views_;
};

class LateViews : public StereoStage {
 protected:
  /// Three frames, recorded as seen from `early` and moved to `late`.
  Picture draw_late(const FrameScene& scene, std::span<const View> early, std::span<const View> late) {
    Latecomer latecomer(late);
    for (int i = 0; i < 3; ++i) {
      FrameInfo frame;
      display_->begin(frame);
      std::copy(early.begin(), early.end(), frame.views.begin());
      EXPECT_TRUE(renderer->draw(scene, frame, latecomer)) << renderer->failure();
      display_->end(frame);
    }
    return from_rgba(width * views_, height, display_->read_back());
  }

  std::array<View, 2> eyes(Vec3 turn) const {
    std::array<View, 2> views;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double aside = i == 0 ? -32 : 32;
      views[i].T_world_view = Pose{exp_so3(turn), {}} * Pose{{}, {aside, 0, 0}};
      views[i].fov = fov_of(Intrinsics::from_fov(width, height, fov), width, height);
      views[i].viewport = {0, 0, width, height};
    }
    return views;
  }
};

TEST_F(LateViews, AreTheOnesThatAreSeen) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const std::array instances{ModelInstance{.model = renderer->load(torus(0.04F, 0.016F, {})),
                                           .world_graphics_from_model = placed(0, 0, -0.4F, -0.6F, 0.3F)}};
  const FrameScene scene{.instances = instances};
  // About 10 pixels: the model's edge leaves the rectangle that it was expected in.
  const auto early = eyes({}), late = eyes({0.012, -0.015, 0.004});
  const Picture expected = draw(scene, late);
  const auto moved = compare(expected, draw_late(scene, early, late), {.level = 1, .pixels = 20});
  EXPECT_TRUE(moved.same) << moved.words;
  EXPECT_FALSE(compare(expected, draw_late(scene, early, {}), {.level = 1, .pixels = 2000}).same);
}

}  // namespace
}  // namespace onestroke::golden

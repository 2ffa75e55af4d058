// What Monado's simulated headset lacks, put before it: blend modes, passthrough, and a wearer who
// recentres and leaves.
#include "altered_runtime.h"
#include "headset/headset.h"

#include <dlfcn.h>

#include <cmath>

namespace onestroke {
namespace {

/// A function of the altered runtime's, which is in this program.
template <typename Function>
Function* altered(const char* name) {
  void* runtime = dlopen(ALTERED_RUNTIME, RTLD_NOW | RTLD_NOLOAD);
  return reinterpret_cast<Function*>(dlsym(runtime, name));
}

using Recentred = Headset;

TEST_F(Recentred, TheWorldStaysWhereItIs) {
  show(10);
  altered<decltype(altered_runtime_recentre)>("altered_runtime_recentre")();
  double apart = 0;
  int remembered = 0;
  for (const auto& [frame, head] : show_and_ask(60)) {
    ++remembered;
    const Pose &left = frame.views[0].T_world_view, &right = frame.views[1].T_world_view;
    apart = std::max(apart, norm(head.translation - 0.5 * (left.translation + right.translation)));
  }
  const auto [fastest, farthest] = fastest_and_farthest(shown);
  EXPECT_GT(farthest, 20) << "mm";
  EXPECT_LT(fastest, 1000) << "mm/s";
  EXPECT_GT(remembered, 40);
  EXPECT_LT(apart, 5) << "mm";
}

using AskedToLeave = Headset;

TEST_F(AskedToLeave, EndsPlainly) {
  show(10);
  altered<decltype(altered_runtime_ask_to_leave)>("altered_runtime_ask_to_leave")();
  for (const Time until = Time::now() + longest_show; !display->closed() && Time::now() < until;) blink();
  EXPECT_TRUE(display->closed());
  EXPECT_NO_THROW(display->finish());
}

class SeeThrough : public Headset {
 protected:
  void SetUp() override {}
  /// A few frames with this behind them, from the program's start to its end.
  AlteredFrame shown_before(World world) {
    options.world = world;
    display.emplace(options);
    start();
    show(5, {0, 0, 0, 0});
    EXPECT_EQ(display->shows_world(), world != World::camera);
    EXPECT_EQ(objects(), world == World::passthrough ? 2 : 0);
    const AlteredFrame frame = altered<decltype(altered_runtime_last_frame)>("altered_runtime_last_frame")();
    display->finish();
    EXPECT_EQ(objects(), 0);
    renderer.reset();
    display.reset();
    return frame;
  }
  static int objects() {
    return altered<decltype(altered_runtime_passthrough_objects)>("altered_runtime_passthrough_objects")();
  }
};

TEST_F(SeeThrough, FramesAreBlendedAsWasAskedFor) {
  for (const auto& [world, mode] : {std::pair{World::camera, XR_ENVIRONMENT_BLEND_MODE_OPAQUE},
                                    std::pair{World::alpha, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND},
                                    std::pair{World::additive, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE},
                                    std::pair{World::passthrough, XR_ENVIRONMENT_BLEND_MODE_OPAQUE}}) {
    SCOPED_TRACE(std::string(name_of(world)));
    const AlteredFrame frame = shown_before(world);
    EXPECT_EQ(frame.blend_mode, mode);
    EXPECT_EQ(frame.layers, world == World::passthrough ? 2U : 1U);
    EXPECT_EQ(frame.passthrough_first, world == World::passthrough);
    EXPECT_EQ(frame.views_with_depth, 2);
    EXPECT_TRUE(std::isinf(frame.near_z)) << "reverse depth: infinity at 0";
    EXPECT_NEAR(frame.far_z, 0.02, 1e-6) << "m, at 1";
    EXPECT_EQ(frame.projection_flags, world == World::camera ? 0 : XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT);
  }
}

}  // namespace
}  // namespace onestroke

// Models in the light of what the camera sees.
#include "golden/solids.h"
#include "golden/stage.h"

#include <cmath>
#include <random>

namespace onestroke::golden {
namespace {

/// A wall of one colour with a bright window on the left, and noise.
struct Room {
  std::vector<std::uint8_t> bytes;
  onestroke::Picture picture;

  Room(int width, int height, std::array<double, 3> wall, double window, double noise) {
    std::minstd_rand random(5);
    std::normal_distribution<double> level(0, noise);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (const double c : wall) {
          const double light = x < width / 5 && y < height / 2 ? window : c;
          bytes.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(light + level(random)), 0L, 255L)));
        }
    picture.width = width;
    picture.height = height;
    picture.planes[0] = bytes.data();
    picture.strides[0] = std::size_t{3} * static_cast<std::size_t>(width);
    picture.intrinsics = Intrinsics::from_fov(width, height, 0.9);
  }
  Room(const Room&) = delete;
};

class InTheRoom : public Stage {
 protected:
  Picture seen_in(const Room& room) {
    renderer->set_picture(room.picture);
    const auto white = renderer->load(torus(0.05F, 0.025F, {.metallic = 0, .roughness = 0.7F}));
    const auto steel = renderer->load(torus(0.05F, 0.025F, {.metallic = 1, .roughness = 0.25F}));
    const std::array instances{
        ModelInstance{.model = white, .world_graphics_from_model = placed(-0.06F, 0, -0.4F, -0.6F, 0.3F)},
        ModelInstance{.model = steel, .world_graphics_from_model = placed(0.09F, 0, -0.4F, -0.5F, -0.4F)}};
    return draw({.instances = instances});
  }

  /// The mean of a channel over what is not the wall: the middle of the white ring's left side.
  double brightness(const Picture& p, int channel) const {
    double sum = 0;
    int count = 0;
    for (int y = 150; y < 210; ++y)
      for (int x = 125; x < 150; ++x, ++count) sum += p.at(x, y)[channel];
    return sum / count;
  }
};

TEST_F(InTheRoom, DaylightIsWhite) {
  const Room room(width, height, {120, 120, 122}, 255, 0);
  const Picture p = seen_in(room);
  EXPECT_NEAR(brightness(p, 0), brightness(p, 2), 12);
  expect_golden("light_day", p, {.level = 3, .pixels = 60});
}

TEST_F(InTheRoom, LampLightIsWarm) {
  const Room room(width, height, {150, 105, 60}, 235, 0);
  const Picture p = seen_in(room);
  EXPECT_GT(brightness(p, 0), brightness(p, 2) + 25);
  expect_golden("light_warm", p, {.level = 3, .pixels = 60});
}

TEST_F(InTheRoom, DuskIsDarkAndHasGrain) {
  const Room room(width, height, {30, 32, 38}, 60, 5);
  const Picture p = seen_in(room);
  EXPECT_LT(brightness(p, 1), 110);
  expect_golden("light_dusk", p, {.level = 3, .pixels = 60});
}

// A shadow that is there when they touch, fades as they part, and is gone when they are apart.
TEST_F(InTheRoom, ModelsThatComeNearDarkenEachOther) {
  const Room room(width, height, {120, 120, 122}, 120, 0);
  renderer->set_picture(room.picture);
  const auto slab = renderer->load(box({0.06F, 0.006F, 0.06F}, {.metallic = 0, .roughness = 0.8F}));
  const auto ring =
      renderer->load(torus(0.022F, 0.012F, {.base_color = {0.8F, 0.2F, 0.1F, 1}, .metallic = 0, .roughness = 0.5F}));
  const auto drawn_at = [&](float height_above) {
    const std::array instances{
        ModelInstance{.model = slab, .world_graphics_from_model = placed(0, -0.05F, -0.4F, 0.5F, 0)},
        ModelInstance{.model = ring, .world_graphics_from_model = placed(0, -0.03F + height_above, -0.39F, 2.0F, 0)}};
    return draw({.instances = instances});
  };
  // On the slab, just in front of the ring.
  const auto level = [](const Picture& p) { return int{p.at(width / 2, 256)[1]}; };
  const Picture touching = drawn_at(0), apart = drawn_at(0.05F), far = drawn_at(0.6F);
  EXPECT_LT(level(touching), level(apart) - 5);
  EXPECT_LT(level(apart), level(far));
  expect_golden("contact_shadow", touching, {.level = 3, .pixels = 60});
}

}  // namespace
}  // namespace onestroke::golden

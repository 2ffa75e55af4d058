#include "render/room_light.h"

#include "core/srgb.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>
#include <random>

namespace onestroke {
namespace {

constexpr int width = 320, height = 240;

/// A picture made by formula, with the memory behind it.
struct Painted {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(std::size_t{3} * width * height);
  Picture picture;

  explicit Painted(const std::function<Rgb(int, int)>& coded) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Rgb c = coded(x, y);
        for (std::size_t i = 0; i < 3; ++i)
          bytes[static_cast<std::size_t>(3 * (y * width + x)) + i] =
              static_cast<std::uint8_t>(std::lround(255 * std::clamp(c[i], 0.0F, 1.0F)));
      }
    picture.width = width;
    picture.height = height;
    picture.planes[0] = bytes.data();
    picture.strides[0] = 3 * width;
    picture.intrinsics = Intrinsics::from_fov(width, height, 1.2);
  }
  Painted(const Painted&) = delete;
};

glm::vec3 matt(const RoomLight& light, const glm::vec3& n) {
  const auto& m = light.matt();
  return m[0] + m[1] * n.y + m[2] * n.z + m[3] * n.x + m[4] * (n.x * n.y) + m[5] * (n.y * n.z) +
         m[6] * (3 * n.z * n.z - 1) + m[7] * (n.x * n.z) + m[8] * (n.x * n.x - n.y * n.y);
}

std::unique_ptr<RoomLight> light_of(const std::function<Rgb(int, int)>& coded) {
  const Painted painted(coded);
  auto light = std::make_unique<RoomLight>();
  light->see(painted.picture);
  return light;
}

const std::array<glm::vec3, 6> sides{glm::vec3(1, 0, 0),  glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                                     glm::vec3(0, -1, 0), glm::vec3(0, 0, 1),  glm::vec3(0, 0, -1)};

TEST(CubeDirections, GoToTheTexelsTheyCameFrom) {
  for (const int side : {1, 4, 32})
    for (std::size_t i = 0; i < cube_texels(side); ++i) EXPECT_EQ(cube_texel(cube_direction(i, side), side), i);
}

TEST(CubeDirections, CoverTheSphereOnce) {
  float sum = 0;
  for (std::size_t i = 0; i < cube_texels(32); ++i) sum += cube_solid_angle(i, 32);
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 0.01);
}

TEST(RoomLight, IsWhatALampOverheadSaysOfMattSurfaces) {
  // E / pi on a surface that faces a uniform upper half of radiance L is L, that faces away is 0, upright L / 2.
  const auto light = std::make_unique<RoomLight>();
  light->set({.key = {0, 0, 0, 1}, .sky = {1, 1, 1, 1}, .ground = {0, 0, 0, 1}});
  // The light goes over from ground to sky in proportion to the height: 1/2 + y/2, whose cosine average is 1/2 + y/3.
  EXPECT_NEAR(matt(*light, {0, 1, 0}).x, 5.0 / 6, 0.01);
  EXPECT_NEAR(matt(*light, {0, -1, 0}).x, 1.0 / 6, 0.01);
  EXPECT_NEAR(matt(*light, {1, 0, 0}).x, 0.5, 0.01);
}

TEST(RoomLight, HasTheColourOfTheRoomAndAsMuchLightAsItsWallsThrowBack) {
  const Rgb coded{0.6F, 0.5F, 0.4F};
  const Rgb wall = linear_of(coded);
  const auto light = light_of([&](int, int) { return coded; });
  glm::vec3 mean(0);
  for (const glm::vec3& n : sides) {
    const glm::vec3 m = matt(*light, n);
    mean += m / 6.0F;
    EXPECT_NEAR(m.x / m.y, wall[0] / wall[1], 0.02);
    EXPECT_NEAR(m.z / m.y, wall[2] / wall[1], 0.02);
    EXPECT_GT(m.y, wall[1]);
  }
  // A white surface among walls that throw back 45 % is so much brighter than they are.
  EXPECT_NEAR(mean.y, wall[1] / 0.45F, 0.1F * wall[1]);
  EXPECT_EQ(light->key(), glm::vec3(0));
}

TEST(RoomLight, IsTwiceAsBrightInARoomThatIs) {
  constexpr float low = 77.0F / 255, high = 153.0F / 255;
  const auto dim = light_of([](int, int) { return Rgb{low, low, low}; });
  const auto bright = light_of([](int, int) { return Rgb{high, high, high}; });
  const float ratio = linear_from_srgb(high) / linear_from_srgb(low);
  for (const glm::vec3& n : sides) EXPECT_NEAR(matt(*bright, n).x / matt(*dim, n).x, ratio, 0.05);
}

TEST(RoomLight, ComesFromWhereItIsBright) {
  const auto light = light_of([](int x, int) { return x < width / 2 ? Rgb{0.7F, 0.7F, 0.7F} : Rgb{0.2F, 0.2F, 0.2F}; });
  EXPECT_GT(matt(*light, {-1, 0, 0}).x, 1.5F * matt(*light, {1, 0, 0}).x);
  EXPECT_GT(matt(*light, {0, 1, 0}).x, matt(*light, {0, -1, 0}).x);
}

TEST(RoomLight, FindsALampAndItsDirection) {
  // Up and to the left of the middle, pixels that are full.
  const auto light = light_of([](int x, int y) {
    return std::hypot(x - 60, y - 40) < 25 ? Rgb{1, 1, 1} : Rgb{0.25F, 0.25F, 0.25F};
  });
  const Intrinsics k = Intrinsics::from_fov(width, height, 1.2);
  const glm::vec3 there = glm::normalize(glm::vec3((60 - k.cx) / k.fx, -(40 - k.cy) / k.fy, -1));  // graphics axes
  EXPECT_GT(light->key().x, 0.05F);
  EXPECT_GT(glm::dot(light->to_key(), there), 0.97F);
}

TEST(RoomLight, FollowsTheHeadAndKeepsWhatItSaw) {
  // A room that is red ahead and blue behind, seen one after the other.
  const auto light = std::make_unique<RoomLight>();
  Painted ahead([](int, int) { return Rgb{0.7F, 0.1F, 0.1F}; }), behind([](int, int) { return Rgb{0.1F, 0.1F, 0.7F}; });
  light->see(ahead.picture);
  behind.picture.T_world_camera.rotation = exp_so3({0, std::numbers::pi, 0});
  behind.picture.exposure.start.ns = 1'000'000'000;
  light->see(behind.picture);
  // Vision's ahead is graphics' -z.
  EXPECT_GT(matt(*light, {0, 0, -1}).x, 2 * matt(*light, {0, 0, -1}).z);
  EXPECT_GT(matt(*light, {0, 0, 1}).z, 2 * matt(*light, {0, 0, 1}).x);
}

TEST(RoomLight, FollowsTheExposureWhereItDoesNotLook) {
  const auto light = std::make_unique<RoomLight>();
  Painted grey([](int, int) { return Rgb{0.5F, 0.5F, 0.5F}; }), dark([](int, int) { return Rgb{0.25F, 0.25F, 0.25F}; });
  light->see(grey.picture);
  const float before = matt(*light, {0, 0, 1}).x;
  for (int i = 1; i <= 20; ++i) {
    dark.picture.exposure.start.ns = 200'000'000L * i;
    light->see(dark.picture);
  }
  EXPECT_NEAR(matt(*light, {0, 0, 1}).x / before, linear_from_srgb(0.25F) / linear_from_srgb(0.5F), 0.05);
}

TEST(RoomLight, KeepsItsEnergyFromSharpToBlurred) {
  const auto light = light_of([](int x, int y) {
    return x > 200 && y < 100 ? Rgb{0.9F, 0.8F, 0.6F} : Rgb{0.3F, 0.3F, 0.4F};
  });
  std::array<float, RoomLight::levels> energy{};
  for (int level = 0; level < RoomLight::levels; ++level) {
    float sum = 0, whole = 0;
    for (std::size_t i = 0; i < light->mirrored(level).size(); ++i) {
      const float angle = cube_solid_angle(i, RoomLight::side >> level);
      sum += angle * light->mirrored(level)[i].y;
      whole += angle;
    }
    energy[static_cast<std::size_t>(level)] = sum / whole;
  }
  for (std::size_t level = 0; level < energy.size(); ++level)
    EXPECT_NEAR(energy[level] / energy[0], 1, 0.06) << "level " << level;
}

TEST(PictureSamples, MeasureTheNoiseAndNotTheScene) {
  std::mt19937 random(3);
  for (const float levels : {1.5F, 3.0F, 6.0F}) {
    std::normal_distribution<float> noise(0, levels / 255);
    const Painted scene([&](int x, int y) {
      const float base =
          0.3F + 0.001F * static_cast<float>(x) + (x / 60 % 2 ? 0.15F : 0.0F) + 0.0005F * static_cast<float>(y);
      return Rgb{base + noise(random), base + noise(random), base + noise(random)};
    });
    EXPECT_NEAR(255 * noise_of(scene.picture), levels, 0.2F * levels);
  }
  const Painted clean([](int x, int y) { return Rgb{x / 60 % 2 ? 0.7F : 0.2F, y / 60 % 2 ? 0.6F : 0.3F, 0.5F}; });
  EXPECT_EQ(noise_of(clean.picture), 0);
}

TEST(PictureSamples, ReadEveryFormat) {
  // A pixel of Y 120, U 90, V 170.
  const std::array<std::uint8_t, 8> nv12_y{16, 120, 16, 16, 16, 16, 16, 16};
  const std::array<std::uint8_t, 4> nv12_uv{90, 170, 128, 128}, yuyv{16, 90, 120, 170};
  Picture nv12, packed;
  nv12.format = PixelFormat::nv12;
  nv12.width = 4;
  nv12.height = 2;
  nv12.planes = {nv12_y.data(), nv12_uv.data()};
  nv12.strides = {4, 4};
  packed.format = PixelFormat::yuyv;
  packed.width = 2;
  packed.height = 1;
  packed.planes[0] = yuyv.data();
  packed.strides[0] = 4;
  const std::array<float, 3> wanted{(1.164383F * 104 + 1.596027F * 42) / 255,
                                    (1.164383F * 104 - 0.391762F * -38 - 0.812968F * 42) / 255,
                                    (1.164383F * 104 + 2.017232F * -38) / 255};
  for (const Picture* p : {&nv12, &packed}) {
    const Rgb is = coded_at(*p, 1, 0);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-3);
    EXPECT_EQ(brightness_at(*p, 1, 0), 120);
  }
}

}  // namespace
}  // namespace onestroke

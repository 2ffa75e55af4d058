#include "camera/side_by_side_camera.h"
#include "core/picture_pool.h"
#include "scene_fixture.h"

#include <gmock/gmock.h>

#include <array>
#include <numeric>

namespace onestroke::test {
namespace {

const Pose T_first_second{{}, {63, 0, 0}};

/// One picture of a format, whose bytes count up.
class Wide final : public Camera {
 public:
  Wide(PixelFormat format, int width) : pool_(2, 4096), format_(format), width_(width) {}

  Status next(PictureHandle& picture) override {
    PictureHandle::Loan* loan = pool_.acquire();
    if (!loan) return Status::busy;
    const auto bytes = pool_.bytes(*loan);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    Picture& p = loan->picture;
    p.width = width_;
    p.height = 4;
    p.format = format_;
    p.planes = {bytes.data(), format_ == PixelFormat::nv12 ? bytes.data() + 1024 : nullptr};
    p.strides = {128, 128};
    p.sequence = 5;
    p.T_world_camera = {{}, {1, 2, 3}};
    p.jpeg = bytes.first(7);
    p.intrinsics = Intrinsics::from_fov(width_, 4, 2);
    picture = PictureHandle(*loan);
    return Status::ok;
  }
  std::string message() const override { return "gone"; }
  bool live() const override { return true; }
  double rate() const override { return 60; }
  std::size_t length() const override { return 0; }
  std::string_view trouble() const override { return "trouble"; }
  std::uint64_t lost() const override { return 9; }
  std::size_t lent() const { return pool_.lent(); }

 private:
  PicturePool pool_;
  PixelFormat format_;
  int width_;
};

std::array<LensSource, 2> lenses() {
  return {LensSource({}, 1.0), LensSource({}, 1.2)};
}

TEST(SideBySide, EachHalfIsAPictureOfTheSameBytes) {
  struct Case {
    PixelFormat format;
    std::size_t across, chroma_across;
  };
  for (const Case& c : {Case{PixelFormat::rgb8, 48, 0}, Case{PixelFormat::gray8, 16, 0}, Case{PixelFormat::yuyv, 32, 0},
                        Case{PixelFormat::nv12, 16, 16}}) {
    auto wide = std::make_unique<Wide>(c.format, 32);
    const Wide& source = *wide;
    SideBySideCamera camera(std::move(wide), lenses(), T_first_second);
    PictureHandle pair = take(camera);
    ASSERT_TRUE(pair);
    ASSERT_TRUE(pair->second);
    const Picture &left = *pair, &right = *pair->second;
    for (const Picture* half : {&left, &right}) {
      EXPECT_EQ(half->width, 16);
      EXPECT_EQ(half->height, 4);
      EXPECT_EQ(half->format, c.format);
      EXPECT_EQ(half->strides[0], 128u);
      EXPECT_TRUE(half->jpeg.empty());
      EXPECT_EQ(half->sequence, 5u);
    }
    EXPECT_EQ(right.planes[0], left.planes[0] + c.across);
    EXPECT_EQ(right.planes[0][0], static_cast<std::uint8_t>(c.across));
    if (c.format == PixelFormat::nv12)
      EXPECT_EQ(right.planes[1], left.planes[1] + c.chroma_across);
    else
      EXPECT_EQ(right.planes[1], nullptr);
    EXPECT_DOUBLE_EQ(left.intrinsics.fx, Intrinsics::from_fov(16, 4, 1.0).fx);
    EXPECT_DOUBLE_EQ(right.intrinsics.fx, Intrinsics::from_fov(16, 4, 1.2).fx);
    EXPECT_DOUBLE_EQ(right.intrinsics.cx, 8);
    EXPECT_EQ(right.T_world_camera.translation, (Vec3{64, 2, 3}));
    EXPECT_EQ(source.lent(), 1u);
    pair.reset();
    EXPECT_EQ(source.lent(), 0u);
  }
}

TEST(SideBySide, IsOtherwiseTheCameraItself) {
  const SideBySideCamera camera(std::make_unique<Wide>(PixelFormat::rgb8, 32), lenses(), T_first_second);
  EXPECT_TRUE(camera.live());
  EXPECT_EQ(camera.rate(), 60);
  EXPECT_EQ(camera.message(), "gone");
  EXPECT_EQ(camera.trouble(), "trouble");
  EXPECT_EQ(camera.lost(), 9u);
}

TEST(SideBySide, RefusesWhatCannotBeHalved) {
  for (const auto& [format, width] : {std::pair{PixelFormat::rgb8, 31}, std::pair{PixelFormat::yuyv, 30}}) {
    auto wide = std::make_unique<Wide>(format, width);
    const Wide& source = *wide;
    SideBySideCamera camera(std::move(wide), lenses(), T_first_second);
    PictureHandle none;
    EXPECT_EQ(camera.next(none), Camera::Status::end);
    EXPECT_THAT(camera.message(), testing::HasSubstr("cannot be those of two eyes side by side"));
    EXPECT_EQ(source.lent(), 0u);
    EXPECT_EQ(camera.next(none), Camera::Status::end);
  }
}

TEST(SideBySide, RefusesALensOfAnotherSize) {
  const Intrinsics k = Intrinsics::from_fov(640, 480, 1);
  const LensSource other("rig.yml", k, 640, 480);
  SideBySideCamera camera(std::make_unique<Wide>(PixelFormat::rgb8, 32), {other, other}, T_first_second);
  PictureHandle none;
  EXPECT_EQ(camera.next(none), Camera::Status::end);
  EXPECT_THAT(camera.message(), testing::HasSubstr("rig.yml is for pictures of 640 x 480"));
}

}  // namespace
}  // namespace onestroke::test

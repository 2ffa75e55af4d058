#include "render/finger_matte.h"

#include <gtest/gtest.h>

#include <memory>

namespace onestroke {
namespace {

constexpr int width = 640, height = 480;
using Bytes = std::array<std::uint8_t, 3>;

constexpr Bytes wall{120, 125, 130}, red_paint{190, 30, 25}, light_skin{224, 172, 150}, dark_skin{110, 72, 55};

/// A grey wall with a rod of paint across the middle row.
struct Scene {
  std::vector<std::uint8_t> bytes;
  Picture picture;

  Scene() {
    for (int i = 0; i < width * height; ++i) bytes.insert(bytes.end(), wall.begin(), wall.end());
    picture.width = width;
    picture.height = height;
    picture.strides[0] = 3 * width;
    picture.planes[0] = bytes.data();
    picture.intrinsics = Intrinsics::from_fov(width, height, 0.9);
    fill(100, 232, 540, 248, red_paint);
  }
  Scene(const Scene&) = delete;
  void fill(int left, int top, int right, int bottom, Bytes color) {
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) std::copy(color.begin(), color.end(), bytes.begin() + 3 * (y * width + x));
  }
};

/// Rings of a stick at 450 mm whose middles are seen from pixel `left` to `right` of the middle row.
std::vector<CoveredCell> cells_between(const Picture& p, int left, int right, int stick = 1) {
  std::vector<CoveredCell> cells;
  for (int u = left; u <= right; u += 8)
    cells.push_back({{(u - p.intrinsics.cx) / p.intrinsics.fx * 450, 0.5 / p.intrinsics.fy * 450, 450}, stick});
  return cells;
}

class Matte : public testing::Test {
 protected:
  int at(int u, int v) const {
    const auto s = matte->scale();
    return matte->alpha()[static_cast<std::size_t>(v / s * FingerMatte::side + u / s)];
  }
  Scene scene;
  const std::unique_ptr<FingerMatte> matte = std::make_unique<FingerMatte>();
};

TEST_F(Matte, TakesAFingerAndNothingElse) {
  for (const Bytes& skin : {light_skin, dark_skin}) {
    scene.fill(300, 200, 340, 300, skin);
    matte->find(scene.picture, cells_between(scene.picture, 306, 334));
    ASSERT_EQ(matte->fingers().size(), 1U);
    EXPECT_EQ(at(320, 240), 255);
    EXPECT_EQ(at(320, 210), 255);
    EXPECT_EQ(at(320, 290), 255);
    EXPECT_EQ(at(200, 240), 0);  // paint
    EXPECT_EQ(at(320, 150), 0);  // wall
    const auto& f = matte->fingers()[0];
    EXPECT_NEAR(f.left, 300, 8);
    EXPECT_NEAR(f.right, 340, 8);
    EXPECT_NEAR(f.top, 200, 8);
    EXPECT_NEAR(f.bottom, 300, 8);
    EXPECT_LT(f.depth, 450);
    EXPECT_GT(f.depth, 430);
  }
}

TEST_F(Matte, DoesNotTakeTheStickForAFinger) {
  matte->find(scene.picture, cells_between(scene.picture, 306, 334));
  EXPECT_TRUE(matte->fingers().empty());
}

TEST_F(Matte, StopsAtWhatIsNotJoinedToTheFinger) {
  scene.fill(300, 200, 340, 300, light_skin);
  scene.fill(370, 200, 400, 300, light_skin);
  matte->find(scene.picture, cells_between(scene.picture, 306, 334));
  EXPECT_EQ(at(320, 210), 255);
  EXPECT_EQ(at(385, 250), 0);
}

TEST_F(Matte, ReachesNoFartherThanAFingerDoes) {
  scene.fill(300, 0, 340, height, light_skin);
  matte->find(scene.picture, cells_between(scene.picture, 306, 334));
  const double reach = scene.picture.intrinsics.fx * FingerMatte::reach / 450;
  EXPECT_EQ(at(320, 240 + static_cast<int>(reach) - 12), 255);
  EXPECT_EQ(at(320, 240 + static_cast<int>(reach) + 30), 0);
}

TEST_F(Matte, KeepsTheFingersOfTwoSticksApart) {
  scene.fill(200, 200, 240, 300, light_skin);
  scene.fill(400, 200, 440, 300, dark_skin);
  auto cells = cells_between(scene.picture, 206, 234, 1);
  const auto more = cells_between(scene.picture, 406, 434, 2);
  cells.insert(cells.end(), more.begin(), more.end());
  matte->find(scene.picture, cells);
  ASSERT_EQ(matte->fingers().size(), 2U);
  EXPECT_LT(matte->fingers()[0].right, matte->fingers()[1].left);
  EXPECT_EQ(at(220, 280), 255);
  EXPECT_EQ(at(420, 280), 255);
}

TEST_F(Matte, IsEmptyWithoutCoveredRingsAndOutsideThePicture) {
  scene.fill(300, 200, 340, 300, light_skin);
  matte->find(scene.picture, {});
  EXPECT_TRUE(matte->fingers().empty());
  const std::array beside{CoveredCell{{5000, 0, 450}, 1}, CoveredCell{{0, 0, -450}, 1},
                          CoveredCell{{-5000, 0, 450}, 1}};
  matte->find(scene.picture, beside);
  EXPECT_TRUE(matte->fingers().empty());
}

TEST(Skin, IsNotPaintNorWall) {
  const auto coded = [](Bytes b) {
    return Rgb{static_cast<float>(b[0]) / 255, static_cast<float>(b[1]) / 255, static_cast<float>(b[2]) / 255};
  };
  for (const Bytes& skin : {light_skin, dark_skin, Bytes{198, 134, 66}, Bytes{141, 85, 36}, Bytes{255, 219, 172}})
    EXPECT_TRUE(may_be_skin(coded(skin))) << int{skin[0]};
  for (const Bytes& other :
       {wall, red_paint, Bytes{30, 60, 170}, Bytes{25, 140, 60}, Bytes{240, 240, 240}, Bytes{8, 5, 4}})
    EXPECT_FALSE(may_be_skin(coded(other))) << int{other[0]};
}

}  // namespace
}  // namespace onestroke

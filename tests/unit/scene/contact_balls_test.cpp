#include "scene/contact_balls.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

/// Flat squares of 20 mm, each cut in 200 triangles, in the plane z = 0.
Model squares(const std::vector<std::array<float, 2>>& middles) {
  Model model;
  model.materials.emplace_back();
  constexpr int n = 10;
  for (const auto& [x, y] : middles)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto first = static_cast<std::uint32_t>(model.vertices.size());
        for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          ModelVertex v{};
          v.position = {x - 0.01F + 0.002F * static_cast<float>(i + a), y - 0.01F + 0.002F * static_cast<float>(j + b),
                        0};
          model.vertices.push_back(v);
        }
        model.indices.insert(model.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
      }
  model.parts = {{0, static_cast<std::uint32_t>(model.indices.size()), 0}};
  return model;
}

TEST(ContactBalls, StandWhereTheModelIs) {
  const Model model = squares({{0, 0}, {0.2F, 0}});
  const auto balls = contact_balls(model);
  ASSERT_EQ(balls.size(), most_contact_balls);
  int left = 0;
  for (const ContactBall& ball : balls) {
    left += ball.centre[0] < 0.1F;
    const float x = ball.centre[0] < 0.1F ? ball.centre[0] : ball.centre[0] - 0.2F;
    EXPECT_LT(std::abs(x), 0.01F);
    EXPECT_LT(std::abs(ball.centre[1]), 0.01F);
    EXPECT_NEAR(ball.centre[2], 0, 1e-6);
    EXPECT_GT(ball.radius, 0.001F);
    EXPECT_LT(ball.radius, 0.01F);
  }
  EXPECT_EQ(left, 4);
}

TEST(ContactBalls, TakeNoNoticeOfCoarserLevels) {
  Model model = squares({{0, 0}});
  const auto alone = contact_balls(model);
  // A level that lies elsewhere, so that it would be seen.
  const Model far = squares({{5, 5}});
  const auto shift = static_cast<std::uint32_t>(model.vertices.size());
  model.vertices.insert(model.vertices.end(), far.vertices.begin(), far.vertices.end());
  for (const std::uint32_t i : far.indices) model.indices.push_back(i + shift);
  const auto balls = contact_balls(model);
  ASSERT_EQ(balls.size(), alone.size());
  for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_EQ(balls[i].centre, alone[i].centre);
}

TEST(ContactBalls, AreFewerWhereThereAreFewTriangles) {
  Model model = squares({{0, 0}});
  model.parts[0].index_count = 6;
  EXPECT_EQ(contact_balls(model).size(), 2U);
  model.parts.clear();
  EXPECT_TRUE(contact_balls(model).empty());
}

}  // namespace
}  // namespace onestroke

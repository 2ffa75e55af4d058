// The window beside the headset, on an X server of its own or on that of
// Monado's window.
#include "desktop/x_server.h"
#include "headset/headset.h"

#include <X11/keysym.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace onestroke {
namespace {

using Rgb = std::array<int, 3>;

constexpr Color orange{0.5F, 0.2F, 0.05F, 1}, blue{0.05F, 0.05F, 0.5F, 1};
constexpr Rgb orange_srgb{188, 124, 63}, blue_srgb{63, 63, 188};

bool alike(const Rgb& a, const Rgb& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(a.at(i) - b.at(i)) > 2) return false;
  return true;
}

class Mirror : public Headset {
 protected:
  static constexpr const char* title = "onestroke mirror test";

  void SetUp() override {
    const char* screen = std::getenv("MONADO_DISPLAY");
    ASSERT_TRUE(screen);
    setenv("DISPLAY", screen, 1);
    unsetenv("WAYLAND_DISPLAY");
    server.emplace(screen);
    ASSERT_TRUE(server->answers());
    open(true);
  }
  void open(bool with_mirror) {
    if (display) display->finish();
    renderer.reset();
    display.reset();
    options = {.title = title, .mirror = with_mirror};
    Headset::SetUp();
  }

  test::XServer::Window window() const { return server->find(title); }
  /// A pixel of the mirror; black where it is not to be seen.
  Rgb pixel(int x, int y) const {
    const auto id = window();
    return id && server->visible(id) ? server->pixel(id, x, y) : Rgb{};
  }
  /// Shows frames until the mirror has a colour at a pixel.
  bool appears(const Rgb& wanted, const Color& color, int x = 5, int y = 5) {
    for (int i = 0; i < 60; ++i) {
      show(5, color);
      // Monado's own window fills the screen, and comes later.
      server->raise(window());
      if (alike(pixel(x, y), wanted)) return true;
    }
    return false;
  }

  std::optional<test::XServer> server;
};

/// Where a view's picture shows a point of its world.
std::array<double, 2> project(const View& view, const Vec3& p_world) {
  const Vec3 p = inverse(view.T_world_view) * p_world;
  const auto& fov = view.fov;
  return {view.viewport.width * (p.x / p.z - fov.left) / (fov.right - fov.left),
          view.viewport.height * (fov.up + p.y / p.z) / (fov.up - fov.down)};
}

// The ring stands 400 mm before the world's origin. Where the left eye sees its
// left side, the right eye sees through its hole.
TEST_F(Mirror, ShowsWhatTheLeftEyeSees) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  const FrameInfo& frame = shown.back();
  const auto [x, y] = project(frame.views[0], {-50, 0, 400});
  const double scale = std::min(frame.target->height, 720) / static_cast<double>(frame.target->height);
  const int x_window = static_cast<int>(x * scale), y_window = static_cast<int>(y * scale);
  EXPECT_FALSE(alike(pixel(x_window, y_window), orange_srgb)) << "the ring at " << x_window << ", " << y_window;
  const int hole = static_cast<int>(project(frame.views[0], {0, 0, 400})[0] * scale);
  EXPECT_TRUE(alike(pixel(hole, y_window), orange_srgb)) << "the hole at " << hole << ", " << y_window;
  EXPECT_TRUE(appears(blue_srgb, blue)) << "the next pictures";
}

TEST_F(Mirror, HearsKeys) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  server->press(window(), XK_l);
  server->press(window(), XK_Escape);
  show(20);
  EXPECT_THAT(keys, testing::ElementsAre(Key{'l'}, Key::escape));
}

TEST_F(Mirror, FollowsItsSize) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  for (const std::array size : {std::array{1200, 200}, {120, 700}, {500, 400}}) {
    server->resize(window(), size[0], size[1]);
    ASSERT_TRUE(appears(blue_srgb, blue, size[0] - 1, size[1] - 1)) << size[0];
    ASSERT_TRUE(appears(orange_srgb, orange, 0, 0)) << size[0];
    server->resize(window(), 1, 1);
    show(30);
  }
}

TEST_F(Mirror, StopsWhileItIsMinimised) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  const auto id = window();
  server->minimise(id);
  show(60, blue);
  server->restore(id);
  EXPECT_TRUE(appears(blue_srgb, blue));
}

TEST_F(Mirror, ClosesByItself) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  const auto id = window();
  server->close(id);
  show(30);
  EXPECT_FALSE(server->visible(id));
  EXPECT_FALSE(display->closed());
  start();
  show(10);
  EXPECT_FALSE(server->visible(id)) << "with another GPU";
}

TEST_F(Mirror, IsThereAgainWithAnotherGpu) {
  ASSERT_TRUE(appears(orange_srgb, orange));
  start();
  EXPECT_TRUE(appears(blue_srgb, blue));
}

TEST_F(Mirror, IsDoneWithoutWhereThereIsNoScreen) {
  for (const char* screen : {"", ":987"}) {
    setenv("DISPLAY", screen, 1);
    open(true);
    show(5);
    EXPECT_EQ(window(), 0U);
    EXPECT_THAT(keys, testing::IsEmpty());
  }
}

/// Times between frames.
std::vector<double> periods_ms(const std::vector<FrameInfo>& shown) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < shown.size(); ++i) periods.push_back((shown[i].time - shown[i - 1].time).ms());
  return periods;
}

using MirrorBeside = Mirror;

TEST_F(MirrorBeside, DoesNotHoldTheHeadsetBack) {
  const char* asked_for = std::getenv("MIRROR_ROUNDS");
  const std::size_t rounds = asked_for ? std::stoul(asked_for) : 2;
  std::array<std::vector<double>, 2> periods, cpu_ms;
  validation = false;  // which takes time of its own
  for (std::size_t round = 0; round < 2 * rounds; ++round) {
    const std::size_t with = (round % 2 + round / 2) % 2;
    open(with == 1);
    show(40);
    show(100);
    for (const double period : periods_ms(shown)) periods.at(with).push_back(period);
    for (const Duration each : cpu) cpu_ms.at(with).push_back(each.ms());
  }
  for (const std::size_t with : {0U, 1U})
    std::cout << (with ? "with   " : "without") << " the mirror: period " << median_of(periods.at(with)) << " ms, 95 % "
              << quantile_of(periods.at(with), 0.95) << " ms; CPU time of this thread " << median_of(cpu_ms.at(with))
              << " ms, 95 % " << quantile_of(cpu_ms.at(with), 0.95) << " ms a frame\n";
  // All frames came, with and without; how fast is for reading.
  EXPECT_EQ(periods[0].size(), periods[1].size());
}

}  // namespace
}  // namespace onestroke

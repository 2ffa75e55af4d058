// A real window on a real X server; CMake gives it one with xvfb-run.
#include "display/window.h"

#include "core/error.h"
#include "desktop/x_server.h"
#include "display/open_display.h"
#include "golden/stage.h"

#include <X11/keysym.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <optional>

namespace onestroke {
namespace {

constexpr const char* title = "onestroke window test";

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(std::getenv("DISPLAY")) << "this test needs an X server: run it with xvfb-run -a";
    ASSERT_TRUE(server.answers());
    window.emplace(WindowOptions{.title = title, .width = 320, .height = 240});
    start();
  }
  /// Brings the window a GPU.
  void start() {
    Gpu gpu({.needs = window->needs(),
             .validation = true,
             .validation_messages = &validation_messages,
             .rehearsal = &rehearsal});
    window->attach(gpu);
    renderer.emplace(gpu);
  }
  void TearDown() override {
    renderer.reset();
    window.reset();
    EXPECT_EQ(validation_messages, 0);
  }

  /// One frame of one colour; false where the window wanted none.
  bool show(const Color& color) {
    FrameInfo frame;
    window->begin(frame);
    if (frame.should_render) {
      EXPECT_TRUE(renderer->draw({.background = color}, frame)) << renderer->failure();
      last = frame;
      size = {frame.target ? frame.views[0].viewport.width : 0, frame.views[0].viewport.height};
    }
    window->end(frame);
    for (const Key key : window->poll()) keys.push_back(key);
    return frame.should_render;
  }

  /// Shows frames until something is so. The server answers in its own time, so frames are counted and not seconds.
  bool show_until(const Color& color, const std::function<bool()>& so) {
    for (int i = 0; i < 600; ++i) {
      show(color);
      if (so()) return true;
    }
    return false;
  }

  std::atomic<int> validation_messages{0};
  LossRehearsal rehearsal;
  test::XServer server;
  std::optional<WindowDisplay> window;
  std::optional<Renderer> renderer;
  FrameInfo last;
  std::array<int, 2> size{};
  std::vector<Key> keys;
};

TEST_F(WindowTest, ShowsWhatIsDrawn) {
  const Color orange{1, 0.2F, 0.05F, 1};  // sRGB 255, 124, 63
  ASSERT_TRUE(show_until(orange, [this] { return server.pixel(server.find(title), 160, 120)[0] > 0; }));
  const auto pixel = server.pixel(server.find(title), 160, 120);
  EXPECT_EQ(pixel[0], 255);
  EXPECT_NEAR(pixel[1], 124, 1);
  EXPECT_NEAR(pixel[2], 63, 1);
  EXPECT_EQ(size, (std::array{320, 240}));
}

TEST_F(WindowTest, FollowsItsSize) {
  show({});
  for (const std::array wanted : {std::array{500, 380}, {200, 150}, {640, 90}}) {
    window->resize(wanted[0], wanted[1]);
    ASSERT_TRUE(show_until({0, 1, 0, 1}, [&] { return size == wanted; })) << wanted[0];
    const auto last_pixel = [&] { return server.pixel(server.find(title), wanted[0] - 2, wanted[1] - 2); };
    ASSERT_TRUE(show_until({0, 1, 0, 1}, [&] { return last_pixel() == std::array{0, 255, 0}; })) << wanted[0];
  }
  EXPECT_FALSE(window->closed());
}

TEST_F(WindowTest, ReportsKeys) {
  show({});
  const auto id = server.find(title);
  for (const unsigned long symbol : std::array<unsigned long, 4>{XK_l, XK_space, XK_Escape, XK_Left})
    server.press(id, symbol);
  EXPECT_TRUE(show_until({}, [this] { return keys.size() >= 4; }));
  EXPECT_THAT(keys, testing::ElementsAre(Key{'l'}, Key::space, Key::escape, Key::left));
}

TEST_F(WindowTest, ClosesWhenAsked) {
  show({});
  EXPECT_FALSE(window->closed());
  server.close(server.find(title));
  EXPECT_TRUE(show_until({}, [this] { return window->closed(); }));
  EXPECT_NO_THROW(window->finish());
}

TEST_F(WindowTest, ShrinksToOnePixelAndBack) {
  show({});
  window->resize(1, 1);
  EXPECT_TRUE(show_until({1, 0, 0, 1}, [this] { return size == std::array{1, 1}; }));
  window->resize(300, 200);
  EXPECT_TRUE(show_until({1, 0, 0, 1}, [this] { return size == std::array{300, 200}; }));
}

TEST_F(WindowTest, DrawsNothingWhileItIsMinimised) {
  show({});
  const auto id = server.find(title);
  server.minimise(id);
  ASSERT_TRUE(show_until({}, [this] { return !show({}); }));
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(show({1, 0, 0, 1}));
  EXPECT_FALSE(window->closed());
  // It may get another size meanwhile, and hears its keys.
  window->resize(260, 180);
  server.press(id, XK_l);
  EXPECT_TRUE(show_until({}, [this] { return !keys.empty(); }));
  server.restore(id);
  ASSERT_TRUE(show_until({0, 0, 1, 1}, [this] { return size == std::array{260, 180}; }));
  EXPECT_TRUE(show_until({0, 0, 1, 1}, [&] { return server.pixel(id, 130, 90) == std::array{0, 0, 255}; }));
}

TEST_F(WindowTest, ClosesWhileItIsMinimised) {
  show({});
  const auto id = server.find(title);
  server.minimise(id);
  ASSERT_TRUE(show_until({}, [this] { return !show({}); }));
  server.close(id);
  EXPECT_TRUE(show_until({}, [this] { return window->closed(); }));
  EXPECT_NO_THROW(window->finish());
}

TEST_F(WindowTest, FollowsManySizesInARow) {
  show({});
  // As when a corner is dragged: the size changes between any two frames.
  for (int i = 0; i < 60; ++i) {
    window->resize(200 + 7 * (i % 20), 300 - 5 * (i % 30));
    show({0, 1, 0, 1});
  }
  window->resize(333, 222);
  EXPECT_TRUE(show_until({0, 1, 0, 1}, [this] { return size == std::array{333, 222}; }));
  EXPECT_FALSE(window->closed());
}

TEST_F(WindowTest, GoesOnWithAnotherGpuWhereOneWasLost) {
  ASSERT_TRUE(show_until({1, 0, 0, 1}, [this] {
    return server.pixel(server.find(title), 9, 9) == std::array{255, 0, 0};
  }));
  rehearsal.submissions = 1;
  FrameInfo frame;
  window->begin(frame);
  ASSERT_TRUE(frame.should_render);
  EXPECT_FALSE(renderer->draw({}, frame));
  EXPECT_TRUE(renderer->lost());
  frame.should_render = false;  // nothing was drawn
  window->end(frame);
  EXPECT_FALSE(window->closed());
  renderer.reset();
  start();
  EXPECT_FALSE(window->gpu_lost());
  EXPECT_TRUE(show_until({0, 0, 1, 1}, [this] {
    return server.pixel(server.find(title), 9, 9) == std::array{0, 0, 255};
  }));
}

TEST(WindowWithoutDesktop, NamesTheRemedy) {
  const std::string desktop = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  setenv("DISPLAY", ":987", 1);
  try {
    open_display("window", {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("offscreen:DIR"));
  }
  setenv("DISPLAY", desktop.c_str(), 1);
}

}  // namespace
}  // namespace onestroke

#include "app/desktop_hud.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <limits>

namespace onestroke {
namespace {

struct Box {
  float left = std::numeric_limits<float>::max(), top = left, right = -left, bottom = -left;
};

Box box_of(const ImDrawData& gui) {
  Box box;
  for (int i = 0; i < gui.CmdListsCount; ++i)
    for (const ImDrawVert& v : gui.CmdLists[i]->VtxBuffer) {
      box.left = std::min(box.left, v.pos.x);
      box.right = std::max(box.right, v.pos.x);
      box.top = std::min(box.top, v.pos.y);
      box.bottom = std::max(box.bottom, v.pos.y);
    }
  return box;
}

HudWords words_for(int markers) {
  FrameRecord record;
  record.marker_count = markers;
  for (MarkerObservation& m : record.markers) {
    std::fill_n(m.name.begin(), 10, 'x');
    m.state = MarkerState::measured;
    m.cells_seen = 30;
    m.T_camera_marker.translation.z = 400;
  }
  HudWords words(true);
  words.update(record, {});
  return words;
}

bool colored(const ImDrawData& gui, ImU32 color) {
  return std::any_of(gui.CmdLists[0]->VtxBuffer.begin(), gui.CmdLists[0]->VtxBuffer.end(),
                     [&](const ImDrawVert& v) { return v.col == color; });
}

TEST(DesktopHud, StandsInTheLowerLeftCorner) {
  DesktopHud hud;
  const Box box = box_of(hud.lay_out(words_for(2), {0, 0, 1280, 720}));
  EXPECT_GT(box.left, 4);
  EXPECT_LT(box.left, 30);
  EXPECT_LT(box.right, 1280 * 0.4);
  EXPECT_GT(box.bottom, 720 - 30);
  EXPECT_LT(box.bottom, 720 - 4);
}

TEST(DesktopHud, GrowsWithTheHeightOfTheView) {
  DesktopHud hud;
  const Box small = box_of(hud.lay_out(words_for(2), {0, 0, 1280, 720}));
  const Box large = box_of(hud.lay_out(words_for(2), {0, 0, 2560, 1440}));
  EXPECT_NEAR((large.right - large.left) / (small.right - small.left), 2, 0.02);
  EXPECT_NEAR((large.bottom - large.top) / (small.bottom - small.top), 2, 0.02);
}

TEST(DesktopHud, FitsNarrowViews) {
  DesktopHud hud;
  for (const Viewport& view : {Viewport{0, 0, 320, 240}, Viewport{0, 0, 200, 400}, Viewport{0, 0, 500, 2000}})
    EXPECT_LT(box_of(hud.lay_out(words_for(3), view)).right, static_cast<float>(view.width));
}

TEST(DesktopHud, HasARowAMarkerFromTheFirstFrameOn) {
  DesktopHud hud;
  const auto height = [&hud](int markers) {
    const Box box = box_of(hud.lay_out(words_for(markers), {0, 0, 1280, 720}));
    return box.bottom - box.top;
  };
  // Each frame has other rows than the one before.
  const float none = height(0), two = height(2), three = height(3), sixteen = height(16);
  EXPECT_GT(two, none + 20);
  EXPECT_NEAR(sixteen - three, 13 * (three - two), 13);
  EXPECT_EQ(height(2), two);
  EXPECT_EQ(height(0), none);
}

TEST(DesktopHud, ShowsTheStateInItsColour) {
  DesktopHud hud;
  FrameRecord record;
  record.marker_count = 1;
  std::vector<std::vector<ImU32>> colors;
  const std::array all{IM_COL32(96, 208, 112, 255), IM_COL32(240, 184, 64, 255), IM_COL32(224, 88, 80, 255)};
  for (const MarkerState state : {MarkerState::measured, MarkerState::predicted, MarkerState::lost}) {
    record.markers[0].state = state;
    HudWords words(false);
    words.update(record, {});
    const ImDrawData& gui = hud.lay_out(words, {0, 0, 640, 480});
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(colored(gui, all[i]), i == static_cast<std::size_t>(state));
  }
}

TEST(DesktopHud, IsLaidOutInTinyViewsToo) {
  DesktopHud hud;
  for (const Viewport& view : {Viewport{0, 0, 1, 1}, Viewport{0, 0, 16, 16}, Viewport{0, 0, 4000, 20}}) {
    const ImDrawData& gui = hud.lay_out(words_for(16), view);
    EXPECT_EQ(gui.DisplaySize.x, static_cast<float>(view.width));
  }
}

TEST(DesktopHud, ManyCanLiveAtOnce) {
  DesktopHud one, two;
  const Box a = box_of(one.lay_out(words_for(1), {0, 0, 1280, 720}));
  const Box b = box_of(two.lay_out(words_for(1), {0, 0, 640, 480}));
  const Box again = box_of(one.lay_out(words_for(1), {0, 0, 1280, 720}));
  EXPECT_EQ(a.right, again.right);
  EXPECT_LT(b.right, a.right);
}

}  // namespace
}  // namespace onestroke

#pragma once

#include <memory>

struct ImDrawData;
struct ImFontAtlas;
struct ImGuiContext;

namespace onestroke {

/// Dear ImGui without a window of its own: widgets in, what FrameScene::gui draws out. Text is set in the labels' font,
/// at any size; there is no mouse and no keyboard, and nothing is kept on disk. One thread.
class Gui {
 public:
  Gui();
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Widgets (imgui.h) may follow, until end(), for a view of so many pixels. `text_px` is the font's size; windows'
  /// corners are rounded in proportion.
  void begin(int width, int height, double text_px);
  /// Lives until the next begin(). Allocates nothing once as much has been laid out before.
  const ImDrawData& end();

 private:
  std::unique_ptr<ImFontAtlas> atlas_;
  ImGuiContext* context_;
};

}  // namespace onestroke

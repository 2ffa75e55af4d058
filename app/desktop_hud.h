#pragma once

#include "app/hud_words.h"
#include "render/gui.h"
#include "render/view.h"

namespace onestroke {

/// Draws HudWords on a desktop's one view: a panel in the lower left corner, a row a marker and the figures below, in
/// proportion to the view's height. One thread; allocates nothing after the constructor.
class DesktopHud {
 public:
  DesktopHud();

  /// For FrameScene::gui; lives until the next call.
  const ImDrawData& lay_out(const HudWords& words, const Viewport& view);

 private:
  Gui gui_;
};

}  // namespace onestroke

#pragma once

#include "display/openxr_instance.h"
#include "render/display.h"

#include <array>

namespace onestroke {

/// The buttons of whatever controllers the runtime has: one goes on in the menu, one picks, and one opens and closes
/// it. Without a controller nothing is ever pressed.
class OpenXrActions {
 public:
  /// Before the session begins. Instance and session outlive this. Throws OpenXrError.
  OpenXrActions(const OpenXrInstance& instance, XrSession session);

  /// Tells of each key that was pressed since the last call. Nothing is while another program has the wearer's
  /// attention. No allocation. Throws OpenXrError.
  template <typename Press>
  void poll(Press&& press) const {
    if (!sync()) return;
    for (const Button& button : buttons_)
      if (pressed(button)) press(button.key);
  }

 private:
  struct Button {
    Key key = Key::none;
    XrAction action = XR_NULL_HANDLE;
  };

  bool sync() const;
  bool pressed(const Button& button) const;

  XrSession session_;
  OpenXrOwned<XrActionSet, xrDestroyActionSet> set_;
  std::array<Button, 3> buttons_;
};

}  // namespace onestroke

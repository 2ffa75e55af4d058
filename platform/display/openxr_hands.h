#pragma once

#include "display/openxr_instance.h"
#include "display/pinch_tap.h"
#include "render/display.h"

#include <array>
#include <optional>

namespace onestroke {

/// The wearer's hands, where the runtime tracks them: what their fingers tap is a key. The left forefinger goes on in
/// the menu, the right one picks, and a middle finger opens and closes it.
class OpenXrHands {
 public:
  /// Instance and session outlive this. Follows nothing where the runtime tracks no hands. Throws OpenXrError.
  OpenXrHands(const OpenXrInstance& instance, XrSession session);
  OpenXrHands(const OpenXrHands&) = delete;
  ~OpenXrHands();

  /// Once a frame: tells of each key that is tapped. In any space, for only distances count. No allocation. Throws
  /// OpenXrError.
  template <typename Press>
  void poll(XrSpace space, XrTime time, Time now, Press&& press) {
    for (std::size_t hand = 0; hand < trackers_.size(); ++hand)
      if (const Key key = tapped(hand, space, time, now); key != Key::none) press(key);
  }

 private:
  Key tapped(std::size_t hand, XrSpace space, XrTime time, Time now);
  std::optional<HandPinch> look(std::size_t hand, XrSpace space, XrTime time) const;

  PFN_xrLocateHandJointsEXT locate_ = nullptr;
  PFN_xrDestroyHandTrackerEXT destroy_ = nullptr;
  std::array<XrHandTrackerEXT, 2> trackers_{};  // left, right
  std::array<HandTaps, 2> taps_;
};

}  // namespace onestroke

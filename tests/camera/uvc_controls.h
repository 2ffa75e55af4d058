#pragma once

#include "bytes.h"
#include "event_log.h"

#include <array>
#include <optional>
#include <span>

namespace onestroke::usb {

/// The values that a person can set at the camera, and their requests (UVC 1.0, chapter 4.2). They are remembered and
/// logged and change nothing of the pictures.
class UvcControls {
 public:
  explicit UvcControls(EventLog& log) : log_(log) {}

  /// The answer to a request of a unit's control, with `sent` for SET_CUR, which is answered by nothing; none where the
  /// camera refuses it. Exposure and white balance can be set while they are not automatic, as at most cameras.
  std::optional<Bytes> answer(u8 request, u8 unit, u8 selector, std::span<const u8> sent);

 private:
  struct Control {
    u8 unit, selector, bytes;
    const char* name;
    int least, most, step, initial, value;
  };

  static std::array<Control, 8> all();
  bool settable(const Control& control) const;
  int value_of(const char* name) const;
  bool set(Control& control, std::span<const u8> sent);

  EventLog& log_;
  std::array<Control, 8> controls_ = all();
  u8 error_ = 0;  ///< Of the last request, UVC 1.0's table 4-7.
};

}  // namespace onestroke::usb

#include "uvc_controls.h"

#include "uvc_descriptors.h"

#include <linux/usb/video.h>

#include <algorithm>
#include <string_view>

namespace onestroke::usb {
namespace {

constexpr u8 no_error = 0, wrong_state = 2, out_of_range = 4, invalid_control = 6, invalid_request = 7;

// Bits of the modes of exposure.
constexpr int manual = 1, aperture_priority = 8;

Bytes number(int value, u8 bytes) {
  Bytes out;
  for (u8 i = 0; i < bytes; ++i) out.push_back(static_cast<u8>(static_cast<u32>(value) >> (8 * i)));
  return out;
}

}  // namespace

std::array<UvcControls::Control, 8> UvcControls::all() {
  return {{
      {camera_terminal, UVC_CT_AE_MODE_CONTROL, 1, "exposure_mode", manual, aperture_priority,
       manual | aperture_priority, aperture_priority, aperture_priority},
      {camera_terminal, UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL, 4, "exposure_100us", 1, 5000, 1, 157, 157},
      {processing_unit, UVC_PU_BRIGHTNESS_CONTROL, 2, "brightness", -64, 64, 1, 0, 0},
      {processing_unit, UVC_PU_CONTRAST_CONTROL, 2, "contrast", 0, 95, 1, 32, 32},
      {processing_unit, UVC_PU_SATURATION_CONTROL, 2, "saturation", 0, 100, 1, 55, 55},
      {processing_unit, UVC_PU_GAIN_CONTROL, 2, "gain", 0, 100, 1, 10, 10},
      {processing_unit, UVC_PU_WHITE_BALANCE_TEMPERATURE_CONTROL, 2, "white_balance_kelvin", 2800, 6500, 10, 4600,
       4600},
      {processing_unit, UVC_PU_WHITE_BALANCE_TEMPERATURE_AUTO_CONTROL, 1, "white_balance_auto", 0, 1, 1, 1, 1},
  }};
}

int UvcControls::value_of(const char* name) const {
  return std::ranges::find(controls_, std::string_view(name), &Control::name)->value;
}

bool UvcControls::settable(const Control& control) const {
  switch (control.selector | control.unit << 8) {
    case camera_terminal << 8 | UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL:
      return value_of("exposure_mode") == manual;
    case processing_unit << 8 | UVC_PU_WHITE_BALANCE_TEMPERATURE_CONTROL:
      return value_of("white_balance_auto") == 0;
    default:
      return true;
  }
}

bool UvcControls::set(Control& control, std::span<const u8> sent) {
  int value = static_cast<int>(number_in(sent.data(), std::min<std::size_t>(sent.size(), control.bytes)));
  if (control.bytes == 2) value = static_cast<std::int16_t>(value);
  error_ = !settable(control) ? wrong_state : value < control.least || value > control.most ? out_of_range : no_error;
  if (error_ != no_error) return false;
  control.value = value;
  log_.add("control", {{"name", control.name}, {"value", value}});
  return true;
}

std::optional<Bytes> UvcControls::answer(u8 request, u8 unit, u8 selector, std::span<const u8> sent) {
  if (unit == 0 && selector == UVC_VC_REQUEST_ERROR_CODE_CONTROL && request == UVC_GET_CUR) return Bytes{error_};
  const auto control =
      std::ranges::find_if(controls_, [&](const Control& c) { return c.unit == unit && c.selector == selector; });
  if (control == controls_.end()) {
    error_ = invalid_control;
    return std::nullopt;
  }
  error_ = no_error;
  constexpr u8 can_be_read_and_set = 3;
  switch (request) {
    case UVC_SET_CUR:
      return set(*control, sent) ? std::optional(Bytes{}) : std::nullopt;
    case UVC_GET_CUR:
      return number(control->value, control->bytes);
    case UVC_GET_MIN:
      return number(control->least, control->bytes);
    case UVC_GET_MAX:
      return number(control->most, control->bytes);
    case UVC_GET_RES:
      return number(control->step, control->bytes);
    case UVC_GET_DEF:
      return number(control->initial, control->bytes);
    case UVC_GET_INFO:
      return Bytes{can_be_read_and_set};
    case UVC_GET_LEN:
      return number(control->bytes, 2);
    default:
      error_ = invalid_request;
      return std::nullopt;
  }
}

}  // namespace onestroke::usb

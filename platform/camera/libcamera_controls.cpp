#include "camera/libcamera_controls.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace onestroke {
namespace {

namespace controls = libcamera::controls;

/// A wish, as libcamera and as a person calls it.
template <typename Value>
struct Wish {
  const libcamera::Control<Value>& control;
  const char* option;
  Value value;
  double unit;  ///< What one of the option's is in the control's.
};

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

template <typename Value>
void set(const Wish<Value>& wish, const libcamera::ControlInfoMap& offered, libcamera::ControlList& list,
         std::vector<std::string>& shortfalls) {
  const auto info = offered.find(wish.control.id());
  if (info == offered.end()) {
    shortfalls.push_back(std::string(wish.option) + " has no effect: libcamera cannot set it on this camera");
    return;
  }
  Value value = wish.value;
  if (!info->second.max().isNone()) {
    const auto least = info->second.min().template get<Value>(), most = info->second.max().template get<Value>();
    if (value < least || value > most) {
      value = value < least ? least : most;
      shortfalls.push_back(std::string(wish.option) + " is out of this camera's range, " +
                           number(static_cast<double>(least) / wish.unit) + " to " +
                           number(static_cast<double>(most) / wish.unit) + ": it is set to " +
                           number(static_cast<double>(value) / wish.unit));
    }
  }
  list.set(wish.control, value);
}

void turn_off(const libcamera::Control<bool>& automatic, const libcamera::ControlInfoMap& offered,
              libcamera::ControlList& list) {
  if (offered.find(automatic.id()) != offered.end()) list.set(automatic, false);
}

}  // namespace

libcamera::ControlList controls_for(const libcamera::ControlInfoMap& offered, const LiveOptions& wishes,
                                    std::vector<std::string>& shortfalls) {
  libcamera::ControlList list(controls::controls);
  if (wishes.exposure) {
    turn_off(controls::AeEnable, offered, list);
    constexpr double us_per_ms = 1000;
    set(Wish<std::int32_t>{controls::ExposureTime, "--exposure-ms",
                           static_cast<std::int32_t>(std::lround(wishes.exposure->ms() * us_per_ms)), us_per_ms},
        offered, list, shortfalls);
  }
  if (wishes.gain)
    set(Wish<float>{controls::AnalogueGain, "--gain", static_cast<float>(*wishes.gain), 1}, offered, list, shortfalls);
  if (wishes.white_balance && offered.find(controls::ColourTemperature.id()) != offered.end()) {
    turn_off(controls::AwbEnable, offered, list);
    set(Wish<std::int32_t>{controls::ColourTemperature, "--white-balance",
                           static_cast<std::int32_t>(std::lround(*wishes.white_balance)), 1},
        offered, list, shortfalls);
  }
  if (wishes.rate && offered.find(controls::FrameDurationLimits.id()) != offered.end()) {
    const auto period = static_cast<std::int64_t>(std::llround(1e6 / *wishes.rate));
    const std::array<std::int64_t, 2> limits{period, period};
    list.set(controls::FrameDurationLimits, libcamera::Span<const std::int64_t, 2>(limits));
  } else if (wishes.rate) {
    shortfalls.emplace_back("--rate has no effect: libcamera cannot set it on this camera, which has its own");
  }
  return list;
}

}  // namespace onestroke

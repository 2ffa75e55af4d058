#pragma once

#include <compare>
#include <cstdint>

namespace onestroke {

/// A span of time in nanoseconds, signed.
struct Duration {
  std::int64_t ns = 0;

  static constexpr Duration from_seconds(double s) {
    return {static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
  }
  static constexpr Duration from_ms(double ms) { return from_seconds(ms * 1e-3); }
  constexpr double seconds() const { return static_cast<double>(ns) * 1e-9; }
  constexpr double ms() const { return static_cast<double>(ns) * 1e-6; }
  friend constexpr auto operator<=>(Duration, Duration) = default;  // NOLINT(modernize-use-nullptr)
  friend constexpr Duration operator+(Duration a, Duration b) { return {a.ns + b.ns}; }
  friend constexpr Duration operator-(Duration a, Duration b) { return {a.ns - b.ns}; }
  friend constexpr Duration operator-(Duration a) { return {-a.ns}; }
  friend constexpr Duration operator*(std::int64_t k, Duration a) { return {k * a.ns}; }
  friend constexpr Duration operator/(Duration a, std::int64_t k) { return {a.ns / k}; }
};

/// A point in time: nanoseconds on CLOCK_MONOTONIC. Recordings and the synthetic camera count from zero instead.
struct Time {
  std::int64_t ns = 0;

  /// The clock now. Any thread.
  static Time now();
  friend constexpr auto operator<=>(Time, Time) = default;  // NOLINT(modernize-use-nullptr)
  friend constexpr Duration operator-(Time a, Time b) { return {a.ns - b.ns}; }
  friend constexpr Time operator+(Time a, Duration d) { return {a.ns + d.ns}; }
  friend constexpr Time operator-(Time a, Duration d) { return {a.ns - d.ns}; }
};

/// How far apart frames are.
class FrameSteps {
 public:
  /// From the frame before to the one at `now`; nothing before the first.
  Duration step_to(Time now) {
    const Duration step = started_ ? now - last_ : Duration{};
    last_ = now;
    started_ = true;
    return step;
  }

 private:
  Time last_;
  bool started_ = false;
};

}  // namespace onestroke

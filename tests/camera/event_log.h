#pragma once

#include "core/time.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace onestroke::usb {

/// What happened at the camera, a line of JSON each: {"event": NAME, "time_ns": CLOCK_MONOTONIC here, ...}.
///
///   plug, unplug    the device comes and goes
///   stream          "on"; where it is: "format" (MJPG or YUYV), "width", "height", "interval_us"
///   frame           "number" of the stream, from 0; "picture", its file; "bytes" sent of it; "cut". The time is that
///   at which
///                   its first byte was sent
///   late            "number" of the frame to come, which the host took an interval too late or more; "by_ns"
///   over            all pictures of the stream have been sent
///   hang, resume    it falls silent, and goes on
///   control         "name" and "value" of a control that was set
class EventLog {
 public:
  /// Throws Error where the file cannot be written.
  explicit EventLog(const std::filesystem::path& file);

  void add(const char* event, const nlohmann::json& more = nlohmann::json::object()) { add(event, Time::now(), more); }
  void add(const char* event, Time time, const nlohmann::json& more);

 private:
  std::ofstream out_;
};

}  // namespace onestroke::usb

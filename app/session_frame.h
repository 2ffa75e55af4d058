#pragma once

#include "core/frame_record.h"
#include "core/inline_vector.h"
#include "core/latency.h"
#include "core/picture.h"
#include "render/display.h"
#include "scene/text.h"

#include <optional>
#include <string>

namespace onestroke {

/// What a session was started with: enough to show it again.
struct SessionHeader {
  std::string program{};            ///< The version that wrote the log.
  std::string camera{};             ///< As for --camera; files by their whole paths.
  std::string catalog{};            ///< By its whole path.
  std::optional<double> fov_deg{};  ///< What was said of the lens, if anything: one of these two.
  std::string calibration{};        ///< A file by its whole path.
  std::optional<double> readout_ms{};
  std::string second_camera{};  ///< As `camera`; empty for none.
  bool side_by_side = false;
  std::string rig{};  ///< A file by its whole path: how two cameras sit, by this or the next.
  std::optional<double> baseline_mm{};
  double rate = 0;  ///< Frames a second of the display's time; 0 for a screen's own.
  bool stereo = false, fingers = true, left_handed = false;
  /// The camera's place on the wearer's head; none where no head was tracked.
  std::optional<Pose> T_head_camera{};
};

/// A picture as far as it must be known to stand in for it.
struct PictureLens {
  int width = 0, height = 0;  ///< Pixels; 0 before the first picture.
  Intrinsics intrinsics;
};

/// The same of the second picture of a pair; of no size where there is none.
struct SecondLens : PictureLens {
  Pose T_first_second;  ///< With the head's motion between the two exposures.
};

/// One frame of a show. Its size is fixed, so that it can be handed on without allocation.
struct SessionFrame {
  static constexpr std::size_t most_keys = 16, most_events = 4;

  Time now;              ///< Of the frame, in the record's time.
  bool picture = false;  ///< The record's picture was new.
  FrameRecord record;
  PictureLens lens;
  SecondLens second;
  std::optional<Latency> latency;     ///< Where the picture's time is the clock's.
  InlineVector<Key, most_keys> keys;  ///< Pressed before the frame.
  /// What happened in it, in words; they tell a reader of the log where to look, and change nothing.
  InlineVector<Text, most_events> events;
  std::uint64_t missed = 0;  ///< Frames before this one that are not in the log.
};

/// As `to = from`, without what a record has room for and does not use.
void copy_record(const FrameRecord& from, FrameRecord& to);

}  // namespace onestroke

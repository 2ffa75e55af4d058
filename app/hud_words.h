#pragma once

#include "app/frame_meter.h"
#include "scene/text.h"

#include <array>
#include <span>

namespace onestroke {

/// What the figures of a show say, word for word; how a panel of them is drawn is DesktopHud's. Allocates nothing.
class HudWords {
 public:
  /// One marker of the picture shown.
  struct Marker {
    Text name, state, cells, distance;  ///< The last two are empty where the marker is lost.
    MarkerState kind = MarkerState::lost;
  };

  /// rates: false leaves out what depends on how fast frames can be drawn, so that films of one recording are alike but
  /// for the tracker's time.
  explicit HudWords(bool rates) : rates_(rates) {}

  /// Once a frame.
  void update(const FrameRecord& record, const FrameFigures& figures);

  /// By their ids, so that rows stand still as markers come and go.
  std::span<const Marker> markers() const { return {markers_.data(), marker_count_}; }
  /// Lines, in the order in which they are read.
  std::span<const Text> figures() const { return {figures_.data(), figure_count_}; }
  /// The same as one text, for where there is no room for a panel.
  std::string_view status() const { return status_.view(); }

 private:
  const bool rates_;
  std::array<Marker, max_markers_per_frame> markers_;
  std::array<Text, 3> figures_;
  Text status_;
  std::size_t marker_count_ = 0, figure_count_ = 0;
};

}  // namespace onestroke

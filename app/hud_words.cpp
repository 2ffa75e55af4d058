#include "app/hud_words.h"

#include <algorithm>
#include <bit>

namespace onestroke {
namespace {

const char* word_for(MarkerState state) {
  switch (state) {
    case MarkerState::measured:
      return "measured";
    case MarkerState::predicted:
      return "predicted";
    case MarkerState::lost:
      break;
  }
  return "lost";
}

void describe(const MarkerObservation& seen, HudWords::Marker& words) {
  words.kind = seen.state;
  words.name.print("%s", seen.name.data());
  words.state.print("%s", word_for(seen.state));
  words.cells.clear();
  words.distance.clear();
  if (seen.state == MarkerState::lost) return;
  if (seen.second_cells == 0)
    words.cells.print("%d cells", seen.cells_seen);
  else
    words.cells.print("%d + %d cells", seen.cells_seen, std::popcount(seen.second_cells));
  words.distance.print("%.0f mm", norm(seen.T_camera_marker.translation));
}

}  // namespace

void HudWords::update(const FrameRecord& record, const FrameFigures& figures) {
  marker_count_ = figure_count_ = 0;
  std::array<const MarkerObservation*, max_markers_per_frame> order{};
  std::size_t count = 0;
  for (const MarkerObservation& seen : record.seen()) order[count++] = &seen;
  std::ranges::sort(std::span(order).first(count), {}, &MarkerObservation::id);
  for (const MarkerObservation* seen : std::span(order).first(count)) describe(*seen, markers_[marker_count_++]);
  if (rates_)
    figures_[figure_count_++].print("%.0f pictures/s · %.0f frames/s · %llu left out", figures.pictures_a_second,
                                    figures.frames_a_second, static_cast<unsigned long long>(figures.left_out));
  figures_[figure_count_++].print("Tracker %.1f ms a picture", figures.tracker_ms);
  if (rates_ && figures.latency)
    figures_[figure_count_++].print("After exposure: tracked %.0f, drawn %.0f, seen %.0f ms",
                                    figures.latency->tracked.ms(), figures.latency->drawn.ms(),
                                    figures.latency->seen.ms());
  const auto line = [&](std::size_t i) { return i < figure_count_ ? figures_[i].view().data() : ""; };
  status_.print("%s%s%s%s%s", line(0), figure_count_ > 1 ? "\n" : "", line(1), figure_count_ > 2 ? "\n" : "", line(2));
}

}  // namespace onestroke

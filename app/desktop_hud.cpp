#include "app/desktop_hud.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// Ems, from the left: where names and states begin and where cells and distances end. Fixed, so that the panel stands
// still whatever it says.
constexpr float name_at = 1.1F, state_at = 12, cells_end = 22.5F, distance_end = 28.5F;
constexpr float padding = 0.7F, row_height = 1.4F, between = 0.3F, edge = 1;
constexpr double widest = distance_end + 2 * padding + 2 * edge;

// sRGB, as Dear ImGui has them.
constexpr ImU32 text_color = IM_COL32(235, 238, 242, 255), quiet_color = IM_COL32(190, 195, 202, 255);
constexpr ImU32 plate_color = IM_COL32(26, 28, 33, 226);

ImU32 color_of(MarkerState state) {
  switch (state) {
    case MarkerState::measured:
      return IM_COL32(96, 208, 112, 255);
    case MarkerState::predicted:
      return IM_COL32(240, 184, 64, 255);
    case MarkerState::lost:
      break;
  }
  return IM_COL32(224, 88, 80, 255);
}

/// Sets text line by line, from the panel's upper left corner.
struct Pen {
  ImDrawList& list;
  ImVec2 at;
  float em;

  static const char* begin(const Text& text) { return text.view().data(); }
  static const char* end(const Text& text) { return text.view().data() + text.view().size(); }

  void say(const Text& text, float from_em, ImU32 color) const {
    list.AddText({at.x + from_em * em, at.y}, color, begin(text), end(text));
  }
  /// Cut off where it is too long.
  void say_within(const Text& text, float from_em, float to_em, ImU32 color) const {
    const ImVec4 clip{at.x + from_em * em, at.y, at.x + to_em * em, at.y + 2 * em};
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {clip.x, at.y}, color, begin(text), end(text), 0, &clip);
  }
  void say_up_to(const Text& text, float to_em, ImU32 color) const {
    say(text, to_em - ImGui::CalcTextSize(begin(text), end(text)).x / em, color);
  }
  void spot(ImU32 color) const {
    list.AddCircleFilled({at.x + 0.35F * em, at.y + 0.5F * ImGui::GetTextLineHeight()}, 0.3F * em, color, 16);
  }
};

void row(const HudWords::Marker& marker, const Pen& pen) {
  const ImU32 color = color_of(marker.kind);
  pen.spot(color);
  pen.say_within(marker.name, name_at, state_at - 0.5F, text_color);
  pen.say(marker.state, state_at, color);
  pen.say_up_to(marker.cells, cells_end, text_color);
  pen.say_up_to(marker.distance, distance_end, text_color);
}

/// Pixels.
ImVec2 size_of(const HudWords& words, float em) {
  const auto rows = static_cast<float>(words.markers().size()), lines = static_cast<float>(words.figures().size());
  const float height = 2 * padding + (rows + lines) * row_height + (rows > 0 ? between : 0);
  return {std::ceil((distance_end + 2 * padding) * em), std::ceil(height * em)};
}

void panel(const HudWords& words, const Viewport& view, float em) {
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::SetNextWindowPos({edge * em, static_cast<float>(view.height) - edge * em}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize(size_of(words, em), ImGuiCond_Always);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, plate_color);
  ImGui::Begin("figures", nullptr, flags);
  const ImVec2 corner = ImGui::GetWindowPos();
  Pen pen{*ImGui::GetWindowDrawList(), {corner.x + padding * em, corner.y + padding * em}, em};
  for (const HudWords::Marker& marker : words.markers()) {
    row(marker, pen);
    pen.at.y += row_height * em;
  }
  if (!words.markers().empty()) pen.at.y += between * em;
  for (const Text& line : words.figures()) {
    pen.say(line, 0, quiet_color);
    pen.at.y += row_height * em;
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

/// As much as there can ever be.
HudWords fullest() {
  FrameRecord record;
  record.marker_count = max_markers_per_frame;
  for (MarkerObservation& m : record.markers) {
    m.name.fill('l');  // narrow, so that many show
    m.name.back() = 0;
    m.state = MarkerState::predicted;
    m.cells_seen = max_cells_per_marker;
    m.T_camera_marker.translation.z = 99999;
  }
  HudWords words(true);
  words.update(record,
               {.tracker_ms = 99999,
                .pictures_a_second = 99999,
                .frames_a_second = 99999,
                .latency = Latency{Duration::from_seconds(99), Duration::from_seconds(99), Duration::from_seconds(99)},
                .left_out = 999'999'999'999});
  return words;
}

}  // namespace

DesktopHud::DesktopHud() {
  // Room for all that may come; large panels have rounder corners.
  const HudWords full = fullest();
  for (int i = 0; i < 3; ++i) lay_out(full, {0, 0, 16384, 16384});
}

const ImDrawData& DesktopHud::lay_out(const HudWords& words, const Viewport& view) {
  // Not too small to be read, unless the panel would be wider than the view.
  const double em = std::max(1.0, std::min(std::max(11.0, view.height / 52.0), view.width / widest));
  gui_.begin(view.width, view.height, em);
  panel(words, view, static_cast<float>(em));
  return gui_.end();
}

}  // namespace onestroke

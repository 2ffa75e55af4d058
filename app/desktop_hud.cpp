#include "app/desktop_hud.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

// Ems of the text: name, state, cells, distance. As wide whatever they say, so that the panel stands still.
constexpr std::array<float, 4> columns{11, 5.5F, 5, 5};
constexpr float edge_ems = 1;

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

void say(const Text& text, ImU32 color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.view().data(), text.view().data() + text.view().size());
  ImGui::PopStyleColor();
}

void say_on_the_right(const Text& text, ImU32 color) {
  const float width = ImGui::CalcTextSize(text.view().data(), text.view().data() + text.view().size()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, room - width));
  say(text, color);
}

/// A spot of the state's colour before the name.
void spot(ImU32 color, float em) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 0.35F * em, at.y + 0.5F * ImGui::GetTextLineHeight()}, 0.3F * em,
                                              color, 16);
  ImGui::Dummy({0.7F * em, 1});
  ImGui::SameLine(0, 0.4F * em);
}

void row(const HudWords::Marker& marker, float em) {
  const ImU32 color = color_of(marker.kind);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  spot(color, em);
  say(marker.name, text_color);
  ImGui::TableNextColumn();
  say(marker.state, color);
  ImGui::TableNextColumn();
  say_on_the_right(marker.cells, text_color);
  ImGui::TableNextColumn();
  say_on_the_right(marker.distance, text_color);
}

void table(const HudWords& words, float em) {
  constexpr ImGuiTableFlags flags =
      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_NoHostExtendX;
  if (words.markers().empty() || !ImGui::BeginTable("markers", columns.size(), flags)) return;
  for (const float ems : columns) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ems * em);
  for (const HudWords::Marker& marker : words.markers()) row(marker, em);
  ImGui::EndTable();
}

/// Of the panel, pixels: it must be known before there is anything in it.
ImVec2 size_of(const HudWords& words, float em) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const auto rows = static_cast<float>(words.markers().size()), lines = static_cast<float>(words.figures().size());
  const float text = ImGui::GetTextLineHeight();
  float width = 2 * style.WindowPadding.x;
  for (const float ems : columns) width += ems * em + 2 * style.CellPadding.x;
  float height = 2 * style.WindowPadding.y + lines * text + (lines - 1) * style.ItemSpacing.y;
  if (rows > 0) height += rows * (text + 2 * style.CellPadding.y) + style.ItemSpacing.y;
  return {std::ceil(width), std::ceil(height)};
}

void panel(const HudWords& words, const Viewport& view, float em) {
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::SetNextWindowPos({edge_ems * em, static_cast<float>(view.height) - edge_ems * em}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize(size_of(words, em), ImGuiCond_Always);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, plate_color);
  ImGui::Begin("figures", nullptr, flags);
  table(words, em);
  for (const Text& line : words.figures()) say(line, quiet_color);
  ImGui::End();
  ImGui::PopStyleColor();
}

/// As much as there can ever be.
HudWords fullest() {
  FrameRecord record;
  record.marker_count = max_markers_per_frame;
  for (MarkerObservation& m : record.markers) {
    m.name.fill('W');
    m.name.back() = 0;
    m.state = MarkerState::predicted;
    m.cells_seen = max_cells_per_marker;
    m.T_camera_marker.translation.z = 99999;
  }
  HudWords words(true);
  words.update(record, {.tracker_ms = 9999,
                        .pictures_a_second = 9999,
                        .frames_a_second = 9999,
                        .age = Duration::from_seconds(99),
                        .left_out = 999'999'999'999});
  return words;
}

}  // namespace

DesktopHud::DesktopHud() {
  // Room for all that may come.
  const HudWords full = fullest();
  for (int i = 0; i < 3; ++i) lay_out(full, {0, 0, 1920, 1080});
}

const ImDrawData& DesktopHud::lay_out(const HudWords& words, const Viewport& view) {
  const double em = std::max(11.0, view.height / 52.0);
  gui_.begin(view.width, view.height, em);
  panel(words, view, static_cast<float>(em));
  return gui_.end();
}

}  // namespace onestroke

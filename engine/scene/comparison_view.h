#pragma once

#include "core/frame_record.h"
#include "scene/compare_menu.h"
#include "scene/compare_modes.h"
#include "scene/hands.h"
#include "scene/measuring.h"
#include "scene/section_plane.h"
#include "scene/text.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace onestroke {

/// One hand's model, ready to be drawn.
struct HandView {
  bool held = false;
  int marker_id = 0;  ///< Also of a frozen model whose stick is gone.
  MarkerState state = MarkerState::lost;
  /// In place of T_world_marker: where the model's marker frame is shown. The stick's own pose where its own hand leads
  /// or nothing is linked. A size of its own only where the model is laid over another of another size.
  Similarity world_from_marker;
  double opacity = 0;  ///< 0 where nothing of it is to be drawn; eased when a stick is lost or found.
  double shown = 1;    ///< Of the model alone: 0 while its stick cuts another's.
  double card = 0;     ///< Of the card with what is known of the model.
  bool leads = false;  ///< Linked, and both models show this stick's rotation.
  bool frozen = false;
  std::optional<SectionPlane> cut;
  Text label;
};

/// How the right stick stands to the left one.
struct RelativePose {
  double angle_deg = 0;
  Vec3 axis;            ///< Unit, in the left stick's frame; zero where there is no turn to speak of.
  Vec3 euler_deg;       ///< Rotation (X, Y, Z).
  double distance = 0;  ///< Between the corners, mm.
  Text axis_words;
};

/// What the sticks are about to do.
struct OfferView {
  std::string_view words;
  Vec3 place_world;     ///< mm
  double progress = 0;  ///< 0 to 1.
};

struct ComparisonView {
  std::array<HandView, 2> hands;  ///< Left, right.
  CompareMode mode;
  Hand pointer = Hand::right;  ///< Whose stick cuts or measures.
  Hand base = Hand::left;      ///< On whose model the other's is laid.
  double laid = 0;             ///< How far it is; eased.
  MeasureView measure;
  std::optional<OfferView> offer;
  MenuView menu;
  bool both_visible = false;
  RelativePose relative;  ///< Valid where both are visible.
  bool snapshot = false;  ///< One is asked for in this frame.
  char asked_key = 0;     ///< A key of the program's own that was picked from the menu in this frame; 0 for none.
  /// What was done in this frame, in the words of the rules.
  std::array<std::string_view, 4> events{};
  int event_count = 0;
  std::array<Text, 4> lines;
  int line_count = 0;

  const HandView& operator[](Hand h) const { return hands[static_cast<std::size_t>(h)]; }
  std::span<const Text> hud() const { return {lines.data(), static_cast<std::size_t>(line_count)}; }
  std::span<const std::string_view> happened() const { return {events.data(), static_cast<std::size_t>(event_count)}; }
};

}  // namespace onestroke

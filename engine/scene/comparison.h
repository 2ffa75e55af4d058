#pragma once

#include "core/frame_record.h"
#include "scene/compare_menu.h"
#include "scene/comparison_view.h"
#include "scene/hands.h"
#include "scene/measuring.h"
#include "scene/sign_finder.h"
#include "scene/turning.h"

#include <array>
#include <span>

namespace onestroke {

/// What a marker carries. Where it carries nothing, or nothing yet, the pivot is the stick's corner and the reach zero.
struct CarriedModel {
  int marker_id = 0;
  Text words{};      ///< What the label says besides the marker's name: the model's, or how far it is with loading.
  Vec3 pivot{};      ///< What the model turns about when it is turned on its own: its middle. Marker frame, mm.
  double reach = 0;  ///< No part of the model is farther from the pivot, mm.
  Similarity marker_from_model{};  ///< From the model's own frame in metres.
  StickPoints points{};            ///< Where the stick touches others; marker frame, mm.
};

struct ComparisonOptions {
  bool left_handed = false;  ///< The left hand points, the right one holds.
};

/// The comparison of two models, one in each hand. The hand that is not preferred sets the frame, the preferred one
/// works in it (Guiard 1987; Hinckley 1994). What the sticks do changes the mode as compare_modes.h says; keys do the
/// same. No rendering, no clock of its own: the same records and keys at the same times give the same views. One
/// thread. No allocation after the constructor.
class Comparison {
 public:
  static constexpr Duration fade_in = Duration::from_ms(150), fade_out = Duration::from_ms(400);
  /// The other stick takes the lead when it turns by more than this (TurnMeter's angle) and clearly more than the
  /// leader.
  static constexpr double takes_lead = 0.25;
  static constexpr double clearly_more = 2;
  /// A leader out of sight for so long hands the lead to the visible stick.
  static constexpr Duration leader_missed = Duration::from_ms(300);
  /// A mode of two sticks ends when one was not seen for so long: what is shown of it can then fade before its hand
  /// forgets it.
  static constexpr Duration gone_after = Duration::from_ms(1000);
  static_assert(gone_after + fade_out < Hands::forgotten_after);
  /// A plane that cuts keeps the side away from the eyes; the sine of how far it turns past them before it keeps the
  /// other one.
  static constexpr double turns_over = 0.2;
  /// A stick so near to the eyes shows its model's card, until it is farther than the second; mm.
  static constexpr double card_within = 300, card_beyond = 340;
  static constexpr Duration card_after = Duration::from_ms(400);

  /// What is carried outlives this, stays where it is, and may change between updates.
  explicit Comparison(std::span<const CarriedModel> carried, const ComparisonOptions& options = {});
  /// As in the constructor, in place of what was carried.
  void carry(std::span<const CarriedModel> carried) { carried_ = carried; }
  /// How the model that is laid over the other fits it best, in the models' own frames, metres; none where that is not
  /// known, or not yet.
  void set_fit(const std::optional<Similarity>& base_from_laid);

  /// Keys that go through the menu without a stick, and open it where it is closed.
  static constexpr char next_entry = '\t', pick_entry = '\n';

  /// What a key does happens with the next update: those of sign_keys, x (exchanges the hands), i (the cards), and the
  /// menu's two. False where it means nothing.
  bool press(char key);
  /// One frame. `now` is the time that the frame shows; it does not go back.
  const ComparisonView& update(const FrameRecord& record, Time now);
  const ComparisonView& view() const { return view_; }

 private:
  // What belongs to a stick besides where it is; it changes hands with it.
  struct Motion {
    int id = 0;
    Eased presence;
    bool fresh = true;  // nothing of it was shown before
    BlendedPlace place;
    TurnMeter turn;
    std::optional<ModelPlace> frozen;
    std::optional<Time> near_since;
    bool near = false;
    Eased card, aside;  // aside: the model of a stick that cuts is not to be seen
  };

  Motion& motion(Hand h) { return motions_[static_cast<std::size_t>(h)]; }
  const Motion& motion(Hand h) const { return motions_[static_cast<std::size_t>(h)]; }
  HandView& seen(Hand h) { return view_.hands[static_cast<std::size_t>(h)]; }
  Hand preferred() const { return options_.left_handed ? Hand::left : Hand::right; }
  bool linked() const { return mode_.link != Link::apart; }
  /// Carried by the stick that the hand holds, or held.
  const CarriedModel& carried_by(Hand h) const;

  void exchange_hands();
  void follow_motion(Hand h, Duration step);
  void follow_card(Hand h, Duration step, Time now);
  void press_keys();
  void toggle_menu();
  void press_menu_key(char key);
  void take_entry(char key);
  void fill_menu_entries();
  void update_menu(Duration step);
  void look_for_signs(Time now);
  void apply(const MadeSign& made);
  void tell(std::string_view words);
  /// The right stick's rotation in the left one's frame.
  Quat right_to_left() const;
  /// What a sign is offered as, and written down as.
  std::string_view words_of(const ModeRule& rule, const MadeSign& made) const;
  Hand to_freeze(const MadeSign& made) const;
  void freeze(const MadeSign& made);
  void choose_leader(Time now);
  /// The stick whose turns both models must show in this mode, where it is not the one that turns most.
  std::optional<Hand> set_leader() const;

  Quat followed(Hand h) const;
  Vec3 held_middle(Hand h) const;
  /// Where the hand's model belongs now. That of the other hand has been placed before, where it depends on it.
  ModelPlace target(Hand h) const;
  Similarity world_from_marker(Hand h) const;
  Similarity base_from_laid() const;
  void place(Hand h, Time now);

  Vec3 pointing_tip() const;
  void turn_plane();
  void cut(Duration step);
  void measure(Duration step, Time now);
  void fill_hand(Hand h, Time now);
  void fill_offer();
  void fill_relative();

  std::span<const CarriedModel> carried_;
  ComparisonOptions options_;
  Hands hands_;
  SignFinder signs_;
  CompareMenu menu_;
  std::array<Motion, 2> motions_;
  CompareMode mode_;
  Hand leader_ = Hand::left;
  Hand pointer_ = Hand::right, base_ = Hand::left;  // roles, where the mode has them
  Hand menu_hand_ = Hand::right;                    // whose tip points, while the menu is open
  std::array<char, 8> keys_{};
  std::size_t key_count_ = 0;
  bool cards_ = false, changed_ = false, plane_flipped_ = false, plane_turns_ = false;
  Pose T_world_camera_;
  Vec3 mirror_normal_{1, 0, 0};
  std::optional<Similarity> fit_;
  Eased laid_, cutting_, measuring_;
  SectionPlane plane_;
  Measuring ruler_;
  FrameSteps frames_;
  Time now_;
  ComparisonView view_;
};

}  // namespace onestroke

#pragma once

#include "core/frame_record.h"
#include "scene/hands.h"
#include "scene/link_gesture.h"
#include "scene/text.h"
#include "scene/turning.h"

#include <array>
#include <span>

namespace onestroke {

/// What a marker carries. Where it carries nothing, or nothing yet, the pivot is the stick's corner.
struct CarriedModel {
  int marker_id = 0;
  Text words{};  ///< What the label says besides the marker's name: the model's, or how far it is with loading.
  Vec3 pivot{};  ///< What the model turns about when it is turned on its own: its middle. Marker frame, mm.
};

/// One hand's model, ready to be drawn.
struct HandView {
  bool held = false;
  int marker_id = 0;
  MarkerState state = MarkerState::lost;
  /// In place of T_world_marker: the stick's place with the rotation that the model shows. Equal to the stick's own
  /// pose where the hand leads or nothing is linked.
  Pose T_world_model;
  double opacity = 0;  ///< 0 where the model is not to be drawn; eased when a stick is lost or found.
  bool leads = false;  ///< Linked, and both models show this stick's rotation.
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

struct ComparisonView {
  std::array<HandView, 2> hands;  ///< Left, right.
  bool linked = false;
  double link_progress = 0;  ///< Of the gesture that links or unlinks, 0 to 1.
  bool both_visible = false;
  RelativePose relative;  ///< Valid where both are visible.
  std::array<Text, 4> lines;
  int line_count = 0;

  const HandView& operator[](Hand h) const { return hands[static_cast<std::size_t>(h)]; }
  std::span<const Text> hud() const { return {lines.data(), static_cast<std::size_t>(line_count)}; }
};

/// The comparison of two models, one in each hand. Unlinked, each model turns with its own stick. Linked, both show the
/// same side: that of the stick which turned last, while each stays at its own stick's place. No rendering, no clock of
/// its own: the same records at the same times give the same views. One thread. No allocation after the constructor.
class Comparison {
 public:
  static constexpr Duration fade_in = Duration::from_ms(150), fade_out = Duration::from_ms(400);
  /// The other stick takes the lead when it turns by more than this (TurnMeter's angle) and clearly more than the
  /// leader.
  static constexpr double takes_lead = 0.25;
  static constexpr double clearly_more = 2;
  /// A leader out of sight for so long hands the lead to the visible stick.
  static constexpr Duration leader_missed = Duration::from_ms(300);

  /// What is carried outlives this, stays where it is, and may change between updates.
  explicit Comparison(std::span<const CarriedModel> carried) : carried_(carried) {}
  /// As in the constructor, in place of what was carried.
  void carry(std::span<const CarriedModel> carried) { carried_ = carried; }

  /// What the key does: links, or unlinks, with the next update.
  void toggle() { toggle_asked_ = !toggle_asked_; }
  /// One frame. `now` is the time that the frame shows; it does not go back.
  const ComparisonView& update(const FrameRecord& record, Time now);
  const ComparisonView& view() const { return view_; }

 private:
  // What belongs to a stick besides where it is; it changes hands with it.
  struct Motion {
    int id = 0;
    double presence = 0;  // Linear in time; the opacity is its smooth step.
    BlendedRotation rotation;
    TurnMeter turn;
  };

  Motion& motion(Hand h) { return motions_[static_cast<std::size_t>(h)]; }
  Quat own(Hand h) const { return hands_[h].T_world_marker.rotation; }
  Quat followed(Hand h) const { return own(linked_ ? leader_ : h); }
  void follow_motion(Hand h, Duration step);
  bool choose_link(Time now);
  bool choose_leader(Time now);
  void fill_hand(Hand h, Time now);
  void fill_relative();
  const CarriedModel* carried_by(int marker_id) const;

  std::span<const CarriedModel> carried_;
  Hands hands_;
  LinkGesture gesture_;
  std::array<Motion, 2> motions_;
  bool linked_ = false, toggle_asked_ = false, started_ = false;
  Hand leader_ = Hand::left;
  Time last_;
  ComparisonView view_;
};

}  // namespace onestroke

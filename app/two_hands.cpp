#include "app/two_hands.h"

#include "app/label_layout.h"
#include "scene/frames.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace onestroke {
namespace {

constexpr double axis_length = 40;  // mm
constexpr Color leader_color{0.9F, 0.92F, 0.95F, 0.55F};
constexpr Color leading_plate{0.01F, 0.06F, 0.16F, 0.85F};

Matrix4 to_array(const glm::mat4& m) {
  Matrix4 values;
  std::copy_n(glm::value_ptr(m), values.size(), values.begin());
  return values;
}

glm::mat4 to_graphics(const Similarity& s) {
  const auto scale = static_cast<float>(s.scale);
  return glm::scale(onestroke::to_graphics(Pose{s.rotation, s.translation}), glm::vec3(scale));
}

ClipPlane to_graphics(const SectionPlane& plane) {
  const glm::vec3 n = direction_to_graphics(plane.normal);
  return {n.x, n.y, n.z, static_cast<float>(-plane.offset * metres_per_millimetre)};
}

/// Between frames of models, which are graphics' own: metres and y up.
Similarity to_similarity(const glm::dmat4& rigid) {
  const auto at = [&](glm::length_t row, glm::length_t column) { return rigid[column][row]; };
  const Mat3 rotation{{{at(0, 0), at(0, 1), at(0, 2)}, {at(1, 0), at(1, 1), at(1, 2)}, {at(2, 0), at(2, 1), at(2, 2)}}};
  return {to_quat(rotation), {at(0, 3), at(1, 3), at(2, 3)}, 1};
}

}  // namespace

TwoHands::TwoHands(const ModelShelf& shelf, DifferenceDesk* differences, const TwoHandsOptions& options)
    : shelf_(shelf),
      differences_(differences),
      options_(options),
      comparison_(shelf.carried(), {.left_handed = options.left_handed}),
      picture_depth_(shelf) {}

const FrameScene& TwoHands::update(const FrameRecord& record, Time now, std::span<const View> views,
                                   std::string_view status) {
  comparison_.update(record, now);
  look_at_difference(frames_.step_to(now));
  builder_.clear();
  add_sticks(record);
  add_models();
  if (!views.empty()) {
    const View& view = views.front();
    add_labels(view);
    add_cards(view);
    add_planes(view);
    measure_.draw(builder_, view, comparison_.view().measure);
    draw_menu(builder_, view, comparison_.view().menu);
    if (comparison_.view().offer) draw_offer(builder_, view, *comparison_.view().offer);
    const double em = text_em(view);
    area_ = hud_area(views, options_.worn);
    scene_.hud_plate = area_.plate;
    if (difference_) legend_.draw(builder_, area_, em, difference_->statistics, map_.value());
    if (words_) add_words(em, status);
    if (!notice_.empty()) add_notice(em);
  }
  scene_.passthrough_segments = picture_depth_.update(record, now);
  builder_.give(scene_);
  return scene_;
}

// What was found out in this frame moves the model in the next.
void TwoHands::look_at_difference(Duration step) {
  const ComparisonView& compared = comparison_.view();
  if (compared.laid <= 0 || !differences_) {
    map_.reset();
    difference_ = nullptr;
    comparison_.set_fit(std::nullopt);
    return;
  }
  const int base = compared[compared.base].marker_id, laid = compared[other(compared.base)].marker_id;
  // A mode that is left keeps what it has shown while it fades.
  if (compared.mode.laid_over()) {
    const Alignment alignment = compared.mode.tool == Tool::fitted ? Alignment::best_fit : Alignment::own_frames;
    differences_->request(base, laid, alignment);
    if (options_.wait_for_differences) differences_->wait();
    if (const DifferenceDesk::Result* result = differences_->result(); result && alignment == Alignment::best_fit)
      comparison_.set_fit(to_similarity(result->base_from_laid));
  }
  difference_ = differences_->result();
  map_.update(compared.mode.laid_over() && difference_, step);
}

void TwoHands::add_sticks(const FrameRecord& record) {
  for (const MarkerObservation& m : record.seen()) {
    const ShelfEntry* entry = shelf_.find(m.id);
    if (!entry || m.state == MarkerState::lost) continue;
    builder_.instances.push_back(
        {.model = entry->rod,
         .world_graphics_from_model = to_array(to_graphics(Similarity(record.T_world_camera * m.T_camera_marker))),
         .occluder = true});
  }
}

// Of two models at one place only one is drawn: the laid one, or the map of how it differs.
void TwoHands::add_models() {
  const ComparisonView& compared = comparison_.view();
  for (const Hand h : both_hands) {
    const HandView& hand = compared[h];
    if (hand.opacity <= 0) continue;
    const double covered = h == compared.base ? compared.laid : map_.value();
    add_model(hand, hand.opacity * hand.shown * (1 - covered));
    add_axes(hand);
  }
  if (difference_) add_difference(compared);
}

void TwoHands::add_model(const HandView& hand, double opacity) {
  const ShelfEntry* entry = shelf_.find(hand.marker_id);
  if (!entry || !entry->model || opacity <= 0) return;
  ModelInstance instance{.model = *entry->model,
                         .world_graphics_from_model = to_array(to_graphics(hand.world_from_marker) *
                                                               entry->placement.marker_graphics_from_model),
                         .tint = {1, 1, 1, static_cast<float>(opacity)}};
  if (hand.cut) {
    instance.clip_plane = to_graphics(*hand.cut);
    instance.fill_cut = entry->closed;
  }
  builder_.instances.push_back(instance);
}

void TwoHands::add_difference(const ComparisonView& compared) {
  const auto add = [&](ModelHandle model, const HandView& hand) {
    const ShelfEntry* entry = shelf_.find(hand.marker_id);
    const double opacity = hand.opacity * map_.value();
    if (!entry || opacity <= 0) return;
    builder_.instances.push_back({.model = model,
                                  .world_graphics_from_model = to_array(to_graphics(hand.world_from_marker) *
                                                                        entry->placement.marker_graphics_from_model),
                                  .tint = {1, 1, 1, static_cast<float>(opacity)}});
  };
  add(difference_->map, compared[other(compared.base)]);
  if (difference_->veil) add(*difference_->veil, compared[compared.base]);
}

// A stick without a model still shows which way it stands.
void TwoHands::add_axes(const HandView& hand) {
  const ShelfEntry* entry = shelf_.find(hand.marker_id);
  if (entry && entry->model) return;
  const Similarity& T = hand.world_from_marker;
  add_line(T.translation, T * Vec3{axis_length, 0, 0}, 3, faded({0.9F, 0.05F, 0.05F, 1}, hand.opacity));
  add_line(T.translation, T * Vec3{0, axis_length, 0}, 3, faded({0.05F, 0.7F, 0.05F, 1}, hand.opacity));
  add_line(T.translation, T * Vec3{0, 0, axis_length}, 3, faded({0.1F, 0.25F, 1, 1}, hand.opacity));
}

void TwoHands::add_labels(const View& view) {
  const ComparisonView& compared = comparison_.view();
  std::array<LabelWish, 2> wishes;
  std::array<const HandView*, 2> hands{};
  std::array<double, 2> opacity{};
  std::size_t count = 0;
  for (const Hand h : both_hands) {
    const HandView& hand = compared[h];
    if (hand.opacity <= 0) continue;
    const ShelfEntry* entry = shelf_.find(hand.marker_id);
    const bool has_model = entry && entry->model;
    const Similarity& T = hand.world_from_marker;
    hands[count] = &hand;
    opacity[count] = hand.opacity * hand.shown * (1 - hand.card) * (1 - compared.menu.amount);
    wishes[count++] = {hand.label.view(), has_model ? T * entry->placement.pivot : T.translation,
                       has_model ? T.scale * entry->placement.reach : axis_length};
  }
  std::array<std::optional<LabelPlace>, 2> places;
  place_labels(view, {wishes.data(), count}, places);
  for (std::size_t i = 0; i < count; ++i) {
    if (!places[i] || opacity[i] <= 0) continue;
    Label label = label_on_top(wishes[i].text, places[i]->position_world, places[i]->height_px, opacity[i],
                               hands[i]->leads ? leading_plate : Label{}.plate);
    label.pivot_y = 1;
    builder_.labels.push_back(label);
    add_line(places[i]->position_world, places[i]->leader_world, 1.5, faded(leader_color, opacity[i]));
  }
}

// Beside its model, on the hand's own side, where there is room for it.
void TwoHands::add_cards(const View& view) {
  const ComparisonView& compared = comparison_.view();
  for (const Hand h : both_hands) {
    const HandView& hand = compared[h];
    const ShelfEntry* entry = shelf_.find(hand.marker_id);
    const double opacity = hand.card * hand.opacity * hand.shown;
    bool& right = card_right_[static_cast<std::size_t>(h)];
    bool& shown = card_shown_[static_cast<std::size_t>(h)];
    const bool before = std::exchange(shown, entry && opacity > 0);
    if (!shown) continue;
    const LabelWish card{entry->card, hand.world_from_marker * entry->placement.pivot, entry->placement.reach};
    // It stays on the side that it came on.
    if (!before) right = card_fits_right(view, card, h == Hand::right);
    const CardPlace place = place_card(view, card, right);
    Label label = label_on_top(entry->card, place.position_world, place.height_px, opacity);
    label.pivot_x = label.pivot_y = 0;
    builder_.labels.push_back(label);
  }
}

void TwoHands::add_planes(const View& view) {
  for (const HandView& hand : comparison_.view().hands) {
    const ShelfEntry* entry = shelf_.find(hand.marker_id);
    if (!hand.cut || !entry) continue;
    draw_plane(builder_, view, *hand.cut, hand.world_from_marker * entry->placement.pivot, entry->placement.reach,
               hand.opacity * hand.shown);
  }
}

void TwoHands::add_notice(double em) {
  add_text(notice_, area_.width - 0.8 * em, area_.height - 0.8 * em, 1, 1, em);
}

void TwoHands::add_words(double em, std::string_view status) {
  const ComparisonView& compared = comparison_.view();
  const double edge = 0.8 * em, line = 1.8 * em;
  double y = edge;
  const auto add = [&](std::string_view words) {
    if (words.empty()) return;
    add_text(words, edge, y, 0, 0, em);
    y += line;
  };
  for (const Text& words : compared.hud()) add(words.view());
  if (compared.mode.laid_over() && differences_) {
    for (Text& words : statistics_) words.clear();
    if (difference_) print_statistics(difference_->statistics, statistics_);
    if (differences_->state() == DifferenceDesk::State::working)
      statistics_[0].print("Comparing the surfaces: %d %%", differences_->percent());
    if (differences_->state() == DifferenceDesk::State::failed) statistics_[0] = Text(differences_->reason());
    for (const Text& words : statistics_) add(words.view());
  }
  if (!status.empty()) add_text(status, edge, area_.height - edge, 0, 1, em);
}

void TwoHands::add_line(Vec3 from, Vec3 to, double width_px, Color color) {
  builder_.lines.push_back({from, to, width_px, color});
}

void TwoHands::add_text(std::string_view text, double x, double y, double pivot_x, double pivot_y, double height_px) {
  builder_.texts.push_back(
      {.text = text, .x = x, .y = y, .height_px = height_px, .pivot_x = pivot_x, .pivot_y = pivot_y});
}

}  // namespace onestroke

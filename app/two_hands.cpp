#include "app/two_hands.h"

#include "app/label_layout.h"
#include "scene/frames.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

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

Color faded(Color color, double opacity) {
  color.a *= static_cast<float>(opacity);
  return color;
}

}  // namespace

TwoHands::TwoHands(const ModelShelf& shelf) : shelf_(shelf), comparison_(shelf.carried()), picture_depth_(shelf) {}

const FrameScene& TwoHands::update(const FrameRecord& record, Time now, std::span<const View> views,
                                   std::string_view status) {
  comparison_.update(record, now);
  instance_count_ = line_count_ = label_count_ = text_count_ = 0;
  add_sticks(record);
  for (const HandView& hand : comparison_.view().hands) {
    if (hand.opacity <= 0) continue;
    add_model(hand);
    add_axes(hand);
  }
  if (!views.empty()) {
    add_labels(views.front());
    if (words_) add_words(views.front(), status);
  }
  scene_.passthrough_segments = picture_depth_.update(record, now);
  scene_.instances = {instances_.data(), instance_count_};
  scene_.lines = {lines_.data(), line_count_};
  scene_.labels = {labels_.data(), label_count_};
  scene_.hud = {texts_.data(), text_count_};
  return scene_;
}

void TwoHands::add_sticks(const FrameRecord& record) {
  for (const MarkerObservation& m : record.seen()) {
    const ShelfEntry* entry = shelf_.find(m.id);
    if (!entry || m.state == MarkerState::lost) continue;
    instances_[instance_count_++] = {
        .model = entry->rod,
        .world_graphics_from_model = to_array(to_graphics(record.T_world_camera * m.T_camera_marker)),
        .occluder = true};
  }
}

void TwoHands::add_model(const HandView& hand) {
  const ShelfEntry* entry = shelf_.find(hand.marker_id);
  if (!entry || !entry->model) return;
  instances_[instance_count_++] = {.model = *entry->model,
                                   .world_graphics_from_model = to_array(to_graphics(hand.T_world_model) *
                                                                         entry->placement.marker_graphics_from_model),
                                   .tint = {1, 1, 1, static_cast<float>(hand.opacity)}};
}

// A stick without a model still shows which way it stands.
void TwoHands::add_axes(const HandView& hand) {
  const ShelfEntry* entry = shelf_.find(hand.marker_id);
  if (entry && entry->model) return;
  const Pose& T = hand.T_world_model;
  add_line(T.translation, T * Vec3{axis_length, 0, 0}, 3, faded({0.9F, 0.05F, 0.05F, 1}, hand.opacity));
  add_line(T.translation, T * Vec3{0, axis_length, 0}, 3, faded({0.05F, 0.7F, 0.05F, 1}, hand.opacity));
  add_line(T.translation, T * Vec3{0, 0, axis_length}, 3, faded({0.1F, 0.25F, 1, 1}, hand.opacity));
}

void TwoHands::add_labels(const View& view) {
  std::array<LabelWish, 2> wishes;
  std::array<const HandView*, 2> hands{};
  std::size_t count = 0;
  for (const HandView& hand : comparison_.view().hands) {
    if (hand.opacity <= 0) continue;
    const ShelfEntry* entry = shelf_.find(hand.marker_id);
    const bool has_model = entry && entry->model;
    hands[count] = &hand;
    wishes[count++] = {hand.label.view(),
                       has_model ? hand.T_world_model * entry->placement.pivot : hand.T_world_model.translation,
                       has_model ? entry->placement.reach : axis_length};
  }
  std::array<std::optional<LabelPlace>, 2> places;
  place_labels(view, {wishes.data(), count}, places);
  for (std::size_t i = 0; i < count; ++i) {
    if (!places[i]) continue;
    const HandView& hand = *hands[i];
    labels_[label_count_++] = {.text = wishes[i].text,
                               .position_world = places[i]->position_world,
                               .height_px = places[i]->height_px,
                               .pivot_y = 1,
                               .color = faded(Color{}, hand.opacity),
                               .plate = faded(hand.leads ? leading_plate : Label{}.plate, hand.opacity),
                               .on_top = true};
    add_line(places[i]->position_world, places[i]->leader_world, 1.5, faded(leader_color, hand.opacity));
  }
}

void TwoHands::add_words(const View& view, std::string_view status) {
  const ComparisonView& compared = comparison_.view();
  const double em = std::max(13.0, view.viewport.height / 42.0), edge = 0.8 * em, line = 1.8 * em;
  double y = edge;
  for (const Text& words : compared.hud()) {
    add_text(words.view(), edge, y, 0, 0, em);
    y += line;
  }
  if (compared.link_progress > 0) {
    constexpr int squares = 12;
    const int filled = std::clamp(static_cast<int>(std::lround(compared.link_progress * squares)), 0, squares);
    char bar[3 * squares + 1] = {};
    for (int i = 0; i < squares; ++i) std::copy_n(i < filled ? "■" : "□", 3, bar + 3 * i);
    link_words_.print("%s %s", compared.linked ? "Parting" : "Linking", bar);
    add_text(link_words_.view(), view.viewport.width / 2.0, view.viewport.height - 3 * line, 0.5, 1, 1.2 * em);
  }
  if (!status.empty()) add_text(status, edge, view.viewport.height - edge, 0, 1, 0.8 * em);
}

void TwoHands::add_line(Vec3 from, Vec3 to, double width_px, Color color) {
  lines_[line_count_++] = {from, to, width_px, color};
}

void TwoHands::add_text(std::string_view text, double x, double y, double pivot_x, double pivot_y, double height_px) {
  texts_[text_count_++] = {
      .text = text, .x = x, .y = y, .height_px = height_px, .pivot_x = pivot_x, .pivot_y = pivot_y};
}

}  // namespace onestroke

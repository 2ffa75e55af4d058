#pragma once

#include "app/model_shelf.h"
#include "app/picture_depth.h"
#include "render/frame_scene.h"
#include "render/view.h"
#include "scene/comparison.h"

#include <array>
#include <span>
#include <string_view>

namespace onestroke {

/// What the wearer sees over the picture: the model of the stick in each hand, its name, the comparison of the two, and
/// every stick's own body as something that hides what is behind it. One thread; no allocation after the constructor.
class TwoHands {
 public:
  /// The shelf outlives this.
  explicit TwoHands(const ModelShelf& shelf);

  /// After the shelf was made again in its place.
  void shelf_is_new() { comparison_.carry(shelf_.carried()); }
  void toggle_link() { comparison_.toggle(); }
  void toggle_words() { words_ = !words_; }
  bool words() const { return words_; }

  /// The scene of one frame: where the record's markers were, seen through these views. `now` does not go back.
  /// `status` is a line for the foot of the screen and may be empty. What is returned lives until the next call.
  const FrameScene& update(const FrameRecord& record, Time now, std::span<const View> views, std::string_view status);
  const ComparisonView& comparison() const { return comparison_.view(); }

 private:
  static constexpr std::size_t most_instances = 2 + max_markers_per_frame, most_lines = 2 * 4, most_texts = 6;

  void add_sticks(const FrameRecord& record);
  void add_model(const HandView& hand);
  void add_axes(const HandView& hand);
  void add_labels(const View& view);
  void add_words(const View& view, std::string_view status);
  void add_line(Vec3 from, Vec3 to, double width_px, Color color);
  void add_text(std::string_view text, double x, double y, double pivot_x, double pivot_y, double height_px);

  const ModelShelf& shelf_;
  Comparison comparison_;
  PictureDepth picture_depth_;
  bool words_ = true;
  Text link_words_;
  std::array<ModelInstance, most_instances> instances_;
  std::array<Line, most_lines> lines_;
  std::array<Label, 2> labels_;
  std::array<HudText, most_texts> texts_;
  std::size_t instance_count_ = 0, line_count_ = 0, label_count_ = 0, text_count_ = 0;
  FrameScene scene_;
};

}  // namespace onestroke

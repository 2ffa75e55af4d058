#pragma once

#include "app/comparison_drawing.h"
#include "app/difference_desk.h"
#include "app/difference_legend.h"
#include "app/model_shelf.h"
#include "app/picture_depth.h"
#include "app/scene_builder.h"
#include "scene/comparison.h"

#include <array>
#include <span>
#include <string_view>

namespace onestroke {

struct TwoHandsOptions {
  bool left_handed = false;
  bool worn = false;  ///< Whether the display is before the wearer's eyes rather than on a desk.
  /// Waits until the difference of two models that are laid over each other is known, rather than show how far it is:
  /// for films, so that one recording always gives the same.
  bool wait_for_differences = false;
};

/// What the wearer sees over the picture: the model of the stick in each hand, its name, the comparison of the two, and
/// every stick's own body as something that hides what is behind it. One thread; no allocation after the constructor.
class TwoHands {
 public:
  /// The shelf outlives this, and so does the desk; without one no map of differences is shown.
  explicit TwoHands(const ModelShelf& shelf, DifferenceDesk* differences = nullptr,
                    const TwoHandsOptions& options = {});

  /// After the shelf was made again in its place.
  void shelf_is_new() { comparison_.carry(shelf_.carried()); }
  /// False where the key means nothing to the comparison.
  bool press(char key) { return comparison_.press(key); }
  /// For the lower right corner, from the next frame on; lives until then. Empty for nothing.
  void say(std::string_view notice) { notice_ = notice; }
  void toggle_words() { words_ = !words_; }
  bool words() const { return words_; }

  /// The scene of one frame: where the record's markers were, seen through these views. `now` does not go back.
  /// `status` is a line for the foot of the screen and may be empty. What is returned lives until the next call.
  const FrameScene& update(const FrameRecord& record, Time now, std::span<const View> views, std::string_view status);
  const ComparisonView& comparison() const { return comparison_.view(); }
  /// Of the models that are laid over each other; null where there are none, or it is not known yet.
  const DifferenceDesk::Result* difference() const { return difference_; }

 private:
  void look_at_difference(Duration step);
  void add_sticks(const FrameRecord& record);
  void add_models();
  void add_model(const HandView& hand, double opacity);
  void add_difference(const ComparisonView& compared);
  void add_axes(const HandView& hand);
  void add_labels(const View& view);
  void add_cards(const View& view);
  void add_planes(const View& view);
  void add_words(double em, std::string_view status);
  void add_notice(double em);
  void add_line(Vec3 from, Vec3 to, double width_px, Color color);
  void add_text(std::string_view text, double x, double y, double pivot_x, double pivot_y, double height_px);

  const ModelShelf& shelf_;
  DifferenceDesk* differences_;
  const TwoHandsOptions options_;
  Comparison comparison_;
  PictureDepth picture_depth_;
  MeasureDrawing measure_;
  DifferenceLegend legend_;
  const DifferenceDesk::Result* difference_ = nullptr;
  Eased map_;                                        // the map in place of the model that is laid
  std::array<bool, 2> card_right_{}, card_shown_{};  // by hand
  bool words_ = true;
  FrameSteps frames_;
  std::string_view notice_;
  std::array<Text, 3> statistics_;
  HudArea area_;
  SceneBuilder builder_;
  FrameScene scene_;
};

}  // namespace onestroke

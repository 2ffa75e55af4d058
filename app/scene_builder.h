#pragma once

#include "core/frame_record.h"
#include "core/inline_vector.h"
#include "render/frame_scene.h"
#include "render/view.h"

#include <optional>
#include <span>

namespace onestroke {

/// Collects what one frame shows. Holds a bounded number of each; allocates nothing. Texts live elsewhere, until the
/// frame is drawn.
class SceneBuilder {
 public:
  InlineVector<ModelInstance, 8 + max_markers_per_frame> instances;
  InlineVector<Line, 32> lines;
  InlineVector<Label, 28> labels;
  InlineVector<Gauge, 8> gauges;
  InlineVector<HudBox, 64> boxes;
  InlineVector<HudText, 24> texts;

  void clear();
  /// Into a scene that borrows from this.
  void give(FrameScene& scene) const;
};

Color faded(Color color, double opacity);

/// A text in the world that no model hides, as opaque as it says; centred about its place.
Label label_on_top(std::string_view text, Vec3 position_world, double height_px, double opacity,
                   Color plate = Label{}.plate);

/// Font size of a view's texts, px: to be read at arm's length on a desk, and one degree of visual angle, whatever it
/// is seen through.
double text_em(const View& view);
/// Where a frame's words and boxes go: a view's screen, or for eyes that wear the display a plate that both see whole.
struct HudArea {
  double width = 0, height = 0;  ///< Pixels of the first view.
  std::optional<HudPlate> plate{};
};
HudArea hud_area(std::span<const View> views, bool worn);

/// The length that a pixel of the view's middle has at that depth, mm.
double pixel_at(const View& view, double depth);

}  // namespace onestroke

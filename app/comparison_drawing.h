#pragma once

#include "app/scene_builder.h"
#include "scene/comparison_view.h"

#include <array>

namespace onestroke {

/// What the sticks are about to do: its words and a ring that fills. One thread; allocates nothing.
void draw_offer(SceneBuilder& scene, const View& view, const OfferView& offer);

/// The menu's entries where they hang, what to do, and a ring where the tip points.
void draw_menu(SceneBuilder& scene, const View& view, const MenuView& menu);

/// The plane that cuts a model, as a frame round the model's ball. `opacity` with which it stands out.
void draw_plane(SceneBuilder& scene, const View& view, const SectionPlane& plane, Vec3 middle, double reach,
                double opacity);

/// The points that are measured, what lies between them, and the ring of the one that is being picked. Keeps the words
/// of its labels. One thread; allocates nothing.
class MeasureDrawing {
 public:
  void draw(SceneBuilder& scene, const View& view, const MeasureView& measure);

 private:
  std::array<Text, 3> words_;
};

}  // namespace onestroke

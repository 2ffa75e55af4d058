#pragma once

#include "render/frame_scene.h"
#include "render/screen_bounds.h"
#include "render/view.h"
#include "shaders/shared.h"

#include <span>
#include <vector>

namespace onestroke {

/// Turns labels, gauges, lines and what is on the screen into what the shaders draw. Keeps its memory from frame to
/// frame.
class Overlay {
 public:
  /// Labels and gauges face the middle of the views, which has the first view's orientation and pixels.
  void build(const FrameScene& scene, std::span<const View> views);

  /// In drawing order: labels and gauges that models hide, then those on top, then boxes and texts of the screen.
  std::span<const gpu::QuadData> quads() const { return quads_; }
  /// How many of them, from the front, are tested against depth.
  std::uint32_t tested() const { return tested_; }
  std::span<const gpu::LineData> lines() const { return lines_; }
  /// Where what models may hide lies: lines and the quads that are tested.
  void add_to(ScreenBounds& bounds) const;

 private:
  struct Frame;
  struct Marking {
    float distance;
    const Label* label;
    const Gauge* gauge;  // where there is no label
    bool on_top() const { return label ? label->on_top : gauge->on_top; }
  };

  void sort_markings(const FrameScene& scene, const Frame& frame);
  void add_label(const Label& label, const Frame& frame);
  void add_gauge(const Gauge& gauge, const Frame& frame);
  void hang_up(const HudPlate& plate, std::size_t first, const Frame& frame);
  void add_box(const HudBox& box);
  void add_hud(const HudText& text);
  void add_text(std::string_view text, const gpu::QuadData& plate, const Color& color, float em_width);

  std::vector<gpu::QuadData> quads_;
  std::vector<gpu::LineData> lines_;
  std::vector<Marking> order_;
  std::uint32_t tested_ = 0;
};

}  // namespace onestroke

#pragma once

#include "render/frame_scene.h"
#include "render/screen_bounds.h"
#include "render/view.h"
#include "shaders/shared.h"

#include <span>
#include <vector>

namespace onestroke {

/// Turns labels, screen texts and lines into what the shaders draw. Keeps its memory from frame to frame.
class Overlay {
 public:
  /// Labels face the middle of the views, which has the first view's orientation and pixels.
  void build(const FrameScene& scene, std::span<const View> views);

  /// In drawing order: labels that models hide, then those on top, then screen texts.
  std::span<const gpu::QuadData> quads() const { return quads_; }
  /// How many of them, from the front, are tested against depth.
  std::uint32_t tested() const { return tested_; }
  std::span<const gpu::LineData> lines() const { return lines_; }
  /// Where what models may hide lies: lines and the labels that are tested.
  void add_to(ScreenBounds& bounds) const;

 private:
  struct Frame;
  void add_label(const Label& label, const Frame& frame);
  void add_hud(const HudText& text);
  void add_text(std::string_view text, const gpu::QuadData& plate, const Color& color, float em_width);

  std::vector<gpu::QuadData> quads_;
  std::vector<gpu::LineData> lines_;
  std::vector<std::pair<float, const Label*>> order_;
  std::uint32_t tested_ = 0;
};

}  // namespace onestroke

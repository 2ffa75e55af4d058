#pragma once

#include "core/pose.h"
#include "render/depth_surface.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

struct ImDrawData;

namespace onestroke {

/// Linear red, green, blue and opacity, not premultiplied.
struct Color {
  float r = 1, g = 1, b = 1, a = 1;

  friend bool operator==(const Color&, const Color&) = default;
};

/// Column-major 4 x 4, as glm::value_ptr gives it.
using Matrix4 = std::array<float, 16>;

inline constexpr Matrix4 identity_matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// A model in the renderer's keeping.
enum class ModelHandle : std::uint32_t {};

/// Graphics axes, metres; keeps the side where a x + b y + c z + d >= 0.
struct ClipPlane {
  float a = 0, b = 0, c = 0, d = 0;
};

struct ModelInstance {
  ModelHandle model{};
  /// Affine; from the model's axes to the world in graphics axes, metres (see scene/frames.h).
  Matrix4 world_graphics_from_model = identity_matrix;
  /// Factor on the base colour; its opacity lets the world behind show through, but not the model's own back.
  Color tint{};
  std::optional<ClipPlane> clip_plane{};
  /// Whether the faces that the plane cuts the model open with are shown filled, with a hatch: for closed models. They
  /// are as opaque as the tint.
  bool fill_cut = false;
  Color cut_color{0.87F, 0.7F, 0.08F, 1};
  /// Drawn to depth alone: hides what is behind it and shows the camera's picture instead.
  bool occluder = false;
};

/// Text in the world, parallel to the screen, on a rounded plate. UTF-8; '\n' starts a new line. Characters that the
/// font lacks show as a box. The text lives until draw() returns.
struct Label {
  std::string_view text{};
  Vec3 position_world{};  ///< Vision axes, mm.
  /// Font size (height of a line, near enough): in mm, or, where that is zero, in pixels of the view.
  double height_mm = 0, height_px = 18;
  /// Which point of the plate sits on the position: (0, 0) its top left corner, (1, 1) the bottom right.
  double pivot_x = 0.5, pivot_y = 0.5;
  Color color{1, 1, 1, 1};
  Color plate{0.01F, 0.012F, 0.016F, 0.78F};
  /// Shown even where a model stands in front of it.
  bool on_top = false;
};

/// A ring in the world, parallel to the screen, that fills clockwise from its top.
struct Gauge {
  Vec3 position_world{};  ///< Vision axes, mm.
  double radius_px = 14;  ///< Pixels of the view.
  double progress = 0;    ///< 0 to 1.
  Color color{1, 1, 1, 1};
  Color back{0.01F, 0.012F, 0.016F, 0.78F};  ///< Of the whole ring behind, which stands out a little.
  bool on_top = false;                       ///< As Label's.
};

/// A rectangle on the screen of every view, pixels from the viewport's top left corner. Its edges go to whole pixels,
/// so that boxes side by side leave no seam.
struct HudBox {
  double x = 0, y = 0, width = 0, height = 0;
  Color color{};
};

/// Text on the screen of every view. As Label, at pixels from the viewport's top left corner.
struct HudText {
  std::string_view text{};
  double x = 0, y = 0;
  double height_px = 18;
  double pivot_x = 0, pivot_y = 0;
  Color color{1, 1, 1, 1};
  Color plate{0.01F, 0.012F, 0.016F, 0.78F};
};

/// Where the screen's boxes and texts hang for eyes that wear the display: straight before the middle of the views,
/// parallel to the screen. Their pixels are those of the first view, from the plate's top left corner.
struct HudPlate {
  double distance = 1000;  ///< mm
  double width = 0, height = 0;
};

/// A straight line in the world, of constant width on the screen.
struct Line {
  Vec3 from_world{}, to_world{};  ///< Vision axes, mm.
  double width_px = 2;
  Color color{};
};

/// One key light over an even sky and ground, for what is drawn without a camera. Directions in vision axes (y down).
struct Light {
  Vec3 to_key_world{-0.45, -0.8, -0.55};
  Color key{2.2F, 2.15F, 2.05F, 1};
  Color sky{0.39F, 0.42F, 0.47F, 1};
  Color ground{0.15F, 0.14F, 0.13F, 1};

  friend bool operator==(const Light&, const Light&) = default;
};

/// Everything that one frame shows. Borrowed for the length of draw().
struct FrameScene {
  /// Distance of the surface that the camera's picture lies on, mm along the camera's axis, where no segment says
  /// otherwise. Without it, or before the first picture, the background is `background`.
  std::optional<double> passthrough_distance = 500;
  /// Best the markers' axes: there the picture and what stands on it do not slide on each other in either eye.
  std::span<const DepthSegment> passthrough_segments{};
  /// A share of the picture's light: less than 1 dims it.
  float picture_brightness = 1;
  /// A display that blends by itself wants no passthrough and a background of no light and no opacity: it gets
  /// premultiplied colour and its opacity (XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND), or takes the colour alone
  /// (ADDITIVE).
  Color background{0.006F, 0.007F, 0.009F, 1};
  std::span<const ModelInstance> instances{};
  std::span<const Line> lines{};
  std::span<const Label> labels{};
  std::span<const Gauge> gauges{};
  std::span<const HudBox> boxes{};  ///< Under the screen's texts.
  std::span<const HudText> hud{};
  std::optional<HudPlate> hud_plate{};  ///< None: on the screen of every view.
  /// Without one, models stand in the light that the camera's pictures show, or before the first in Light{}.
  std::optional<Light> light{};
  /// Fingers that cover a stick are in front of what stands behind them.
  bool fingers = true;
  /// Models get the noise of the camera's picture.
  bool grain = true;
  /// What Gui laid out, over all else; drawn where there is one view. None where it is null.
  const ImDrawData* gui = nullptr;
};

}  // namespace onestroke

#pragma once

#include "core/pose.h"

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

/// Text on the screen of every view. As Label, at pixels from the viewport's top left corner.
struct HudText {
  std::string_view text{};
  double x = 0, y = 0;
  double height_px = 18;
  double pivot_x = 0, pivot_y = 0;
  Color color{1, 1, 1, 1};
  Color plate{0.01F, 0.012F, 0.016F, 0.78F};
};

/// A straight line in the world, of constant width on the screen.
struct Line {
  Vec3 from_world{}, to_world{};  ///< Vision axes, mm.
  double width_px = 2;
  Color color{};
};

/// One key light over an even sky and ground. Directions in vision axes (y down).
struct Light {
  Vec3 to_key_world{-0.45, -0.8, -0.55};
  Color key{2.2F, 2.15F, 2.05F, 1};
  Color sky{0.39F, 0.42F, 0.47F, 1};
  Color ground{0.15F, 0.14F, 0.13F, 1};
};

/// Everything that one frame shows. Borrowed for the length of draw().
struct FrameScene {
  /// Distance of the surface that the camera's picture lies on, mm along the camera's axis; best that of the markers.
  /// Without it, or before the first picture, the background is `background`.
  std::optional<double> passthrough_distance = 500;
  Color background{0.006F, 0.007F, 0.009F, 1};
  std::span<const ModelInstance> instances{};
  std::span<const Line> lines{};
  std::span<const Label> labels{};
  std::span<const HudText> hud{};
  Light light{};
  /// What Gui laid out, over all else; drawn where there is one view. None where it is null.
  const ImDrawData* gui = nullptr;
};

}  // namespace onestroke

#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace onestroke {

/// What the synthetic camera's script shows.
enum class ScriptKind {
  hands,  ///< two sticks in two hands, 24 s, again and again
  turn_x,
  turn_y,
  turn_z,  ///< one stick that turns about an axis of the camera
  still,   ///< one stick that does not move
  side,    ///< here and below: two hands show one way of comparing two models, again and again
  link,
  mirror,
  overlay,
  section,
  measure,
  freeze,
  snapshot,
  card,
  menu,
};

/// The synthetic camera's settings, as written after "synthetic:".
struct SyntheticOptions {
  int width = 1280, height = 720;
  double fov_deg = 60;  ///< Horizontal.
  double fps = 30;
  double seconds = 0;  ///< 0: endless; a turn ends after 360 degrees unless this says otherwise.
  std::uint64_t seed = 1;
  int threads = 1;
  bool live = false;

  ScriptKind script = ScriptKind::hands;
  double distance = 450;                   ///< mm from the camera to the stick's middle, for the one-stick scripts.
  double step_deg = 6;                     ///< Turn between two pictures.
  std::optional<int> marker;               ///< Which stick the one-stick scripts show; the catalogue's first.
  std::optional<int> first_id, second_id;  ///< ids=a+b; the catalogue's first two.
  int fingers = 0;                         ///< A hand, 0 to 2.
  std::optional<bool> head;                ///< Whether the head moves; by itself it does in scripts of two hands.

  double right_mm = 0;  ///< How far to its right, along its own x axis, the camera is moved.

  double exposure_ms = 0;
  std::optional<double> readout_ms;
  double noise = 1.5;  ///< Levels of 255 at mid grey.
  double gain = 1;
  double light_kelvin = 6500;
  double blur = 0;  ///< px
};

/// Reads "key=value,key=value"; empty is all defaults. Throws UsageError that names a wrong key or value and lists what
/// is known.
SyntheticOptions parse_synthetic_options(const std::string& text);

}  // namespace onestroke

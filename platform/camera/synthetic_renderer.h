#pragma once

#include "camera/light.h"
#include "camera/pose_path.h"
#include "camera/rod.h"
#include "camera/room.h"
#include "core/picture.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace onestroke {

/// A marker in the picture. The rod must live as long as the frame is drawn.
struct SyntheticMarker {
  const Rod* rod = nullptr;
  PosePath T_camera_marker;
};

/// A finger: a skin-coloured capsule from its own origin (the tip's middle, nail towards -z) to length along +y, mm.
struct SyntheticFinger {
  PosePath T_camera_finger;
  double length = 60;
  double radius = 8;
  bool jointed = true;  ///< False for a palm with its wrist and sleeve.
};

/// What the camera does to the light. Everything but the pixels' averaging is off by default.
struct SyntheticEffects {
  Duration exposure;           ///< Motion is averaged over it.
  Duration readout;            ///< First row to last row, top first.
  double noise = 0;            ///< Standard deviation at mid grey (128), levels of 255; shot and read noise.
  double gain = 1;             ///< Brightness; below 1 the picture is under-exposed.
  double light_kelvin = 6500;  ///< Colour of the light; the white balance stays at 6500 K.
  double blur = 0;             ///< Defocus, standard deviation in pixels.
  int supersampling = 2;       ///< Samples a pixel along each axis, where there are markers and fingers; 1 to 4.
};

/// One picture to draw. Paths run over the picture's time span, exposure.length + readout.
struct SyntheticFrame {
  Intrinsics intrinsics;
  int width = 0, height = 0;
  PosePath T_world_camera;  ///< World axes as in light.h; the light and the room stand in it.
  std::vector<SyntheticMarker> markers;
  std::vector<SyntheticFinger> fingers;
  SyntheticEffects effects;
  const Room* room = nullptr;  ///< nullptr: an even background of the colour below.
  Linear background{0.30f, 0.30f, 0.30f};
  std::uint64_t noise_seed = 0;  ///< Give each picture its own.
};

/// Draws pictures of markers by casting rays on the CPU: the same frame gives the same bytes, whatever the threads.
/// One thread calls it; it allocates nothing once a frame of that size has been drawn.
class SyntheticRenderer {
 public:
  /// threads: how many share a picture's rows, this one included, 1 to 16.
  explicit SyntheticRenderer(int threads = 1);
  ~SyntheticRenderer();
  SyntheticRenderer(const SyntheticRenderer&) = delete;
  SyntheticRenderer& operator=(const SyntheticRenderer&) = delete;

  /// Fills rgb8 rows of stride bytes. cells_visible, where not empty, takes a count for each marker: the cells of which
  /// at least a quarter of the area that their pose lets expect is in the picture and unhidden. A cell foreshortened
  /// below a sixteenth of its full width is not expected to be seen at all.
  void render(const SyntheticFrame& frame, std::uint8_t* rgb, std::size_t stride, std::span<int> cells_visible = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A picture drawn once, for tests and tools: rgb8, rows of 3 * width bytes.
struct SyntheticImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<int> cells_visible;  ///< One count a marker of the frame.
};
SyntheticImage render_synthetic(const SyntheticFrame& frame);

}  // namespace onestroke

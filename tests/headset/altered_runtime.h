#pragma once

#include <openxr/openxr.h>

#include <cstdint>

// What the altered runtime tells a test, and does for it. See altered_runtime.cpp.
extern "C" {

struct AlteredFrame {
  XrEnvironmentBlendMode blend_mode;
  std::uint32_t layers;
  XrBool32 passthrough_first;
  XrCompositionLayerFlags projection_flags;
  int views_with_depth;
  float near_z, far_z;  // of the last of these
};
/// The last frame that had layers.
AlteredFrame altered_runtime_last_frame();
/// Of XR_FB_passthrough: made and not destroyed.
int altered_runtime_passthrough_objects();
/// The wearer turns LOCAL by 0.7 rad and moves it by half a metre, from 100 ms after the next frame's time on.
void altered_runtime_recentre();
/// The wearer ends the program in the runtime's menu.
void altered_runtime_ask_to_leave();
}

// The surface that the camera's picture lies on.
#include "frame.glsl"

// 1 / z of the surface at the corners of its grid, rows from the top; 1 / metres.
layout(set = 0, binding = BINDING_SURFACE, std430) readonly buffer Surface { float inverse_depths[]; };

// Camera frame, vision axes, metres.
vec3 surface_position(int column, int row) {
  float z = 1.0 / inverse_depths[row * (int(scene.surface_grid.x) + 1) + column];
  return vec3((scene.surface.xy + vec2(column, row) * scene.surface.zw) * z, z);
}

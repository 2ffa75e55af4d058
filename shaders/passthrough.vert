#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

// 1 / z of the surface at the corners of its grid, rows from the top; 1 / metres.
layout(set = 0, binding = BINDING_SURFACE, std430) readonly buffer Surface { float inverse_depths[]; };

layout(location = 0) out vec3 position;

// One strip of triangles, an instance, for every row of cells.
void main() {
  int column = gl_VertexIndex >> 1, row = gl_InstanceIndex + (gl_VertexIndex & 1);
  float z = 1.0 / inverse_depths[row * (int(scene.surface_grid.x) + 1) + column];
  vec2 n = scene.surface.xy + vec2(column, row) * scene.surface.zw;
  position = vec3(n * z, z);
  gl_Position = view.clip_from_camera * vec4(position, 1.0);
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

layout(location = 0) out vec3 position;

// One strip of triangles, an instance, for every row of cells.
void main() {
  position = surface_position(gl_VertexIndex >> 1, gl_InstanceIndex + (gl_VertexIndex & 1));
  gl_Position = view.clip_from_camera * vec4(position, 1.0);
}

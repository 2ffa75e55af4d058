#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.glsl"

layout(push_constant) uniform Push { DrawData draw; };

layout(location = 0) out vec3 position;

// The surface as the passthrough shows it, so that both pictures lie on each other, but as deep as the finger.
void main() {
  position = surface_position(gl_VertexIndex >> 1, gl_InstanceIndex + (gl_VertexIndex & 1));
  gl_Position = view.clip_from_camera * vec4(position, 1.0);
  vec4 there = view.clip_from_camera * vec4(position * (draw.finger.x / position.z), 1.0);
  gl_Position.z = there.z / max(there.w, 1e-4) * gl_Position.w;
  // The other eye's picture has fingers of its own.
  if (draw.finger.y != view.picture.x) gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
}

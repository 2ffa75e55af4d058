#version 460
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(location = 0) out float out_across_lines;

void main() {
  vec2 at = (vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0) * cut.centre.w;
  vec3 world = cut.centre.xyz + at.x * cut.across.xyz + at.y * cross(cut.plane.xyz, cut.across.xyz);
  out_across_lines = dot(cut.hatch, vec4(world, 1.0));
  // From the side that is kept the face is behind the model, where it is not seen.
  bool seen = dot(cut.plane, vec4(view.eye.xyz, 1.0)) < 0.0;
  gl_Position = seen ? view.clip_from_world * vec4(world, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}

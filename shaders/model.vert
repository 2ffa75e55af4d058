#version 460
#extension GL_GOOGLE_include_directive : require
#include "model.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec2 out_uv;
layout(location = 4) out vec4 out_color;

// Depth-only and colour passes must agree to the bit.
invariant gl_Position;

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 world = vec3(dot(draw.model_rows[0], p), dot(draw.model_rows[1], p), dot(draw.model_rows[2], p));
  vec3 a = draw.model_rows[0].xyz, b = draw.model_rows[1].xyz, c = draw.model_rows[2].xyz;
  // The cofactor matrix carries normals right under any scale; its sign does so under a mirroring.
  out_normal = vec3(dot(cross(b, c), normal), dot(cross(c, a), normal), dot(cross(a, b), normal));
  out_normal *= dot(a, cross(b, c)) < 0.0 ? -1.0 : 1.0;
  out_tangent = vec4(dot(a, tangent.xyz), dot(b, tangent.xyz), dot(c, tangent.xyz), tangent.w);
  out_position = world;
  out_uv = uv;
  out_color = color;
  gl_Position = view.clip_from_world * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(draw.clip_plane, vec4(world, 1.0));
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec4 origin;
layout(location = 1) in vec4 edge_x;
layout(location = 2) in vec4 edge_y;
layout(location = 3) in vec4 uv;
layout(location = 4) in vec4 color;
layout(location = 5) in vec4 shape;

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec4 out_uv;
layout(location = 2) flat out vec4 out_color;
layout(location = 3) flat out float out_kind;

vec4 clip_at(vec2 corner) {
  vec3 p = origin.xyz + corner.x * edge_x.xyz + corner.y * edge_y.xyz;
  if (origin.w > 0.5) return vec4(p.xy / view.viewport.zw * 2.0 - 1.0, 1.0, 1.0);
  return view.clip_from_world * vec4(p, 1.0);
}

vec2 pixel_at(vec2 corner) {
  vec4 clip = clip_at(corner);
  return clip.xy / clip.w * view.viewport.zw * 0.5;
}

void main() {
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
  bool glyph = shape.x == QUAD_GLYPH;
  if (!glyph) {
    // A pixel more on every side, in which the edge of a plate or a ring fades.
    vec2 first = pixel_at(vec2(0.0));
    vec2 size = vec2(distance(first, pixel_at(vec2(1.0, 0.0))), distance(first, pixel_at(vec2(0.0, 1.0))));
    corner += (2.0 * corner - 1.0) / max(size, 1.0);
  }
  gl_Position = clip_at(corner);
  out_at = glyph ? mix(uv.xy, uv.zw, corner) : (corner - 0.5) * uv.xy;
  out_uv = uv;
  out_color = color;
  out_kind = shape.x;
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec4 from;
layout(location = 1) in vec4 to;
layout(location = 2) in vec4 color;

layout(location = 0) noperspective out float out_across;
layout(location = 1) flat out float out_half_width;
layout(location = 2) flat out vec4 out_color;

// Clip w is the depth in metres: ends nearer than this are cut off, so that the divide below is safe.
const float nearest = 0.01;

void main() {
  vec4 a = view.clip_from_world * vec4(from.xyz, 1.0), b = view.clip_from_world * vec4(to.xyz, 1.0);
  out_across = 0.0;
  out_half_width = 0.0;
  out_color = color;
  if (a.w < nearest && b.w < nearest) {
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));

  vec2 pixels = view.viewport.zw * 0.5;
  vec2 along = b.xy / b.w * pixels - a.xy / a.w * pixels;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  float half_width = from.w * 0.5, reach = half_width + 1.0;
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  vec4 end = gl_VertexIndex < 2 ? a : b;
  end.xy += vec2(-along.y, along.x) * side * reach / pixels * end.w;
  out_across = side * reach;
  out_half_width = half_width;
  gl_Position = end;
}

#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.h"

// Camera bytes to RGB, a fragment for each pixel. Four bytes in a row are a texel; the rows of a second plane follow
// those of the first.
layout(set = 0, binding = 0) uniform texture2D words;
layout(push_constant) uniform Push { UnpackData data; };
layout(constant_id = 0) const uint format = UNPACK_RGB8;

layout(location = 0) out vec4 color;

// ITU-R BT.601, limited range: what cameras send where they say nothing else.
vec3 rgb_from_yuv(float y, vec2 uv) {
  float l = 1.16438 * (y - 16.0 / 255.0);
  vec2 c = uv - 128.0 / 255.0;
  return clamp(vec3(l + 1.59603 * c.y, l - 0.39176 * c.x - 0.81297 * c.y, l + 2.01723 * c.x), 0.0, 1.0);
}

float byte_of(vec4 word, int i) { return i < 2 ? (i == 0 ? word.x : word.y) : (i == 2 ? word.z : word.w); }

vec3 rgb8(ivec2 at) {
  int first = 3 * at.x, word = first >> 2, shift = first & 3;
  // The last pixel of four ends with its word; what it would read beyond is not looked at.
  vec4 a = texelFetch(words, ivec2(word, at.y), 0), b = texelFetch(words, ivec2(word + int(shift > 1), at.y), 0);
  return shift < 2 ? (shift == 0 ? a.xyz : a.yzw) : (shift == 2 ? vec3(a.zw, b.x) : vec3(a.w, b.xy));
}

vec3 nv12(ivec2 at) {
  vec4 l = texelFetch(words, ivec2(at.x >> 2, at.y), 0);
  vec4 c = texelFetch(words, ivec2(at.x >> 2, int(data.size.x) + (at.y >> 1)), 0);
  return rgb_from_yuv(byte_of(l, at.x & 3), (at.x & 2) == 0 ? c.xy : c.zw);
}

vec3 yuyv(ivec2 at) {
  vec4 pair = texelFetch(words, ivec2(at.x >> 1, at.y), 0);
  return rgb_from_yuv((at.x & 1) == 0 ? pair.x : pair.z, pair.yw);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 rgb;
  if (format == UNPACK_RGB8)
    rgb = rgb8(at);
  else if (format == UNPACK_GRAY8)
    rgb = vec3(byte_of(texelFetch(words, ivec2(at.x >> 2, at.y), 0), at.x & 3));
  else if (format == UNPACK_NV12)
    rgb = nv12(at);
  else
    rgb = yuyv(at);
  color = vec4(rgb, 1.0);
}

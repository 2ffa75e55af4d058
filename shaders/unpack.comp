#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

// Camera bytes to RGBA. An invocation makes four pixels in a row, because four pixels are whole words in every format.
layout(local_size_x = 16, local_size_y = 8) in;

layout(set = 0, binding = 0, std430) readonly buffer Bytes { uint words[]; };
layout(set = 0, binding = 1, rgba8) writeonly uniform image2D picture;
layout(push_constant) uniform Push { UnpackData data; };

vec4 bytes(uint word) { return unpackUnorm4x8(word); }

// ITU-R BT.601, limited range: what cameras send where they say nothing else.
vec3 rgb_from_yuv(float y, vec2 uv) {
  float l = 1.16438 * (y - 16.0 / 255.0);
  vec2 c = uv - 128.0 / 255.0;
  return clamp(vec3(l + 1.59603 * c.y, l - 0.39176 * c.x - 0.81297 * c.y, l + 2.01723 * c.x), 0.0, 1.0);
}

void main() {
  uint width = data.size.x, x = gl_GlobalInvocationID.x * 4, y = gl_GlobalInvocationID.y;
  if (x >= width || y >= data.size.y) return;
  uint row = y * data.layout_.x;
  vec3 rgb[4];
  if (data.size.z == UNPACK_RGB8) {
    uint at = row + gl_GlobalInvocationID.x * 3;
    vec4 a = bytes(words[at]), b = bytes(words[at + 1]), c = bytes(words[at + 2]);
    rgb = vec3[](a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
  } else if (data.size.z == UNPACK_GRAY8) {
    vec4 g = bytes(words[row + gl_GlobalInvocationID.x]);
    rgb = vec3[](g.xxx, g.yyy, g.zzz, g.www);
  } else if (data.size.z == UNPACK_NV12) {
    vec4 l = bytes(words[row + gl_GlobalInvocationID.x]);
    vec4 c = bytes(words[data.layout_.y + (y / 2) * data.layout_.z + gl_GlobalInvocationID.x]);
    rgb = vec3[](rgb_from_yuv(l.x, c.xy), rgb_from_yuv(l.y, c.xy), rgb_from_yuv(l.z, c.zw), rgb_from_yuv(l.w, c.zw));
  } else {
    uint at = row + gl_GlobalInvocationID.x * 2;
    vec4 a = bytes(words[at]), b = bytes(words[at + 1]);
    rgb = vec3[](rgb_from_yuv(a.x, a.yw), rgb_from_yuv(a.z, a.yw), rgb_from_yuv(b.x, b.yw), rgb_from_yuv(b.z, b.yw));
  }
  for (uint i = 0; i < 4 && x + i < width; ++i) imageStore(picture, ivec2(x + i, y), vec4(rgb[i], 1.0));
}

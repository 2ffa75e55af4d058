#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_GLYPHS) uniform sampler2D glyphs;

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 uv;
layout(location = 2) flat in vec4 quad_color;
layout(location = 3) flat in float kind;

layout(location = 0) out vec4 color;

// How far the place is from the ring, radii; less than 0 within. uv: see QuadData.
float outside_ring() {
  float ring = abs(length(at) - 1.0 + 0.5 * uv.z) - 0.5 * uv.z;
  if (uv.w >= 1.0) return ring;
  // Clockwise from the line to the top, and back from the line to the ring's end.
  float end = uv.w * 6.28318531, past_start = -at.x, past_end = dot(at, vec2(cos(end), sin(end)));
  return max(ring, uv.w <= 0.5 ? max(past_start, past_end) : min(past_start, past_end));
}

void main() {
  // Derivatives and texture reads stand outside the branch, where they are defined.
  vec2 width = fwidth(at);
  float signed_distance = textureLod(glyphs, at, 0.0).r - 0.5;
  float coverage;
  if (kind == QUAD_GLYPH) {
    // The atlas holds distances: 255 levels are twice its spread in texels.
    float texels = max(width.x, width.y) * float(textureSize(glyphs, 0).x);
    float pixels = signed_distance * 2.0 * ATLAS_SPREAD / max(texels, 1e-6);
    coverage = clamp(pixels + 0.5, 0.0, 1.0);
  } else if (kind == QUAD_RING) {
    coverage = clamp(0.5 - outside_ring() / max(max(width.x, width.y), 1e-6), 0.0, 1.0);
  } else {
    vec2 q = abs(at) - 0.5 * uv.xy + uv.z;
    float outside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - uv.z;
    coverage = clamp(0.5 - outside / max(max(width.x, width.y), 1e-6), 0.0, 1.0);
  }
  float alpha = quad_color.a * coverage;
  color = vec4(quad_color.rgb * alpha, alpha);
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_GLYPHS) uniform sampler2D glyphs;

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 uv;
layout(location = 2) flat in vec4 quad_color;
layout(location = 3) flat in float kind;

layout(location = 0) out vec4 color;

void main() {
  // Derivatives and texture reads stand outside the branch, where they are defined.
  vec2 width = fwidth(at);
  float signed_distance = textureLod(glyphs, at, 0.0).r - 0.5;
  float coverage;
  if (kind > 0.5) {
    // The atlas holds distances: 255 levels are twice its spread in texels.
    float texels = max(width.x, width.y) * float(textureSize(glyphs, 0).x);
    float pixels = signed_distance * 2.0 * ATLAS_SPREAD / max(texels, 1e-6);
    coverage = clamp(pixels + 0.5, 0.0, 1.0);
  } else {
    vec2 q = abs(at) - 0.5 * uv.xy + uv.z;
    float outside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - uv.z;
    coverage = clamp(0.5 - outside / max(max(width.x, width.y), 1e-6), 0.0, 1.0);
  }
  float alpha = quad_color.a * coverage;
  color = vec4(quad_color.rgb * alpha, alpha);
}

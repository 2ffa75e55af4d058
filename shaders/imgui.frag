#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = 0) uniform sampler2D glyphs;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 quad_color;

layout(location = 0) out vec4 color;

void main() {
  // The atlas holds distances: 255 levels are twice its spread in texels. What has no texture looks up one texel deep
  // inside a glyph, which covers everything.
  vec2 width = fwidth(uv) * vec2(textureSize(glyphs, 0));
  float texels = max(max(width.x, width.y), 1e-6);
  float pixels = (textureLod(glyphs, uv, 0.0).r - 0.5) * 2.0 * ATLAS_SPREAD / texels;
  float alpha = quad_color.a * clamp(pixels + 0.5, 0.0, 1.0);
  color = vec4(quad_color.rgb * alpha, alpha);
}

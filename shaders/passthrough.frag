#version 460
#extension GL_GOOGLE_include_directive : require
#include "picture.glsl"

// Off where there is nothing but picture.
layout(constant_id = CONSTANT_EDGE) const bool edge = true;

layout(location = 0) in vec3 position;

layout(location = 0) out vec4 color;

// Round the picture its edge glows on dimly, so that it does not end like a cut. Widths in picture heights.
const vec3 surround = vec3(SURROUND_R, SURROUND_G, SURROUND_B);
const float glow = 0.07, border_width = 0.006, glow_width = 0.1;

void main() {
  vec2 uv = picture_at(position);
  vec3 seen = picture_color(uv) * its_picture.shape.w;
  if (edge) {
    vec2 outside = max(abs(uv - 0.5) - 0.5, 0.0) * vec2(its_picture.shape.x, 1.0);
    float far = length(outside);
    float share = mix(1.0, glow, smoothstep(0.0, border_width, far)) * (1.0 - smoothstep(0.0, glow_width, far));
    seen = mix(surround, seen, share);
  }
  color = vec4(seen, 1.0);
}

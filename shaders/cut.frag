#version 460
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "light.glsl"

layout(location = 0) in float across_lines;

layout(location = 0) out vec4 color;

// Of the hatch, metres; how bright its lines are beside what lies between.
const float period = 0.003, line_width = 0.0008, line_brightness = 0.3;

// The integral of the lines' coverage from 0 to x periods.
float covered_to(float x) {
  const float share = line_width / period;
  return floor(x) * share + min(fract(x), share);
}

// How much of a pixel at x, so many periods wide, lies on lines.
float line_share(float x, float width) { return (covered_to(x + 0.5 * width) - covered_to(x - 0.5 * width)) / width; }

void main() {
  float x = across_lines / period;
  float hatch = line_share(x, max(fwidth(x), 1e-4));
  // Towards the eye, which is where the model was cut away.
  vec3 n = -normalize(cut.plane.xyz);
  vec3 light = matt(n) + max(dot(n, scene.key_direction.xyz), 0.0) / pi * scene.key_color.rgb;
  vec3 lit = cut.color.rgb * mix(1.0, line_brightness, hatch) * light;
  color = vec4(as_seen(lit) * cut.color.a, cut.color.a);
}

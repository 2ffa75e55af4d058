#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_VIEW, std140) uniform View { ViewData view; };
layout(set = 0, binding = BINDING_PICTURE) uniform sampler2D picture;

layout(location = 0) out vec4 color;

const vec3 surround = vec3(0.006, 0.007, 0.009);
// Round the picture its edge glows on dimly, so that it does not end like a cut. Widths in picture heights.
const float glow = 0.07, border_width = 0.006, glow_width = 0.1;

// OpenCV's model; the caller has checked that r2 lies where it is monotonic.
vec2 distort(vec2 n, float r2) {
  vec4 d = view.distortion;
  float radial = 1.0 + r2 * (d.x + r2 * (d.y + r2 * view.distortion_more.x));
  return n * radial + vec2(2.0 * d.z * n.x * n.y + d.w * (r2 + 2.0 * n.x * n.x),
                           d.z * (r2 + 2.0 * n.y * n.y) + 2.0 * d.w * n.x * n.y);
}

void main() {
  vec3 ray = vec3((gl_FragCoord.xy - view.viewport.xy) * view.ray.xy + view.ray.zw, 1.0);
  vec3 q = vec3(dot(view.picture_rows[0].xyz, ray), dot(view.picture_rows[1].xyz, ray),
                dot(view.picture_rows[2].xyz, ray));
  color = vec4(surround, 1.0);
  if (q.z <= 0.0) return;
  vec2 n = q.xy / q.z;
  float r2 = dot(n, n);
  if (r2 > view.distortion_more.y) return;
  vec2 uv = distort(n, r2) * view.picture_intrinsic.xy + view.picture_intrinsic.zw;
  vec2 outside = max(abs(uv - 0.5) - 0.5, 0.0) * vec2(view.distortion_more.z, 1.0);
  float far = length(outside);
  float share = mix(1.0, glow, smoothstep(0.0, border_width, far)) * (1.0 - smoothstep(0.0, glow_width, far));
  color.rgb = mix(surround, textureLod(picture, uv, 0.0).rgb, share);
}

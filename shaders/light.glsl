// The light that things stand in, and how the camera would show what they give back.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

const float pi = 3.14159265;

// What a white matt surface gives back of the room's light.
vec3 matt(vec3 n) {
  vec3 sum = scene.matt[0].rgb + scene.matt[1].rgb * n.y + scene.matt[2].rgb * n.z + scene.matt[3].rgb * n.x +
             scene.matt[4].rgb * (n.x * n.y) + scene.matt[5].rgb * (n.y * n.z) +
             scene.matt[6].rgb * (3.0 * n.z * n.z - 1.0) + scene.matt[7].rgb * (n.x * n.z) +
             scene.matt[8].rgb * (n.x * n.x - n.y * n.y);
  return max(sum, 0.0);
}

// Keeps highlights from clipping: the identity up to 0.7, then towards 1.
vec3 shoulder(vec3 c) {
  vec3 over = max(c - 0.7, 0.0);
  return min(c, 0.7) + 0.3 * (1.0 - exp(-over / 0.3));
}

// PCG, by Jarzynski and Olano 2020: three even numbers from three.
uvec3 pcg(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v += v.yzx * v.zxy;
  v ^= v >> 16u;
  return v + v.yzx * v.zxy;
}

// The camera's noise, as large as its pixels; a sum of evenly spread numbers is nearly normal. Cameras code light to the
// power of 1 / 2.2, so what is even in code is more light where there is more.
vec3 with_grain(vec3 c) {
  uvec3 a = pcg(uvec3(uvec2(gl_FragCoord.xy * scene.grain.x), uint(scene.grain.y)));
  vec3 low = vec3(a & 0xffffu), high = vec3(a >> 16u);
  vec3 noise = (low + high - 65535.0) / 26755.0;
  return max(c + scene.tone.w * noise * 2.2 * pow(max(c, 0.002), vec3(0.5455)), 0.0);
}

vec3 as_seen(vec3 lit) {
  // The camera shows no black that is darker than its own.
  vec3 shown = scene.tone.rgb + shoulder(lit) * (1.0 - scene.tone.rgb);
  return scene.tone.w > 0.0 ? with_grain(shown) : shown;
}

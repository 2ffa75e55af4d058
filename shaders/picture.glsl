// The camera's picture that the view sees, looked up by points of its camera's frame.
#include "frame.glsl"

layout(set = 0, binding = BINDING_PICTURE) uniform sampler2D pictures[MOST_PICTURES];
// By how much the lens shifts what an ideal one would show: texture coordinates of the picture.
layout(set = 0, binding = BINDING_LENS) uniform sampler2D lens_shifts[MOST_PICTURES];

// Off where the lens is known to be ideal: looking up no shift costs as much as looking up one.
layout(constant_id = CONSTANT_LENS) const bool lens = true;

// Not every GPU can choose a texture by a number that it computes.
vec4 look_up(sampler2D first, sampler2D second, vec2 uv) {
  return view.picture.x < 0.5 ? textureLod(first, uv, 0.0) : textureLod(second, uv, 0.0);
}

// Texture coordinates of the picture where it shows a point (vision axes, any unit) in front of its camera.
vec2 picture_at(vec3 point) {
  vec2 n = point.xy / point.z;
  vec2 uv = n * its_picture.intrinsic.xy + its_picture.intrinsic.zw;
  if (lens && its_picture.lens_map.x > 0.0)
    uv += look_up(lens_shifts[0], lens_shifts[1], n * its_picture.lens_map.xy + its_picture.lens_map.zw).xy;
  return uv;
}

vec3 picture_color(vec2 uv) { return look_up(pictures[0], pictures[1], uv).rgb; }

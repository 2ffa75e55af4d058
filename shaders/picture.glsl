// The camera's picture, looked up by points of its camera's frame.
#include "frame.glsl"

layout(set = 0, binding = BINDING_PICTURE) uniform sampler2D picture;
// By how much the lens shifts what an ideal one would show: texture coordinates of the picture.
layout(set = 0, binding = BINDING_LENS) uniform sampler2D lens_shifts;

// Off where the lens is known to be ideal: looking up no shift costs as much as looking up one.
layout(constant_id = CONSTANT_LENS) const bool lens = true;

// Texture coordinates of the picture where it shows a point (vision axes, any unit) in front of its camera.
vec2 picture_at(vec3 point) {
  vec2 n = point.xy / point.z;
  vec2 uv = n * scene.picture_intrinsic.xy + scene.picture_intrinsic.zw;
  if (lens && scene.lens_map.x > 0.0) uv += textureLod(lens_shifts, n * scene.lens_map.xy + scene.lens_map.zw, 0.0).xy;
  return uv;
}

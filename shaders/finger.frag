#version 460
#extension GL_GOOGLE_include_directive : require
#include "picture.glsl"

layout(set = 0, binding = BINDING_FINGERS) uniform sampler2D fingers;

layout(location = 0) in vec3 position;

layout(location = 0) out vec4 color;

void main() {
  vec2 uv = picture_at(position);
  float alpha = smoothstep(0.3, 0.7, textureLod(fingers, uv * scene.picture_shape.yz, 0.0).r);
  if (alpha <= 0.0) discard;
  color = vec4(textureLod(picture, uv, 0.0).rgb * alpha, alpha);
}

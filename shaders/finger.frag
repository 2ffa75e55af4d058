#version 460
#extension GL_GOOGLE_include_directive : require
#include "picture.glsl"

layout(set = 0, binding = BINDING_FINGERS) uniform sampler2D fingers[MOST_PICTURES];

layout(location = 0) in vec3 position;

layout(location = 0) out vec4 color;

void main() {
  vec2 uv = picture_at(position);
  float alpha = smoothstep(0.3, 0.7, look_up(fingers[0], fingers[1], uv * its_picture.shape.yz).r);
  if (alpha <= 0.0) discard;
  color = vec4(picture_color(uv) * alpha, alpha);
}

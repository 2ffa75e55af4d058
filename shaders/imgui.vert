#version 460

layout(push_constant) uniform Push {
  vec2 scale;  // from pixels to clip space
  vec2 shift;
} push;

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;

layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

vec3 linear(vec3 srgb) {
  return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

void main() {
  out_uv = uv;
  out_color = vec4(linear(color.rgb), color.a);
  gl_Position = vec4(position * push.scale + push.shift, 1.0, 1.0);
}

#version 460
#extension GL_GOOGLE_include_directive : require
#include "model.glsl"
#include "light.glsl"

layout(set = 1, binding = BINDING_MATERIAL, std140) uniform Material { MaterialData material; };
layout(set = 1, binding = BINDING_BASE_COLOR) uniform sampler2D base_color_texture;
layout(set = 1, binding = BINDING_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = BINDING_NORMAL) uniform sampler2D normal_texture;
layout(set = 1, binding = BINDING_OCCLUSION) uniform sampler2D occlusion_texture;
layout(set = 1, binding = BINDING_EMISSIVE) uniform sampler2D emissive_texture;

layout(set = 0, binding = BINDING_ROOM) uniform samplerCube room;

// Off where the material has neither textures nor an alpha test: looking up white costs as much as looking up a texture.
layout(constant_id = CONSTANT_TEXTURED) const bool textured = true;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 vertex_color;

layout(location = 0) out vec4 color;

vec3 surface_normal() {
  vec3 n = normalize(normal);
  if (textured && material.flags.x > 0.5 && dot(tangent.xyz, tangent.xyz) > 1e-12) {
    vec3 t = normalize(tangent.xyz - n * dot(n, tangent.xyz));
    vec3 m = texture(normal_texture, uv).xyz * 2.0 - 1.0;
    m.xy *= material.factors.z;
    n = normalize(mat3(t, cross(n, t) * tangent.w, n) * m);
  }
  return gl_FrontFacing ? n : -n;
}

// Karis's fit of the split-sum table: the share of surrounding light that a rough surface mirrors.
vec3 environment_share(vec3 f0, float roughness, float n_v) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a + r.zw;
  return f0 * ab.x + ab.y;
}

vec3 key_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness) {
  vec3 l = scene.key_direction.xyz, h = normalize(l + v);
  float n_l = clamp(dot(n, l), 0.0, 1.0), n_v = clamp(dot(n, v), 1e-3, 1.0), n_h = clamp(dot(n, h), 0.0, 1.0);
  float a = roughness * roughness, a2 = a * a;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float distribution = a2 / (pi * d * d);
  float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2) + 1e-5);
  vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
  return (diffuse * (1.0 - fresnel) / pi + distribution * visibility * fresnel) * n_l * scene.key_color.rgb;
}

// What another model that is near leaves of the room's light (x) and of the key's (y). A ball of radius r at distance d
// covers (r / d)^2 of the cosine-weighted sky round its direction (Quilez); a lamp's shadow has a soft edge.
vec2 left_by_others(vec3 n) {
  vec2 left = vec2(1.0);
  for (int i = int(draw.shadow.x); i < int(draw.shadow.y); ++i) {
    vec4 ball = scene.balls[i];
    vec3 to = ball.xyz - position;
    float d2 = max(dot(to, to), 1e-8), r2 = ball.w * ball.w;
    left.x *= 1.0 - clamp(dot(n, to) * inversesqrt(d2), 0.0, 1.0) * min(r2 / d2, 1.0);
    float ahead = dot(to, scene.key_direction.xyz);
    float aside = sqrt(max(d2 - ahead * ahead, 0.0));
    if (ahead > 0.0) left.y *= smoothstep(0.5 * ball.w, 1.5 * ball.w, aside);
  }
  return left;
}

void main() {
  vec4 base = material.base_color * vertex_color;
  if (textured) base *= texture(base_color_texture, uv);
  if (textured && base.a < material.emissive.a) discard;
  base.rgb *= draw.tint.rgb;
  vec2 metallic_roughness = material.factors.xy;
  if (textured) metallic_roughness *= texture(metallic_roughness_texture, uv).bg;
  float metallic = metallic_roughness.x, roughness = clamp(metallic_roughness.y, 0.06, 1.0);
  float occlusion = textured ? 1.0 + material.factors.w * (texture(occlusion_texture, uv).r - 1.0) : 1.0;

  vec3 n = surface_normal(), v = normalize(view.eye.xyz - position);
  vec3 diffuse = base.rgb * (1.0 - metallic), f0 = mix(vec3(0.04), base.rgb, metallic);
  vec3 mirrored = textureLod(room, reflect(-v, n), roughness * ROOM_LAST_LEVEL).rgb;
  vec3 ambient = diffuse * matt(n) + environment_share(f0, roughness, clamp(dot(n, v), 0.0, 1.0)) * mirrored;
  vec2 left = left_by_others(n);
  vec3 lit = ambient * occlusion * left.x + key_light(n, v, diffuse, f0, roughness) * left.y +
             (textured ? texture(emissive_texture, uv).rgb : vec3(1.0)) * material.emissive.rgb;
  // Only a blended material lets its own alpha through.
  float alpha = (material.flags.y > 0.5 ? base.a : 1.0) * draw.tint.a;
  color = vec4(as_seen(lit) * alpha, alpha);
}

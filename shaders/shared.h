// What C++ and GLSL both lay out. Every member is a vec4 or a mat4, so std140 and C++ agree without padding; the
// asserts at the end hold them to it. World: graphics axes (x right, y up, z backward), metres.
#ifndef ONESTROKE_SHADERS_SHARED_H
#define ONESTROKE_SHADERS_SHARED_H

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace onestroke::gpu {
using glm::mat4;
using glm::uvec4;
using glm::vec4;
#endif

// Bindings of set 0 (a frame) and set 1 (a material).
#define BINDING_VIEW 0
#define BINDING_PICTURE 1
#define BINDING_GLYPHS 2
#define BINDING_MATERIAL 0
#define BINDING_BASE_COLOR 1
#define BINDING_METALLIC_ROUGHNESS 2
#define BINDING_NORMAL 3
#define BINDING_OCCLUSION 4
#define BINDING_EMISSIVE 5

// Reach of the glyph atlas's distance field either side of an outline, texels.
#define ATLAS_SPREAD 6.0

// QuadData.shape.x
#define QUAD_PLATE 0
#define QUAD_GLYPH 1

// UnpackData.size.z
#define UNPACK_RGB8 0
#define UNPACK_GRAY8 1
#define UNPACK_NV12 2
#define UNPACK_YUYV 3

// One view of one frame.
struct ViewData {
  mat4 clip_from_world;
  vec4 eye;       // xyz: the view's origin
  vec4 viewport;  // x, y, width, height: pixels of the target
  // Passthrough, in vision axes. Pixel p of the viewport looks along (p * ray.xy + ray.zw, 1).
  vec4 ray;
  vec4 picture_rows[3];    // xyz: rows of the homography from that ray to the camera's (x, y, 1), up to scale
  vec4 picture_intrinsic;  // fx, fy, cx, cy over the picture's size
  vec4 distortion;         // k1, k2, p1, p2
  vec4 distortion_more;    // k3, largest r^2 at which the model still holds, width / height, 0
  vec4 key_direction;      // xyz: to the light, unit
  vec4 key_color;
  vec4 sky_color;
  vec4 ground_color;
};

// A part of a model being drawn: push constants.
struct DrawData {
  vec4 model_rows[3];  // affine world_from_model
  vec4 tint;           // rgb factor on the base colour, a opacity
  vec4 clip_plane;     // kept where dot(plane.xyz, p) + plane.w >= 0, in the world; all zero keeps everything
};

struct MaterialData {
  vec4 base_color;
  vec4 emissive;  // rgb, alpha cutoff (negative: no test)
  vec4 factors;   // metallic, roughness, normal scale, occlusion strength
  vec4 flags;     // x: 1 has a normal texture; y: 1 blends by its own alpha
};

// A rectangle of text or of its backing plate.
struct QuadData {
  vec4 origin;  // xyz: top left corner; w: 0 in the world, 1 on screen (pixels of the viewport, y down)
  vec4 edge_x;  // xyz: along the top
  vec4 edge_y;  // xyz: down the left side
  vec4 uv;      // glyph: u0, v0, u1, v1; plate: width, height, corner radius, 0 in one unit
  vec4 color;   // linear, not premultiplied
  vec4 shape;   // x: QUAD_PLATE or QUAD_GLYPH
};

struct LineData {
  vec4 from;   // xyz world; w: width, pixels
  vec4 to;     // xyz world
  vec4 color;  // linear, not premultiplied
};

// Unpacking a camera picture: push constants. Rows start on a word of four bytes.
struct UnpackData {
  uvec4 size;     // width, height, UNPACK_*, 0
  uvec4 layout_;  // words a row of plane 0, first word of plane 1, words a row of plane 1, 0
};

#ifdef __cplusplus
static_assert(offsetof(ViewData, eye) == 64 && offsetof(ViewData, picture_rows) == 112);
static_assert(offsetof(ViewData, picture_intrinsic) == 160 && sizeof(ViewData) == 272);
static_assert(sizeof(DrawData) == 80 && sizeof(MaterialData) == 64 && sizeof(QuadData) == 96 && sizeof(LineData) == 48);
static_assert(sizeof(UnpackData) == 32);
}  // namespace onestroke::gpu
#endif

#endif

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
#define BINDING_VIEWS 0
#define BINDING_SCENE 1
#define BINDING_SURFACE 2
#define BINDING_PICTURE 3
#define BINDING_GLYPHS 4
#define BINDING_LENS 5
#define BINDING_ROOM 6
#define BINDING_FINGERS 7
#define BINDING_FOREGROUND 8
#define BINDING_DEPTH 9
#define BINDING_MATERIAL 0
#define BINDING_BASE_COLOR 1
#define BINDING_METALLIC_ROUGHNESS 2
#define BINDING_NORMAL 3
#define BINDING_OCCLUSION 4
#define BINDING_EMISSIVE 5

// Specialisation constants.
#define CONSTANT_LENS 0
#define CONSTANT_EDGE 1
#define CONSTANT_TEXTURED 0

// Pictures of the camera, or of the left eye's and the right eye's.
#define MOST_PICTURES 2

// Reach of the glyph atlas's distance field either side of an outline, texels.
#define ATLAS_SPREAD 6.0

// What the world is round the camera's picture, linear.
#define SURROUND_R 0.006F
#define SURROUND_G 0.007F
#define SURROUND_B 0.009F

// QuadData.shape.x
#define QUAD_PLATE 0
#define QUAD_GLYPH 1
#define QUAD_RING 2

// Balls that stand for the models that take light from others.
#define MOST_BALLS 32

// Views that one pass draws at once.
#define PASS_VIEWS 2

// The last level of the room's cube map, that of roughness 1.
#define ROOM_LAST_LEVEL 5.0

// The specialisation constant 0 of unpack.frag.
#define UNPACK_RGB8 0
#define UNPACK_GRAY8 1
#define UNPACK_NV12 2
#define UNPACK_YUYV 3

// One view of one frame.
struct ViewData {
  mat4 clip_from_world;
  mat4 clip_from_camera;  // from the frame of the camera whose picture it sees: vision axes, metres
  vec4 eye;               // xyz: the view's origin
  vec4 viewport;          // x, y, width, height: pixels of the target
  vec4 picture;           // x: which picture it sees, 0 or 1
};

// A picture of the camera on the surface that it lies on. Points of it are named by what an ideal lens would show them
// at: n = (x, y) / z.
struct PictureData {
  vec4 surface;         // n of the picture's first corner of the grid, n from one to the next
  vec4 surface_around;  // n of the outermost corners: left, top, right, bottom
  vec4 surface_grid;    // cells across, cells down, where its depths begin, 0
  vec4 intrinsic;       // fx, fy, cx, cy over the picture's size
  vec4 lens_map;        // texture coordinates of the lens map: n * xy + zw; all zero for an ideal lens
  vec4 shape;           // width / height; texture coordinates of the finger matte over the picture's; brightness
};

// What all views of a frame share.
struct SceneData {
  PictureData pictures[MOST_PICTURES];
  vec4 key_direction;  // xyz: to the light, unit
  vec4 key_color;
  vec4 matt[9];            // spherical harmonics of what a white matt surface gives back
  vec4 tone;               // rgb: what the camera shows as black; w: the camera's noise at mid grey, coded
  vec4 grain;              // camera pixels for a pixel of the view, seed, 0, 0
  vec4 balls[MOST_BALLS];  // centre, radius
};

// A part of a model, or a finger, being drawn: push constants.
struct DrawData {
  vec4 model_rows[3];  // affine world_from_model
  vec4 tint;           // rgb factor on the base colour, a opacity
  vec4 clip_plane;     // kept where dot(plane.xyz, p) + plane.w >= 0, in the world; all zero keeps everything
  vec4 shadow;         // which balls take light from it: the first, one past the last, 0, 0
  vec4 finger;         // x: depth of a finger along the camera's axis, metres; y: the picture that shows it
};

struct MaterialData {
  vec4 base_color;
  vec4 emissive;  // rgb, alpha cutoff (negative: no test)
  vec4 factors;   // metallic, roughness, normal scale, occlusion strength
  vec4 flags;     // x: 1 has a normal texture; y: 1 blends by its own alpha
};

// The face that a plane cuts a model open with, being drawn: push constants.
struct CutData {
  vec4 plane;   // as DrawData.clip_plane
  vec4 centre;  // xyz: of a square in the plane that holds the face; w: half its side, metres
  vec4 across;  // xyz: along one of its sides, unit
  vec4 hatch;   // dot(hatch.xyz, p) + hatch.w: how far across the lines a point is, metres
  vec4 color;   // as DrawData.tint
};

// A rectangle of text or of its backing plate, or one that holds a ring.
struct QuadData {
  vec4 origin;  // xyz: top left corner; w: 0 in the world, 1 on screen (pixels of the viewport, y down)
  vec4 edge_x;  // xyz: along the top
  vec4 edge_y;  // xyz: down the left side
  vec4 uv;      // glyph: u0, v0, u1, v1; plate: width, height, corner radius, 0 in one unit; ring: width, height and
                // thickness in radii, the share that is drawn, clockwise from the top
  vec4 color;   // linear, not premultiplied
  vec4 shape;   // x: QUAD_PLATE, QUAD_GLYPH or QUAD_RING
};

struct LineData {
  vec4 from;   // xyz world; w: width, pixels
  vec4 to;     // xyz world
  vec4 color;  // linear, not premultiplied
};

// Unpacking a camera picture: push constants.
struct UnpackData {
  uvec4 size;  // rows of the first plane, 0, 0, 0
};

#ifdef __cplusplus
static_assert(offsetof(ViewData, clip_from_camera) == 64 && offsetof(ViewData, eye) == 128 && sizeof(ViewData) == 176);
static_assert(offsetof(SceneData, key_direction) == 192 && sizeof(SceneData) == 912);
static_assert(sizeof(DrawData) == 112 && sizeof(MaterialData) == 64 && sizeof(QuadData) == 96 &&
              sizeof(LineData) == 48);
static_assert(sizeof(CutData) <= sizeof(DrawData));
static_assert(sizeof(UnpackData) == 16);
}  // namespace onestroke::gpu
#endif

#endif

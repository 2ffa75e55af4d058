// The surface that the camera's picture lies on.
#include "frame.glsl"

// 1 / z of each picture's surface at the corners of its grid, rows from the top; 1 / metres.
layout(set = 0, binding = BINDING_SURFACE, std430) readonly buffer Surface { float inverse_depths[]; };

float place_on(int i, int cells, float from, float step, float outer_from, float outer_to) {
  return i == 0 ? outer_from : i == cells ? outer_to : from + float(i - 1) * step;
}

// Camera frame, vision axes, metres. See SurfaceAxis.
vec3 surface_position(int column, int row) {
  ivec2 cells = ivec2(its_picture.surface_grid.xy);
  float z = 1.0 / inverse_depths[int(its_picture.surface_grid.z) + row * (cells.x + 1) + column];
  return vec3(place_on(column, cells.x, its_picture.surface.x, its_picture.surface.z, its_picture.surface_around.x, its_picture.surface_around.z),
              place_on(row, cells.y, its_picture.surface.y, its_picture.surface.w, its_picture.surface_around.y, its_picture.surface_around.w),
              1.0) * z;
}

#pragma once

#include "camera/coverage.h"
#include "camera/synthetic_renderer.h"

namespace onestroke {

/// What all rows of a picture share: when its samples of time lie, and which thing touches which row.
struct FramePlan {
  int time_samples = 1;
  Coverage coverage;  ///< The groups of marker 0, of marker 1, ..., then the fingers.

  void make(const SyntheticFrame& frame);
  /// Time sample k of a row, as u of the paths.
  double moment(const SyntheticFrame& frame, int row, int k) const;
};

/// Paints rows in linear light. One a thread.
class RowPainter {
 public:
  /// Call before the rows of a frame.
  void begin(const SyntheticFrame& frame, const FramePlan& plan);
  /// Four floats a pixel: red, green, blue, unused.
  void paint(int row, float* out);
  /// Rays since begin() that met cell c of marker m first: index m * max_cells + c.
  const std::vector<int>& hits() const { return hits_; }
  /// Rays cast through each pixel of a frame.
  static int rays_per_pixel(const SyntheticFrame& frame, const FramePlan& plan);

 private:
  struct Thing {
    std::size_t owner = 0, group = 0;
    bool finger = false;
    Coverage::Span span;
  };
  struct Placed {
    Mat3 R_local_camera{};
    Vec3 eye;
    LightFrame light;
  };
  /// A ray from the camera (z = 1) and the nearest thing that it meets, if any.
  struct Ray {
    Vec3 direction;
    double t = 0;
    const Thing* thing = nullptr;
    PlacedRod::Hit hit;
  };
  static constexpr std::size_t most_rays = 16;

  void place(double u);
  Placed locate(const PosePath& path, double u) const;
  void background(int row, float* out) const;
  void things_of_row(int row);
  void trace_row(int row, int k, float* out);
  /// Towards a point of the picture, z = 1.
  Vec3 direction(double u, double v) const;
  /// Fills rays_ and returns how many; side * side of them wherever a rod may be.
  int trace_pixel(int x, int y, int side, double shift);
  Ray trace(Vec3 direction, int column) const;
  Linear mean_light(std::span<const Ray> rays, Linear behind);
  Linear rod_light(const Ray& ray);
  Linear finger_light(const Ray& ray) const;
  float openness(Vec3 point_camera, const Thing* self) const;

  const SyntheticFrame* frame_ = nullptr;
  const FramePlan* plan_ = nullptr;
  double placed_at_ = -1;
  bool bent_ = false;
  double per_focal_x_ = 0, per_focal_y_ = 0;
  Mat3 R_world_camera_{};
  std::vector<PlacedRod> rods_;
  std::vector<Placed> markers_, fingers_;
  std::vector<Thing> active_;
  std::array<Ray, most_rays> rays_;
  std::vector<float> sample_;
  std::vector<int> hits_;
};

}  // namespace onestroke

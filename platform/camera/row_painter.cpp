#include "camera/row_painter.h"

#include "camera/finger.h"
#include "camera/lens.h"
#include "camera/matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onestroke {
namespace {

/// With several samples of time, fewer rays each do.
int rays_per_side(const SyntheticFrame& frame, const FramePlan& plan) {
  const int wanted = std::clamp(frame.effects.supersampling, 1, 4);
  return plan.time_samples > 4 ? std::min(wanted, 2) : wanted;
}

const Linear& ink(CellColor c) {
  static constexpr std::array<Linear, 3> inks{{{0.62f, 0.06f, 0.06f}, {0.05f, 0.36f, 0.10f}, {0.05f, 0.09f, 0.42f}}};
  return inks[static_cast<std::size_t>(c)];
}

/// Print is never quite even: 3 % of fine grain along and around the rod.
float grain(double s, Vec3 n) {
  const double v = std::sin(5.3 * s + 9.0 * n.x) * std::sin(3.1 * s - 7.0 * n.y + 8.0 * n.z);
  return static_cast<float>(1 + 0.03 * v);
}

}  // namespace

int RowPainter::rays_per_pixel(const SyntheticFrame& frame, const FramePlan& plan) {
  const int side = rays_per_side(frame, plan);
  return side * side * plan.time_samples;
}

void RowPainter::begin(const SyntheticFrame& frame, const FramePlan& plan) {
  frame_ = &frame;
  plan_ = &plan;
  placed_at_ = -1;
  bent_ = frame.intrinsics.distorted();
  per_focal_x_ = 1 / frame.intrinsics.fx;
  per_focal_y_ = 1 / frame.intrinsics.fy;
  rods_.resize(std::max(rods_.size(), frame.markers.size()));
  markers_.resize(frame.markers.size());
  fingers_.resize(frame.fingers.size());
  for (std::size_t i = 0; i < frame.markers.size(); ++i) rods_[i].hold(*frame.markers[i].rod);
  active_.reserve(plan.coverage.things());
  sample_.resize(4 * static_cast<std::size_t>(frame.width));
  hits_.assign(frame.markers.size() * max_cells, 0);
}

Vec3 RowPainter::direction(double u, double v) const {
  const Intrinsics& k = frame_->intrinsics;
  if (!bent_) return {(u - k.cx) * per_focal_x_, (v - k.cy) * per_focal_y_, 1};
  const Point2 p = undistort(k, {u, v});
  return {p.x, p.y, 1};
}

RowPainter::Placed RowPainter::locate(const PosePath& path, double u) const {
  const Pose pose = path.at(u);
  const Mat3 R_local_camera = transpose(to_matrix(pose.rotation));
  Mat3 R_local_world{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k) R_local_world[r][c] += R_local_camera[r][k] * R_world_camera_[c][k];
    }
  }
  return {R_local_camera, apply(R_local_camera, -pose.translation), LightFrame::in(R_local_world)};
}

void RowPainter::place(double u) {
  if (u == placed_at_) return;
  const bool first = placed_at_ < 0;
  placed_at_ = u;
  const bool head_moves = !frame_->T_world_camera.still();
  if (first || head_moves) R_world_camera_ = to_matrix(frame_->T_world_camera.at(u).rotation);
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    const PosePath& path = frame_->markers[i].T_camera_marker;
    if (!first && path.still() && !head_moves) continue;
    markers_[i] = locate(path, u);
    rods_[i].look_from(markers_[i].eye);
  }
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    const PosePath& path = frame_->fingers[i].T_camera_finger;
    if (first || !path.still() || head_moves) fingers_[i] = locate(path, u);
  }
}

void RowPainter::paint(int row, float* out) {
  things_of_row(row);
  const std::size_t n = sample_.size();
  const int count = plan_->time_samples;
  for (int k = 0; k < count; ++k) {
    float* const target = count == 1 ? out : sample_.data();
    place(plan_->moment(*frame_, row, k));
    background(row, target);
    if (!active_.empty()) trace_row(row, k, target);
    if (count == 1) return;
    const float share = 1.0f / static_cast<float>(count);
    if (k == 0) std::fill(out, out + n, 0.0f);
    for (std::size_t i = 0; i < n; ++i) out[i] += share * sample_[i];
  }
}

void RowPainter::background(int row, float* out) const {
  const std::size_t width = static_cast<std::size_t>(frame_->width);
  if (!frame_->room) {
    const Linear c = frame_->background;
    for (std::size_t x = 0; x < width; ++x) {
      out[4 * x] = c.r;
      out[4 * x + 1] = c.g;
      out[4 * x + 2] = c.b;
    }
    return;
  }
  constexpr std::size_t stride = 16;  // pixels between exact directions; between them the room is straight enough
  const auto place_of = [&](std::size_t x) {
    return frame_->room->place(apply(R_world_camera_, direction(static_cast<double>(x) + 0.5, row + 0.5)));
  };
  Room::Place from = place_of(0);
  for (std::size_t x = 0; x < width; x += stride) {
    const Room::Place to = place_of(x + stride);
    Room::Place end = to;
    const std::size_t n = std::min(stride, width - x);
    if (n < stride) {
      const float u = static_cast<float>(n) / static_cast<float>(stride);
      end = {from.x + u * (to.x - from.x), from.y + u * (to.y - from.y)};
    }
    frame_->room->draw(from, end, n, out + 4 * x);
    from = to;
  }
}

void RowPainter::things_of_row(int row) {
  active_.clear();
  std::size_t thing = 0;
  const auto note = [&](std::size_t owner, std::size_t group, bool is_finger) {
    const Coverage::Span span = plan_->coverage.at(thing++, row);
    if (span.first <= span.last) active_.push_back({owner, group, is_finger, span});
  };
  for (std::size_t m = 0; m < frame_->markers.size(); ++m) {
    for (std::size_t g = 0; g < frame_->markers[m].rod->groups().size(); ++g) note(m, g, false);
  }
  for (std::size_t f = 0; f < frame_->fingers.size(); ++f) note(f, 0, true);
}

void RowPainter::trace_row(int row, int k, float* out) {
  std::int32_t first = frame_->width, last = -1;
  for (const Thing& t : active_) {
    first = std::min(first, t.span.first);
    last = std::max(last, t.span.last);
  }
  const int side = rays_per_side(*frame_, *plan_);
  // The grid of rays shifts from one sample of time to the next, so that the samples fill in for each other.
  const double shift = plan_->time_samples == 1 ? 0.5 : (k % 2 == 0 ? 0.25 : 0.75);
  for (std::int32_t x = first; x <= last; ++x) {
    if (std::none_of(active_.begin(), active_.end(),
                     [&](const Thing& t) { return x >= t.span.first && x <= t.span.last; })) {
      continue;
    }
    float* const pixel = out + 4 * static_cast<std::size_t>(x);
    const Linear behind{pixel[0], pixel[1], pixel[2]};
    const int rays = trace_pixel(x, row, side, shift);
    const Linear mean = mean_light(std::span(rays_).first(static_cast<std::size_t>(rays)), behind);
    pixel[0] = mean.r;
    pixel[1] = mean.g;
    pixel[2] = mean.b;
  }
}

int RowPainter::trace_pixel(int x, int y, int side, double shift) {
  const auto cast = [&](int i, int j) { return trace(direction(x + (i + shift) / side, y + (j + shift) / side), x); };
  int rays = 0;
  const bool rods = std::any_of(active_.begin(), active_.end(),
                                [&](const Thing& t) { return !t.finger && x >= t.span.first && x <= t.span.last; });
  if (!rods && side > 1) {  // inside a finger two opposite corners say all
    rays_[0] = cast(0, 0);
    rays_[1] = cast(side - 1, side - 1);
    if (rays_[0].thing == rays_[1].thing) return 2;
  }
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) rays_[static_cast<std::size_t>(rays++)] = cast(i, j);
  }
  return rays;
}

Linear RowPainter::mean_light(std::span<const Ray> rays, Linear behind) {
  const float share = 1.0f / static_cast<float>(rays.size());
  const Thing* const first = rays[0].thing;
  const bool one = std::all_of(rays.begin(), rays.end(), [&](const Ray& r) { return r.thing == first; });
  if (one && first && first->finger) {  // skin is smooth: its light at the mean of the rays is the mean light
    Ray mean = rays[0];
    for (const Ray& r : rays.subspan(1)) {
      mean.direction = mean.direction + r.direction;
      mean.t += r.t;
    }
    mean.direction = static_cast<double>(share) * mean.direction;
    mean.t *= static_cast<double>(share);
    return finger_light(mean);
  }
  Linear sum;
  for (const Ray& r : rays) sum = sum + (!r.thing ? behind : r.thing->finger ? finger_light(r) : rod_light(r));
  return share * sum;
}

RowPainter::Ray RowPainter::trace(Vec3 direction, int column) const {
  Ray ray{direction, std::numeric_limits<double>::max(), nullptr, {}};
  for (const Thing& thing : active_) {
    if (column < thing.span.first || column > thing.span.last) continue;
    if (thing.finger) {
      const SyntheticFinger& f = frame_->fingers[thing.owner];
      const Placed& at = fingers_[thing.owner];
      const double t = finger::cast(f.length, f.radius, at.eye, apply(at.R_local_camera, direction));
      if (t > 0 && t < ray.t) ray = {direction, t, &thing, {}};
    } else {
      const Placed& at = markers_[thing.owner];
      PlacedRod::Hit hit;
      if (rods_[thing.owner].cast(thing.group, apply(at.R_local_camera, direction), ray.t, hit)) {
        ray = {direction, hit.t, &thing, hit};
      }
    }
  }
  return ray;
}

Linear RowPainter::rod_light(const Ray& ray) {
  const std::size_t m = ray.thing->owner;
  const Rod& rod = *frame_->markers[m].rod;
  const Placed& at = markers_[m];
  const Vec3 local = apply(at.R_local_camera, ray.direction);
  const Rod::Surface surface = rod.surface(rod.parts()[ray.hit.part], ray.hit.cap, at.eye + ray.t * local);
  ++hits_[m * max_cells + static_cast<std::size_t>(surface.cell)];
  const CellColor color = rod.spec().cells[static_cast<std::size_t>(surface.cell)];
  const Material print{grain(surface.s, surface.normal) * ink(color), 0.10f, 0.0f};
  return shade(print, at.light, surface.normal, -normalized(local), openness(ray.t * ray.direction, ray.thing));
}

Linear RowPainter::finger_light(const Ray& ray) const {
  const SyntheticFinger& f = frame_->fingers[ray.thing->owner];
  const Placed& at = fingers_[ray.thing->owner];
  const Vec3 local = apply(at.R_local_camera, ray.direction);
  const Vec3 point = at.eye + ray.t * local;
  return shade(finger::material(f.radius, f.jointed, point), at.light,
               finger::normal(f.length, f.radius, f.jointed, point), -normalized(local),
               openness(ray.t * ray.direction, ray.thing));
}

float RowPainter::openness(Vec3 point, const Thing* self) const {
  constexpr double reach = 9;  // mm: how far a finger's shade goes
  double open = 1;
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    if (self->finger && self->owner == i) continue;
    const SyntheticFinger& f = frame_->fingers[i];
    const Vec3 local = apply(fingers_[i].R_local_camera, point) + fingers_[i].eye;
    const double near = std::clamp(1 - finger::gap(f.length, f.radius, local) / reach, 0.0, 1.0);
    open *= 1 - 0.6 * near * near;
  }
  return static_cast<float>(open);
}

}  // namespace onestroke

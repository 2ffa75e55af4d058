#include "tracking/ring_lines.h"

#include "tracking/edge_step.h"
#include "tracking/ink_matcher.h"
#include "tracking/placed_rod.h"
#include "tracking/sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace onestroke {
namespace {

// Of the step, what must lie within the reach.
constexpr float min_rise = 0.6F;
// A surface seen at a flatter angle than this (cosine) shows gloss and what is behind.
constexpr double min_facing = 0.2;
// Less than this many pixels to the middle of the next cell: the inks run together.
constexpr double min_reach = 1.2;
// Pixels from the outline within which the background shines in.
constexpr double rim = 1.2;
// Two inks differ by this at least, levels.
constexpr float min_contrast = 15;
// Standard deviation of an edge, pixels: at best, and of what noise adds where inks differ by one level.
constexpr double best_sigma = 0.06, noise_sigma = 6;
constexpr double outline_sigma = 0.1;
// Lines of one edge nearer to one another than this, pixels, share their noise: the picture's compression has spread
// it.
constexpr double shared_noise = 3.6;
// By how much less the edges beside a mitre tell, where the other arm shades this one and colours it.
constexpr double mitre_scatter = 3;
// Places beside one cell.
constexpr int max_outlines = 8;
constexpr float min_outline_contrast = 40;

// Linear light from levels, near enough for shares of a difference: a gamma of 2. What is left moves the edges between
// two inks all alike, and is fitted as their growth.
ColorLanes linear(const ColorLanes& coded) {
  return coded * coded;
}

// Colour differences as they tell where an edge is: cameras that compress keep the brightness at every pixel and the
// colour at every other one. In terms of Y, Cb, Cr (BT.601) brightness counts three times. By column; the fourth lane
// counts nothing.
constexpr std::array<std::array<float, 4>, 3> weights_by_channel() {
  constexpr float brightness = 3;
  constexpr std::array y_of{0.299F, 0.587F, 0.114F};
  std::array<std::array<float, 4>, 3> columns{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float y = y_of[i], blue = i == 2 ? 1 : 0, red = i == 0 ? 1 : 0;
    const float cb = 0.564F * 0.564F * (blue - y), cr = 0.713F * 0.713F * (red - y);
    for (std::size_t k = 0; k < 3; ++k) columns[i][k] = (brightness * y - cr - cb) * y_of[k];
    columns[i][0] += cr;
    columns[i][2] += cb;
  }
  return columns;
}

ColorLanes weighted(const ColorLanes& d) {
  static constexpr auto columns = weights_by_channel();
  return cv::v_load(columns[0].data()) * cv::v_broadcast_element<0>(d) +
         cv::v_load(columns[1].data()) * cv::v_broadcast_element<1>(d) +
         cv::v_load(columns[2].data()) * cv::v_broadcast_element<2>(d);
}

float norm(const ColorLanes& d) {
  const ColorLanes rgb = without_rest(d);
  return std::sqrt(cv::v_reduce_sum(rgb * rgb));
}

// A place in the picture, or a way from one to another. Eigen would load as a pair what was stored one by one, which
// waits for memory.
struct Spot {
  double u = 0, v = 0;

  friend Spot operator+(const Spot& a, const Spot& b) { return {a.u + b.u, a.v + b.v}; }
  friend Spot operator-(const Spot& a, const Spot& b) { return {a.u - b.u, a.v - b.v}; }
  friend Spot operator*(double k, const Spot& a) { return {k * a.u, k * a.v}; }
  double dot(const Spot& b) const { return u * b.u + v * b.v; }
  double norm() const { return std::sqrt(dot(*this)); }
  Spot across() const { return {-v, u}; }
};

class LineMeter {
 public:
  LineMeter(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& motion,
            const LineOptions& options, LineSet& set)
      : image_(view.image),
        k_(view.intrinsics),
        clock_(view.clock),
        rod_(rod),
        inks_(inks),
        motion_(motion),
        options_(options),
        set_(set),
        placed_(rod, motion.pose),
        plain_(!view.clock.rolls() && !view.intrinsics.distorted()),
        eye_(-motion.pose.R.transpose() * motion.pose.t) {}

  void run() {
    for (int e = 1; e < rod_.cell_count(); e += options_.stride) ring(e);
    for (int c = 0; c < rod_.cell_count(); c += options_.outline_stride) outlines(c);
  }

 private:
  bool contains(const Spot& p) const { return image_.contains(p.u, p.v); }

  bool pixel_of(const Vec3d& point, Spot& pixel) const {
    if (!plain_) return pixel_of_any(point, pixel);
    if (point.z() < 1) return false;
    const double iz = 1 / point.z();
    pixel = {k_.fx * iz * point.x() + k_.cx, k_.fy * iz * point.y() + k_.cy};
    return contains(pixel);
  }

  [[gnu::noinline]] bool pixel_of_any(const Vec3d& point, Spot& pixel) const {
    Vec2d p;
    if (!project(k_, clock_, motion_, point, p)) return false;
    pixel = {p.x(), p.y()};
    return contains(pixel);
  }

  // How the pixel moves with the point that it shows: its u and its v.
  struct Slope {
    double u[3], v[3];
  };

  bool slope_of(const Vec3d& point, const Spot& pixel, Slope& slope) const {
    if (!plain_) return slope_of_any(point, slope);
    const double iz = 1 / point.z();
    slope.u[0] = k_.fx * iz;
    slope.u[1] = 0;
    slope.u[2] = (k_.cx - pixel.u) * iz;
    slope.v[0] = 0;
    slope.v[1] = k_.fy * iz;
    slope.v[2] = (k_.cy - pixel.v) * iz;
    return true;
  }

  [[gnu::noinline]] bool slope_of_any(const Vec3d& point, Slope& slope) const {
    Vec2d same;
    Eigen::Matrix<double, 2, 3> both;
    if (!project(k_, point, same, both)) return false;
    for (int i = 0; i < 3; ++i) {
      slope.u[i] = both(0, i);
      slope.v[i] = both(1, i);
    }
    return true;
  }

  bool hidden(const RodModel::Section& section, const Vec3d& x) const {
    return !whole_ && rod_.hides_itself(section, motion_.pose.R.transpose() * (x - motion_.pose.t), eye_);
  }

  void ring(int e) {
    const RodModel::Section& section = rod_.edge(e);
    // Lines of the two sides of a mitre do not meet.
    if (rod_.middle(e - 1).tangent.dot(rod_.middle(e).tangent) < 0.5) return;
    const PlacedSection& here = placed_.edge(e);
    if (here.centre.z() < 10) return;
    const double radius = k_.fx * rod_.radius() / here.centre.z();
    const double widest = std::min(0.95, 1 - rim / radius);
    if (widest < 0.2) return;
    whole_ = rod_.shows_whole(section, eye_);
    const int lines = std::clamp(static_cast<int>(2 * widest * radius / options_.spacing),
                                 std::min(3, options_.max_lines), options_.max_lines);
    const double apart = 2 * widest * radius / std::max(lines - 1, 1);
    const bool beside_mitre = !placed_.edge(e - 1).square || !placed_.edge(e + 1).square;
    const double scatter = std::sqrt(std::max(1.0, shared_noise / apart)) * (beside_mitre ? mitre_scatter : 1);
    for (int i = 0; i < lines; ++i)
      line(e, section, here, lines > 1 ? widest * (2.0 * i / (lines - 1) - 1) : 0.0, scatter);
  }

  void line(int e, const RodModel::Section& section, const PlacedSection& here, double sine, double scatter) {
    const double cosine = std::sqrt(1 - sine * sine);
    const Vec3d out = here.out(sine, cosine), x = here.surface(rod_.radius(), out);
    if (const double facing = -out.dot(x); facing < 0 || facing * facing < min_facing * min_facing * x.squaredNorm())
      return;
    const Vec3d a = placed_.middle_of(e - 1, placed_.middle(e - 1).out(sine, cosine));
    const Vec3d b = placed_.middle_of(e, placed_.middle(e).out(sine, cosine));
    Spot px, pa, pb;
    if (!pixel_of(x, px) || !pixel_of(a, pa) || !pixel_of(b, pb)) return;
    const double back = (pa - px).norm(), on = (pb - px).norm(), cell = std::min(back, on);
    if (cell < min_reach || hidden(section, x)) return;
    ++set_.expected;
    ++set_.expected_at[static_cast<std::size_t>(e)];
    const ColorLanes ca = plateau(px, pa), cb = plateau(px, pb);
    if (inks_.match(ca, rod_.ink(e - 1)) != Inks::Match::agrees || inks_.match(cb, rod_.ink(e)) != Inks::Match::agrees)
      return;
    const float contrast = norm(cb - ca);
    if (contrast < min_contrast) return;
    ++set_.shown;
    const double reach = std::min(options_.reach, 0.9 * cell);
    const Spot to_a = 1 / back * (pa - px), to_b = 1 / on * (pb - px);
    if (!contains(px + reach * to_a) || !contains(px + reach * to_b)) return;
    Vec3d rim_step = here.tangent.cross(out);
    if (!here.square) rim_step -= rim_step.dot(here.cut) / here.along * here.tangent;
    LineMeasurement m;
    double across = 0;
    // The two lead away from each other, but for the bend.
    if (!tell_slope(x, px, rim_step, 0.5 * (to_b - to_a), m, across)) return;
    const double noise = noise_sigma / static_cast<double>(contrast);
    m.sigma = scatter * std::sqrt(best_sigma * best_sigma + noise * noise);
    const ColorLanes la = linear(ca);
    const double along = step_offset(px, to_a, to_b, reach, la, linear(cb) - la);
    if (std::abs(along) > reach) return;
    m.cell = e;
    add(m, across, along, growth_of(rod_.ink(e - 1), rod_.ink(e)));
  }

  // Which of two inks grows at the cost of the other: the pairs RG, GB, BR count along the rod, the others against it.
  static std::pair<int, double> growth_of(int a, int b) {
    return (b - a + 3) % 3 == 1 ? std::pair(a, 1.0) : std::pair(b, -1.0);
  }

  // The colour of a cell on a line, its middle at m, away from the edge at x.
  ColorLanes plateau(const Spot& x, const Spot& m) const {
    const Spot step = 0.2 * (m - x);
    const ColorLanes middle = at(m);
    if (!contains(m + step)) return middle;
    return (at(m - step) + middle + at(m + step)) * cv::v_setall_f32(1.0F / 3);
  }

  ColorLanes at(const Spot& p) const { return sample_lanes(image_, p.u, p.v); }

  // What an outline's offset is off by, reaches, if what is behind the rod changes up to the rod as it does one reach
  // further out. Nobody knows whether it does.
  double unevenness(const Spot& further, const ColorLanes& behind, const ColorLanes& difference) const {
    if (!contains(further)) return 0;
    const ColorLanes heavy = weighted(difference), change = linear(at(further)) - behind;
    return static_cast<double>(edge_step().ramp * cv::v_reduce_sum(heavy * change) /
                               cv::v_reduce_sum(heavy * difference));
  }

  static const EdgeStep& edge_step() {
    static const EdgeStep step;
    return step;
  }

  // How far along the line past px the colour, in linear light, steps by a difference from what it is at a; beyond the
  // reach where it does not.
  double step_offset(const Spot& px, const Spot& to_a, const Spot& to_b, double reach, const ColorLanes& at_a,
                     const ColorLanes& difference) const {
    const EdgeStep& step = edge_step();
    constexpr std::size_t half = EdgeStep::samples / 2;
    const double spacing = EdgeStep::spacing * reach;
    const auto on_a = PicturePoint::step(spacing * to_a.u, spacing * to_a.v);
    const auto on_b = PicturePoint::step(spacing * to_b.u, spacing * to_b.v);
    const auto middle = PicturePoint::at(px.u, px.v);
    PicturePoint back = middle, on = middle;
    // The colours weighted as a whole, as what is wanted of each depends on it by a line; the weights are alike on both
    // sides, and the gains but for their sign.
    ColorLanes sum = cv::v_setall_f32(step.weight[half]) * linear(sample_lanes(image_, middle));
    ColorLanes gained = cv::v_setzero_f32(), rise = gained;
    for (std::size_t i = 1; i <= half; ++i) {
      const ColorLanes first = linear(sample_lanes(image_, back += on_a));
      const ColorLanes last = linear(sample_lanes(image_, on += on_b));
      rise = last - first;
      sum += cv::v_setall_f32(step.weight[half + i]) * (last + first);
      gained += cv::v_setall_f32(step.gain[half + i]) * rise;
    }
    const ColorLanes heavy = weighted(difference), from_a = sum - cv::v_setall_f32(step.weights) * at_a;
    float all[4];
    cv::v_store(all, cv::v_reduce_sum4(heavy * difference, heavy * rise, heavy * from_a, heavy * gained));
    const auto [whole, risen, found, gain] = all;
    // Blur wider than the reach moves an edge as its neighbours will.
    if (risen < min_rise * whole) return 2 * reach;
    const float one = 1 / whole;
    return static_cast<double>(EdgeStep::offset(found * one - step.level, gain * one)) * reach;
  }

  // How an edge that runs along `tangent` through a point, both in camera axes, moves with the pose, and how far across
  // it a direction in the picture leads. False where that is hardly at all.
  bool tell_slope(const Vec3d& x, const Spot& px, const Vec3d& tangent, const Spot& direction, LineMeasurement& m,
                  double& across) const {
    Slope slope;
    if (!slope_of(x, px, slope)) return false;
    const auto along = [&](const double(&way)[3]) {
      return way[0] * tangent.x() + way[1] * tangent.y() + way[2] * tangent.z();
    };
    const Spot edge{along(slope.u), along(slope.v)};
    const double length = edge.norm();
    if (length < 1e-6) return false;
    const Spot normal = 1 / length * edge.across();
    across = direction.dot(normal);
    if (std::abs(across) < 0.3) return false;
    const auto gradient = [&](int i) { return normal.u * slope.u[i] + normal.v * slope.v[i]; };
    const double gx = gradient(0), gy = gradient(1), gz = gradient(2);
    const Vec3d& t = motion_.pose.t;
    const double rx = x.x() - t.x(), ry = x.y() - t.y(), rz = x.z() - t.z();
    double* const by = m.by_pose.data();
    by[0] = ry * gz - rz * gy;
    by[1] = rz * gx - rx * gz;
    by[2] = rx * gy - ry * gx;
    by[3] = gx;
    by[4] = gy;
    by[5] = gz;
    m.seconds = clock_.at(px.v);
    return true;
  }

  void add(LineMeasurement& m, double across, double along, std::pair<int, double> growth) {
    m.offset = along * across;
    m.growth = growth.first;
    m.by_growth = growth.second * across;
    set_.lines.push_back(m);
  }

  void outlines(int c) {
    const RodModel::Section& section = rod_.middle(c);
    const PlacedSection& here = placed_.middle(c);
    const double away = here.centre.cross(here.tangent).norm();
    // Within about 25 degrees of the axis the outline is the tip's or the neighbour's.
    if (here.centre.z() < 10 || away < 0.42 * here.centre.norm()) return;
    whole_ = rod_.shows_whole(section, eye_);
    const double cosine = std::min(1.0, rod_.radius() / away), sine = std::sqrt(1 - cosine * cosine);
    const double pixels = k_.fx * rod_.pitch() * away / here.centre.squaredNorm();
    const int count =
        rod_.arm_of(c) < 0 ? 1 : std::clamp(static_cast<int>(pixels / options_.outline_spacing), 1, max_outlines);
    for (int i = 0; i < count; ++i) {
      const double along = rod_.pitch() * ((i + 0.5) / count - 0.5);
      for (const double side : {-sine, sine}) outline(c, section, here, along, side, cosine);
    }
  }

  void outline(int c, const RodModel::Section& section, const PlacedSection& here, double shift, double sine,
               double cosine) {
    const Vec3d centre = here.centre + shift * here.tangent;
    const Vec3d x = here.surface(rod_.radius(), here.out(sine, cosine)) + shift * here.tangent;
    Spot px, pc, pt;
    if (!pixel_of(x, px) || !pixel_of(centre, pc) || !pixel_of(x + here.tangent, pt)) return;
    const Spot edge = pt - px;
    Spot normal = 1 / edge.norm() * edge.across();
    if (normal.dot(px - pc) < 0) normal = -1 * normal;
    const double radius = normal.dot(px - pc);
    if (radius < 1.5 || hidden(section, x)) return;
    const double reach = std::min(std::max(0.4 * radius, 1.2), options_.reach);
    const Spot inside = px - reach * normal, outside = px + reach * normal;
    if (!contains(outside) || !contains(inside)) return;
    const ColorLanes ca = at(inside), cb = at(outside);
    if (inks_.match(ca, rod_.ink(c)) != Inks::Match::agrees || norm(cb - ca) < min_outline_contrast) return;
    // What is behind the rod tells by what the ink does not have of it, as the ink darkens towards the outline.
    const ColorLanes ink = linear(ca), behind = linear(cb), heavy = weighted(ink);
    const float share = cv::v_reduce_sum(behind * heavy) / cv::v_reduce_sum(ink * heavy);
    const ColorLanes other = behind - ink * cv::v_setall_f32(share);
    if (norm(other) < 0.1F * norm(ink)) return;
    LineMeasurement m;
    double across = 0;
    if (!tell_slope(x, px, here.tangent, normal, m, across)) return;
    const double along = step_offset(px, -1 * normal, normal, reach, ink, other);
    if (std::abs(along) >= reach) return;
    const double uneven = reach * unevenness(outside + reach * normal, behind, other);
    m.sigma = std::sqrt(outline_sigma * outline_sigma + uneven * uneven);
    m.cell = c;
    add(m, across, along, {outline_growth + 2 * std::clamp(rod_.arm_of(c), 0, 1) + (sine > 0 ? 1 : 0), 1});
  }

  const ImageView& image_;
  const Intrinsics& k_;
  const RowClock& clock_;
  const RodModel& rod_;
  const InkMatcher inks_;
  const Motion& motion_;
  const LineOptions& options_;
  LineSet& set_;
  PlacedRod placed_;
  const bool plain_;    // A lens and a shutter that change nothing.
  Vec3d eye_;           // Marker frame.
  bool whole_ = false;  // The section at hand hides nowhere behind the rod itself.
};

}  // namespace

void measure_lines(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& motion,
                   const LineOptions& options, LineSet& set) {
  set.lines.clear();
  set.expected = set.shown = 0;
  set.expected_at.fill(0);
  LineMeter(view, rod, inks, motion, options, set).run();
}

}  // namespace onestroke

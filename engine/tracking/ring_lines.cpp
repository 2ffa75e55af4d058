#include "tracking/ring_lines.h"

#include "tracking/edge_step.h"
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
Color linear(const Color& coded) {
  return coded * coded;
}

// Colour differences as they tell where an edge is: cameras that compress keep the brightness at every pixel and the
// colour at every other one. In terms of Y, Cb, Cr (BT.601) brightness counts three times.
Color weighted(const Color& d) {
  constexpr float brightness = 3;
  const Color y_of(0.299F, 0.587F, 0.114F);
  const float y = (y_of * d).sum(), cb = 0.564F * 0.564F * (d[2] - y), cr = 0.713F * 0.713F * (d[0] - y);
  return Color(cr, 0, cb) + (brightness * y - cr - cb) * y_of;
}

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
  bool pixel_of(const Vec3d& point, Vec2d& pixel) const {
    if (!plain_) return project(k_, clock_, motion_, point, pixel) && image_.contains(pixel.x(), pixel.y());
    if (point.z() < 1) return false;
    const double iz = 1 / point.z();
    pixel = {k_.fx * iz * point.x() + k_.cx, k_.fy * iz * point.y() + k_.cy};
    return image_.contains(pixel.x(), pixel.y());
  }

  // The derivative of the pixel by the point that it shows.
  bool slope_of(const Vec3d& point, const Vec2d& pixel, Eigen::Matrix<double, 2, 3>& slope) const {
    Vec2d same;
    if (!plain_) return project(k_, point, same, slope);
    const double iz = 1 / point.z();
    slope << k_.fx * iz, 0, (k_.cx - pixel.x()) * iz, 0, k_.fy * iz, (k_.cy - pixel.y()) * iz;
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
    Vec2d px, pa, pb;
    if (!pixel_of(x, px) || !pixel_of(a, pa) || !pixel_of(b, pb)) return;
    const double back = (pa - px).norm(), on = (pb - px).norm(), cell = std::min(back, on);
    if (cell < min_reach || hidden(section, x)) return;
    ++set_.expected;
    ++set_.expected_at[static_cast<std::size_t>(e)];
    const Color ca = plateau(px, pa), cb = plateau(px, pb);
    if (inks_.match(ca, rod_.ink(e - 1)) != Inks::Match::agrees || inks_.match(cb, rod_.ink(e)) != Inks::Match::agrees)
      return;
    const float contrast = (cb - ca).matrix().norm();
    if (contrast < min_contrast) return;
    ++set_.shown;
    const double reach = std::min(options_.reach, 0.9 * cell);
    const Vec2d to_a = (pa - px) * (1 / back), to_b = (pb - px) * (1 / on);
    if (!image_.contains(px.x() + reach * to_a.x(), px.y() + reach * to_a.y())) return;
    if (!image_.contains(px.x() + reach * to_b.x(), px.y() + reach * to_b.y())) return;
    const Color la = linear(ca);
    const double along = step_offset(px, to_a, to_b, reach, la, linear(cb) - la);
    if (std::abs(along) > reach) return;
    const Vec3d turn = here.tangent.cross(out) * rod_.radius();
    const Vec3d rim_step = here.square ? turn : Vec3d(turn - (turn.dot(here.cut) / here.along) * here.tangent);
    const double noise = noise_sigma / static_cast<double>(contrast);
    // The two lead away from each other, but for the bend.
    const Vec2d direction = 0.5 * (to_b - to_a);
    add(x, px, rim_step, direction, along, scatter * std::sqrt(best_sigma * best_sigma + noise * noise), e,
        growth_of(rod_.ink(e - 1), rod_.ink(e)));
  }

  // Which of two inks grows at the cost of the other: the pairs RG, GB, BR count along the rod, the others against it.
  static std::pair<int, double> growth_of(int a, int b) {
    return (b - a + 3) % 3 == 1 ? std::pair(a, 1.0) : std::pair(b, -1.0);
  }

  // The colour of a cell on a line, its middle at m, away from the edge at x.
  Color plateau(const Vec2d& x, const Vec2d& m) const {
    const Vec2d step = 0.2 * (m - x);
    const ColorLanes middle = at(m);
    if (!image_.contains(m.x() + step.x(), m.y() + step.y())) return to_color(middle);
    return to_color((at(m - step) + middle + at(m + step)) * cv::v_setall_f32(1.0F / 3));
  }

  ColorLanes at(const Vec2d& p) const { return sample_lanes(image_, p.x(), p.y()); }

  // How far along the line past px the colour, in linear light, steps by a difference from what it is at a; beyond the
  // reach where it does not.
  double step_offset(const Vec2d& px, const Vec2d& to_a, const Vec2d& to_b, double reach, const Color& at_a,
                     const Color& difference) const {
    static const EdgeStep step;
    constexpr std::size_t half = EdgeStep::samples / 2;
    const Color heavy = weighted(difference), d = heavy / (heavy * difference).sum();
    // The colours weighted as a whole, as what is wanted of each depends on it by a line.
    ColorLanes sum = cv::v_setzero_f32(), gained = sum;
    const auto add = [&](std::size_t i, const ColorLanes& light) {
      sum += cv::v_setall_f32(step.weight[i]) * light;
      gained += cv::v_setall_f32(step.gain[i]) * light;
    };
    const Vec2d step_a = EdgeStep::spacing * reach * to_a, step_b = EdgeStep::spacing * reach * to_b;
    const auto on_a = PicturePoint::step(step_a.x(), step_a.y()), on_b = PicturePoint::step(step_b.x(), step_b.y());
    const auto middle = PicturePoint::at(px.x(), px.y());
    add(half, linear(sample_lanes(image_, middle)));
    PicturePoint back = middle, on = middle;
    ColorLanes first = sum, last = sum;
    for (std::size_t i = 1; i <= half; ++i) {
      first = linear(sample_lanes(image_, back += on_a));
      add(half - i, first);
      last = linear(sample_lanes(image_, on += on_b));
      add(half + i, last);
    }
    // Blur wider than the reach moves an edge as its neighbours will.
    if ((to_color(last - first) * d).sum() < min_rise) return 2 * reach;
    const float found = ((to_color(sum) - step.weights * at_a) * d).sum() - step.level;
    return static_cast<double>(EdgeStep::offset(found, (to_color(gained) * d).sum())) * reach;
  }

  // An edge whose direction at a point is that of `tangent`, both in camera axes, was found `along` a direction.
  void add(const Vec3d& x, const Vec2d& px, const Vec3d& tangent, const Vec2d& direction, double along, double sigma,
           int cell, std::pair<int, double> growth) {
    Eigen::Matrix<double, 2, 3> by_point;
    if (!slope_of(x, px, by_point)) return;
    const Vec2d edge = by_point * tangent;
    const double length = edge.norm();
    if (length < 1e-9) return;
    const Vec2d normal = Vec2d(-edge.y(), edge.x()) * (1 / length);
    const double across = direction.dot(normal);
    if (std::abs(across) < 0.3) return;
    const Vec3d gradient = (normal.transpose() * by_point).transpose();
    Eigen::Matrix<double, 6, 1> by_pose;
    by_pose.head<3>() = (x - motion_.pose.t).cross(gradient);
    by_pose.tail<3>() = gradient;
    set_.lines.push_back(
        {by_pose, clock_.at(px.y()), along * across, sigma, cell, growth.first, growth.second * across});
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
    Vec2d px, pc, pt;
    if (!pixel_of(x, px) || !pixel_of(centre, pc) || !pixel_of(x + here.tangent, pt)) return;
    const Vec2d edge = (pt - px).normalized();
    Vec2d normal(-edge.y(), edge.x());
    if (normal.dot(px - pc) < 0) normal = -normal;
    const double radius = normal.dot(px - pc);
    if (radius < 1.5 || hidden(section, x)) return;
    const double reach = std::min(std::max(0.4 * radius, 1.2), options_.reach);
    const Vec2d inside = px - reach * normal, outside = px + reach * normal;
    if (!image_.contains(outside.x(), outside.y()) || !image_.contains(inside.x(), inside.y())) return;
    const Color ca = to_color(at(inside)), cb = to_color(at(outside));
    if (inks_.match(ca, rod_.ink(c)) != Inks::Match::agrees || (cb - ca).matrix().norm() < min_outline_contrast) return;
    // What is behind the rod tells by what the ink does not have of it, as the ink darkens towards the outline.
    const Color ink = linear(ca), behind = linear(cb), heavy = weighted(ink);
    const Color other = behind - ink * ((behind * heavy).sum() / (ink * heavy).sum());
    if (other.matrix().norm() < 0.1F * ink.matrix().norm()) return;
    const double along = step_offset(px, -normal, normal, reach, ink, other);
    if (std::abs(along) < reach)
      add(x, px, here.tangent, normal, along, outline_sigma, c,
          {outline_growth + 2 * std::clamp(rod_.arm_of(c), 0, 1) + (sine > 0 ? 1 : 0), 1});
  }

  const ImageView& image_;
  const Intrinsics& k_;
  const RowClock& clock_;
  const RodModel& rod_;
  const Inks& inks_;
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

#include "tracking/edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

constexpr std::array<double, 5> ring_angles{-0.95, -0.5, 0.0, 0.5, 0.95};
constexpr int max_samples = 25;

class EdgeMeter {
 public:
  EdgeMeter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks, const EigenPose& pose,
            EdgeSet& set)
      : image_(image), k_(k), rod_(rod), inks_(inks), pose_(pose), eye_(-pose.R.transpose() * pose.t), set_(set) {}

  void rings(CellRange range) {
    for (int e = std::max(1, range.first + 1); e < rod_.cell_count() && e <= range.last; ++e)
      for (const double phi : ring_angles) ring(e, phi);
  }

  void outlines(CellRange range) {
    for (int c = range.first; c < rod_.cell_count() && c <= range.last; ++c)
      for (const double side : {-1.0, 1.0}) outline(c, side);
  }

 private:
  bool pixel_of(const Vec3d& marker_point, Vec2d& pixel) const {
    return project(k_, pose_ * marker_point, pixel) && image_.contains(pixel.x(), pixel.y());
  }

  // The colour along the generator line through an edge point steps from one cell's ink to the next one's.
  void ring(int e, double phi) {
    const RodModel::Section& section = rod_.edge(e);
    Vec3d out;
    const Vec3d x = rod_.surface(section, eye_, phi, &out);
    const Vec3d view = (eye_ - x).normalized();
    const Vec3d a = rod_.surface(rod_.middle(e - 1), eye_, phi), b = rod_.surface(rod_.middle(e), eye_, phi);
    Vec2d px, pa, pb;
    if (!pixel_of(x, px) || !pixel_of(a, pa) || !pixel_of(b, pb)) return;
    const double reach = std::min((pa - px).norm(), (pb - px).norm());
    // Less than 1.2 pixels to the middle of the next cell: the inks run together.
    if (reach < 1.2) return;
    if (out.dot(view) < 0.15 || rod_.hides_itself(section, x, eye_)) return;
    ++set_.expected_rings;
    const Vec2d step = ring_direction(section, phi);
    if (step.norm() < 1e-9) return;
    const Color ca = image_.sample(pa.x(), pa.y()), cb = image_.sample(pb.x(), pb.y());
    if (inks_.match(ca, rod_.ink(e - 1)) != Inks::Match::agrees || inks_.match(cb, rod_.ink(e)) != Inks::Match::agrees)
      return;
    double along;
    if (!crossing(pa, px, pb, ca, cb, along)) return;
    const Vec2d direction = (pb - pa).normalized();
    const Vec2d normal(-step.y() / step.norm(), step.x() / step.norm());
    set_.edges.push_back({pose_ * x, normal, along * direction.dot(normal), true, e});
  }

  // Direction of the ring's image at the edge point, pixels.
  Vec2d ring_direction(const RodModel::Section& section, double phi) const {
    Vec2d p, q;
    if (!pixel_of(rod_.surface(section, eye_, phi - 0.05), p) || !pixel_of(rod_.surface(section, eye_, phi + 0.05), q))
      return Vec2d::Zero();
    return q - p;
  }

  // Where between pa and pb the colour passes half way from ca to cb: pixels past px, found on the two straight pieces
  // pa-px and px-pb. The crossing nearest to px counts.
  bool crossing(const Vec2d& pa, const Vec2d& px, const Vec2d& pb, const Color& ca, const Color& cb,
                double& along) const {
    const Color d = cb - ca;
    const float dd = (d * d).sum();
    if (dd < 15 * 15) return false;
    const double la = (px - pa).norm(), lb = (pb - px).norm();
    const int n = std::clamp(static_cast<int>((la + lb) / 0.6), 6, max_samples - 1);
    std::array<double, max_samples> at, value;
    for (int i = 0; i <= n; ++i) {
      const double s = -la + (la + lb) * i / n;
      const Vec2d p = s < 0 ? Vec2d(px + (pa - px) * (-s / la)) : Vec2d(px + (pb - px) * (s / lb));
      const auto k = static_cast<std::size_t>(i);
      at[k] = s;
      value[k] = static_cast<double>(((image_.sample(p.x(), p.y()) - ca) * d).sum() / dd) - 0.5;
    }
    bool found = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      if (value[i] >= 0 || value[i + 1] < 0) continue;
      const double s = at[i] + (at[i + 1] - at[i]) * value[i] / (value[i] - value[i + 1]);
      if (!found || std::abs(s) < std::abs(along)) along = s;
      found = true;
    }
    return found;
  }

  // The rod's outline beside the middle of a cell: the colour leaves the ink for whatever is behind.
  void outline(int c, double side) {
    const RodModel::Section& section = rod_.middle(c);
    const Vec3d view = eye_ - section.centre;
    const double away = (view - section.tangent * view.dot(section.tangent)).norm();
    // Within about 25 degrees of the axis the outline is the tip's or the neighbour's.
    if (away < 0.42 * view.norm()) return;
    const double limb = std::acos(std::min(1.0, rod_.radius() / away));
    const Vec3d x = rod_.surface(section, eye_, side * limb);
    if (rod_.hides_itself(section, x, eye_)) return;
    Vec2d px, pc, pt;
    if (!pixel_of(x, px) || !pixel_of(section.centre, pc) || !pixel_of(x + section.tangent, pt)) return;
    const Vec2d edge = (pt - px).normalized();
    Vec2d normal(-edge.y(), edge.x());
    if (normal.dot(px - pc) < 0) normal = -normal;
    const double radius = normal.dot(px - pc);
    if (radius < 1.5) return;
    const Vec2d pa = px - 0.4 * radius * normal, pb = px + std::max(0.4 * radius, 1.5) * normal;
    if (!image_.contains(pa.x(), pa.y()) || !image_.contains(pb.x(), pb.y())) return;
    const Color ca = image_.sample(pa.x(), pa.y()), cb = image_.sample(pb.x(), pb.y());
    if (inks_.match(ca, rod_.ink(c)) != Inks::Match::agrees) return;
    if ((cb - ca).matrix().norm() < 40) return;
    double along;
    if (crossing(pa, px, pb, ca, cb, along)) set_.edges.push_back({pose_ * x, normal, along, false, c});
  }

  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  const Inks& inks_;
  const EigenPose& pose_;
  Vec3d eye_;  // Marker frame.
  EdgeSet& set_;
};

}  // namespace

void measure_edges(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                   const EigenPose& pose, CellRange range, EdgeSet& set) {
  set.edges.clear();
  set.expected_rings = 0;
  EdgeMeter meter(image, intrinsics, rod, inks, pose, set);
  meter.rings(range);
  meter.outlines(range);
}

}  // namespace onestroke

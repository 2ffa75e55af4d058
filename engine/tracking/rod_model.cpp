#include "tracking/rod_model.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace onestroke {

RodModel::RodModel(const MarkerSpec& spec)
    : radius_(spec.shape.radius()), pitch_(spec.shape.pitch()), shape_(spec.shape), has_roll_(spec.shape.has_roll()) {
  const int n = static_cast<int>(spec.cells.size());
  for (int i = 0; i < n; ++i) {
    inks_.push_back(static_cast<int>(spec.cells[static_cast<std::size_t>(i)]));
    middles_.push_back(section_at((i + 0.5) * pitch_));
  }
  for (int i = 0; i <= n; ++i) edges_.push_back(section_at(i * pitch_));
  find_arms(spec.shape.pieces());
  for (const Shape::Piece& p : spec.shape.pieces()) {
    const int parts = p.radius > 0 ? 4 : 1;
    for (int i = 0; i < parts; ++i) {
      const double s0 = p.start + p.length * i / parts, s1 = p.start + p.length * (i + 1) / parts;
      chords_.push_back(
          {to_eigen(spec.shape.at(s0).position), to_eigen(spec.shape.at(s1).position), s0, s1, parts == 1});
    }
  }
  Vec3d low = edges_.front().centre, high = low;
  for (const Section& e : edges_) {
    low = low.cwiseMin(e.centre);
    high = high.cwiseMax(e.centre);
  }
  centre_ = (low + high) / 2;
  for (const Section& e : edges_) bounding_radius_ = std::max(bounding_radius_, (e.centre - centre_).norm() + radius_);
  Mat3d spread = Mat3d::Zero();
  Vec3d mean = Vec3d::Zero();
  for (const Section& e : edges_) mean += e.centre / static_cast<double>(edges_.size());
  for (const Section& e : edges_) spread += (e.centre - mean) * (e.centre - mean).transpose();
  // Eigenvalues rise: the first direction is the one along which the centreline spreads least.
  plane_normal_ = Eigen::SelfAdjointEigenSolver<Mat3d>(spread).eigenvectors().col(0);
}

void RodModel::find_arms(const std::vector<Shape::Piece>& pieces) {
  arms_.assign(inks_.size(), -1);
  int arm = -1;
  const Shape::Piece* last = nullptr;
  for (const Shape::Piece& p : pieces) {
    if (p.radius > 0) continue;
    ++arm;
    for (std::size_t i = 0; i < arms_.size(); ++i)
      if (middles_[i].s >= p.start && middles_[i].s < p.start + p.length) arms_[i] = arm;
    if (last) {
      // A fillet of radius r between directions u and v: each tangent point lies r tan(angle / 2) from the corner.
      const double cosine = std::clamp(to_eigen(last->tangent).dot(to_eigen(p.tangent)), -1.0, 1.0);
      const double reach = shape_.bend_radius() * std::tan(std::acos(cosine) / 2);
      meetings_.push_back({last->start + last->length + reach, p.start - reach});
    }
    last = &p;
  }
}

RodModel::Section RodModel::section_at(double s) const {
  const CentrelinePoint p = shape_.at(s);
  return {s, to_eigen(p.position), to_eigen(p.tangent), to_eigen(shape_.cut_normal(s))};
}

Vec3d RodModel::surface(const Section& section, const Vec3d& eye, double phi, Vec3d* normal) const {
  const Vec3d view = eye - section.centre;
  const Vec3d& t = section.tangent;
  Vec3d front = view - t * view.dot(t);
  const double length = front.norm();
  // Looking straight down the axis no side faces the eye; any will do.
  front = length > 1e-9 ? Vec3d(front / length) : t.unitOrthogonal();
  const Vec3d out = std::cos(phi) * front + std::sin(phi) * t.cross(front);
  if (normal) *normal = out;
  const double slide = -radius_ * out.dot(section.cut) / t.dot(section.cut);
  return section.centre + radius_ * out + slide * t;
}

namespace {

// Shortest distance between segments a-b and c-d, squared (Ericson, Real-Time Collision Detection, 5.1.9).
double square_distance(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Vec3d u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-12 * uu * vv ? std::clamp((uv * vw - uw * vv) / det, 0.0, 1.0) : 0.0;
  double t = (uv * s + vw) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  }
  return (w + s * u - t * v).squaredNorm();
}

}  // namespace

// The rod passes nearer than `reach` to the line of sight.
bool RodModel::hides_within(const Section& section, const Vec3d& point, const Vec3d& eye, double reach) const {
  const Vec3d towards = (eye - point).normalized();
  const Vec3d far = point + 4 * bounding_radius_ * towards;
  for (const Chord& c : chords_) {
    // What is straight is convex, and a point of it that faces the eye is not behind it.
    if (c.straight && section.s > c.s0 && section.s < c.s1) continue;
    // The stretch near the point is convex seen from outside and cannot hide it.
    const double margin = 2 * radius_;
    double s0 = c.s0, s1 = c.s1;
    Vec3d a = c.a, b = c.b;
    if (section.s + margin > s0 && section.s - margin < s1) {
      if (section.s - s0 > s1 - section.s) {
        if (section.s - margin <= s0) continue;
        b = a + (b - a) * ((section.s - margin - s0) / (s1 - s0));
      } else {
        if (section.s + margin >= s1) continue;
        a = a + (b - a) * ((section.s + margin - s0) / (s1 - s0));
      }
    }
    if (square_distance(point + 0.5 * towards, far, a, b) < reach * reach) return true;
  }
  return false;
}

double pitch_in_pixels(const Intrinsics& k, const RodModel& rod, const EigenPose& pose) {
  return k.fx * rod.pitch() / std::max(1.0, (pose * rod.centre()).z());
}

}  // namespace onestroke

#include "tracking/pose_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <span>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// Numbers of pictures that are tried, each about half as many again as the one before.
constexpr std::array windows{1, 2, 3, 4, 6, 9, 14, 20, 30, 44, 64};
static_assert(windows.back() == PoseFilter::capacity);
// The share of a measurement's variance that others of its kind have in common with it; no mean does away with it.
constexpr double in_common = 0.9;
// The most that a longer mean may be off a shorter one: normalised error squared by the shorter one's covariance. As
// they have much in common, what stands still stays far below, and 6 degrees of freedom by themselves rarely exceed it.
constexpr double agreement = 12;

Vector6d difference(const Pose& to, const Pose& from) {
  const Vec3 w = log_so3(to.rotation * from.rotation.conjugate()), v = to.translation - from.translation;
  return {w.x, w.y, w.z, v.x, v.y, v.z};
}

Pose moved(const Pose& p, const Vector6d& d) {
  return {normalized(exp_so3({d[0], d[1], d[2]}) * p.rotation), p.translation + Vec3{d[3], d[4], d[5]}};
}

// Measurements of one kind, as offsets from one pose.
struct Sum {
  Matrix6d information = Matrix6d::Zero();
  Vector6d weighted = Vector6d::Zero(), mean = Vector6d::Zero();
  int count = 0;

  void add(const Vector6d& offset, const Matrix6d& its_information) {
    information += its_information;
    weighted += its_information * offset;
    ++count;
  }
  void average() {
    if (count > 0) mean = information.ldlt().solve(weighted);
  }
  bool agrees(const Sum& longer) const {
    const Vector6d d = longer.mean - mean;
    return count == 0 || d.dot(information * d) < agreement;
  }
  // Of the mean of n errors that have a share of their variance in common, against that of n independent ones.
  double discount() const { return 1 / (1 + in_common * std::max(0, count - 1)); }
};

// The two kinds of measurements of a run of pictures.
struct Run {
  Sum quick, sharp;

  bool agrees(const Run& longer) const { return quick.agrees(longer.quick) && sharp.agrees(longer.sharp); }
  PoseFilter::Estimate together(const Pose& origin) const {
    const double q = quick.discount(), s = sharp.discount();
    const Matrix6d information = q * quick.information + s * sharp.information;
    const Vector6d offset = information.ldlt().solve(q * quick.weighted + s * sharp.weighted);
    return {{moved(origin, offset), information.inverse()}, quick.count};
  }
};

}  // namespace

Matrix6d turned(const Matrix6d& covariance, Quat rotation) {
  const Mat3d R = to_eigen(Pose{rotation, {}}).R;
  Matrix6d c;
  for (const int i : {0, 3})
    for (const int j : {0, 3}) c.block<3, 3>(i, j) = R * covariance.block<3, 3>(i, j) * R.transpose();
  return c;
}

void PoseFilter::clear() {
  next_ = count_ = 0;
  estimate_ = {};
}

const PoseFilter::Estimate& PoseFilter::add(const PoseMeasurement& quick, const PoseMeasurement* sharp) {
  Sample& newest = samples_[static_cast<std::size_t>(next_)];
  newest = {quick.pose, quick.pose, quick.covariance.inverse(), Matrix6d::Zero(), sharp != nullptr};
  if (sharp) {
    newest.sharp = sharp->pose;
    newest.sharp_information = sharp->covariance.inverse();
  }
  next_ = (next_ + 1) % capacity;
  count_ = std::min(count_ + 1, capacity);
  estimate_ = {sharp ? *sharp : quick, 1};

  std::array<Run, windows.size()> runs;
  Run run;
  for (std::size_t k = 0; k < windows.size() && windows[k] <= count_; ++k) {
    for (int i = run.quick.count; i < windows[k]; ++i) {
      const Sample& s = back(i);
      if (!s.quick_information.allFinite() || !s.sharp_information.allFinite()) return estimate_;
      run.quick.add(difference(s.quick, quick.pose), s.quick_information);
      if (s.has_sharp) run.sharp.add(difference(s.sharp, quick.pose), s.sharp_information);
    }
    run.quick.average();
    run.sharp.average();
    const auto shorter = std::span(runs).first(k);
    if (!std::all_of(shorter.begin(), shorter.end(), [&](const Run& r) { return r.agrees(run); })) break;
    runs[k] = run;
    if (k > 0) estimate_ = run.together(quick.pose);
  }
  return estimate_;
}

}  // namespace onestroke

#include "tracking/line_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Growth = Eigen::Matrix<double, growths, 1>;

// Standard deviations of the growths, pixels.
constexpr double min_common_sigma = 0.02;
constexpr double ink_growth_sigma = 0.15, outline_growth_sigma = 0.05;

constexpr int reweightings = 3;
// Tukey's biweight at 95 % efficiency.
constexpr double cutoff = 4.7;

double tukey(double u) {
  if (std::abs(u) >= 1) return 0;
  const double v = 1 - u * u;
  return v * v;
}

// Derivative of an edge's offset by the perturbation of pose and velocity.
Vector12d derivative(const LineMeasurement& m) {
  Vector12d j;
  j.head<3>() = m.arm.cross(m.by_point);
  j.segment<3>(3) = m.by_point;
  j.tail<6>() = m.seconds * j.head<6>();
  return j;
}

// One pass's measurements, solved for N of the 12 unknowns and for the growths.
template <int N>
class Solver {
 public:
  static constexpr int all = N + growths;
  using Vector = Eigen::Matrix<double, all, 1>;
  using Matrix = Eigen::Matrix<double, all, all>;
  using Part = Eigen::Matrix<double, N, 1>;

  Solver(const LineSet& set, const Vector12d& prior_mean, const Vector12d& prior_information,
         std::vector<double>& scratch)
      : set_(set), scratch_(scratch) {
    mean_.template head<N>() = prior_mean.head<N>();
    information_.template head<N>() = prior_information.head<N>();
    information_.template segment<outline_growth>(N).setConstant(1 / (ink_growth_sigma * ink_growth_sigma));
    information_.template tail<growths - outline_growth>().setConstant(1 /
                                                                       (outline_growth_sigma * outline_growth_sigma));
  }

  bool solve() {
    gather();
    for (int i = 0; i < reweightings; ++i) {
      weigh();
      accumulate();
      if (ring_weight_ < 6) return false;
      delta_ = hessian_.ldlt().solve(gradient_);
      if (!delta_.allFinite()) return false;
    }
    return true;
  }

  const Vector& delta() const { return delta_; }
  double ring_weight() const { return ring_weight_; }
  /// Sums of the lines' weights, by the cell after the edge.
  const std::array<float, max_cells>& support() const { return support_; }
  double rms() const { return std::sqrt(ring_square_ / std::max(ring_weight_, 1e-9)); }
  Eigen::Matrix<double, N, N> covariance() const {
    // Growths and velocity have priors, so that only a pose may be badly determined.
    constexpr int rest = all - 6;
    const auto other = hessian_.template bottomRightCorner<rest, rest>().ldlt();
    const Eigen::Matrix<double, 6, rest> mixed = hessian_.template topRightCorner<6, rest>();
    const Eigen::Matrix<double, rest, 6> by_pose = other.solve(mixed.transpose());
    const Matrix6d pose = covariance_of(hessian_.template topLeftCorner<6, 6>() - mixed * by_pose);
    Eigen::Matrix<double, N, N> whole;
    whole.template topLeftCorner<6, 6>() = pose;
    if constexpr (N > 6) {
      constexpr int more = N - 6;
      const Eigen::Matrix<double, more, 6> moves = by_pose.template topRows<more>();
      const Eigen::Matrix<double, rest, rest> own = other.solve(Eigen::Matrix<double, rest, rest>::Identity());
      whole.template bottomRightCorner<more, more>() =
          own.template topLeftCorner<more, more>() + moves * pose * moves.transpose();
      whole.template bottomLeftCorner<more, 6>() = -moves * pose;
      whole.template topRightCorner<6, more>() = -pose * moves.transpose();
    }
    return whole;
  }

 private:
  // The lines of one ring edge, which follow one another, or those of the outline beside one cell.
  struct Group {
    std::size_t first, last;
    bool ring;
    double effect = 0;  // By which all of them are off alike, pixels.
    double weight = 1;
  };

  void gather() {
    groups_.clear();
    derivatives_.resize(set_.lines.size());
    for (std::size_t i = 0; i < derivatives_.size(); ++i) derivatives_[i] = derivative(set_.lines[i]).head<N>();
    for (std::size_t i = 0; i < set_.lines.size(); ++i) {
      const LineMeasurement& m = set_.lines[i];
      const bool same = i > 0 && set_.lines[i - 1].cell == m.cell && set_.lines[i - 1].ring() == m.ring();
      if (!same) groups_.push_back({i, i, m.ring()});
      groups_.back().last = i + 1;
    }
  }

  double residual(std::size_t i) const {
    const LineMeasurement& m = set_.lines[i];
    return m.offset - derivatives_[i].dot(delta_.template head<N>()) - m.by_growth * delta_[N + m.growth];
  }

  // Of what was gathered; there must be something.
  double median() {
    const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    return *middle;
  }

  // 1.4826 times the median of absolute values: the standard deviation, outliers aside.
  double spread() { return scratch_.empty() ? 0 : 1.4826 * median(); }

  void weigh() {
    residuals_.resize(set_.lines.size());
    for (std::size_t i = 0; i < residuals_.size(); ++i) residuals_[i] = residual(i);
    for (const bool ring : {true, false}) {
      for (Group& g : groups_)
        if (g.ring == ring) g.effect = median_effect(g);
      scratch_.clear();
      for (const Group& g : groups_)
        if (g.ring == ring) scratch_.push_back(std::abs(g.effect));
      Scatter& s = ring ? ring_ : outline_;
      s.common = std::max(min_common_sigma, spread());
      for (Group& g : groups_)
        if (g.ring == ring) g.weight = tukey(g.effect / (cutoff * s.common));
      scratch_.clear();
      for (const Group& g : groups_)
        if (g.ring == ring)
          for (std::size_t i = g.first; i < g.last; ++i) {
            const LineMeasurement& m = set_.lines[i];
            scratch_.push_back(std::abs(residuals_[i] - m.by_growth * g.effect) / m.sigma);
          }
      s.single = std::max(1.0, spread());
    }
  }

  double median_effect(const Group& g) {
    scratch_.clear();
    for (std::size_t i = g.first; i < g.last; ++i) scratch_.push_back(residuals_[i] / set_.lines[i].by_growth);
    return median();
  }

  void accumulate() {
    hessian_ = information_.asDiagonal();
    gradient_ = information_.cwiseProduct(mean_);
    ring_weight_ = ring_square_ = 0;
    support_.fill(0);
    for (const Group& g : groups_)
      if (g.weight > 0) add(g);
    hessian_ = hessian_.template selfadjointView<Eigen::Lower>();
  }

  // What a group is off by as a whole is one more unknown, normal about 0, eliminated here (Schur's complement).
  void add(const Group& g) {
    const Scatter& s = g.ring ? ring_ : outline_;
    Vector along = Vector::Zero();
    double square = 1 / (s.common * s.common), offset = 0;
    for (std::size_t i = g.first; i < g.last; ++i) {
      const LineMeasurement& m = set_.lines[i];
      const double sigma = m.sigma * s.single;
      const double w = g.weight * tukey((residuals_[i] - m.by_growth * g.effect) / (cutoff * sigma));
      if (w == 0) continue;
      const Part& j = derivatives_[i];
      const double iw = w / (sigma * sigma), by_growth = iw * m.by_growth;
      const int growth = N + m.growth;
      hessian_.template topLeftCorner<N, N>().template selfadjointView<Eigen::Lower>().rankUpdate(j, iw);
      hessian_.row(growth).template head<N>() += by_growth * j.transpose();
      hessian_(growth, growth) += by_growth * m.by_growth;
      gradient_.template head<N>() += iw * m.offset * j;
      gradient_[growth] += by_growth * m.offset;
      along.template head<N>() += by_growth * j;
      along[growth] += by_growth * m.by_growth;
      square += iw * m.by_growth * m.by_growth;
      offset += iw * m.by_growth * m.offset;
      if (!g.ring) continue;
      ring_weight_ += w;
      support_[static_cast<std::size_t>(m.cell)] += static_cast<float>(w);
      ring_square_ += w * residuals_[i] * residuals_[i];
    }
    hessian_.template selfadjointView<Eigen::Lower>().rankUpdate(along, -1 / square);
    gradient_ -= offset / square * along;
  }

  // Standard deviations: of what a group is off by as a whole, pixels, and of a single line in units of its own.
  struct Scatter {
    double common = 1, single = 1;
  };

  const LineSet& set_;
  std::vector<double>& scratch_;
  Vector mean_ = Vector::Zero(), information_ = Vector::Zero();
  Vector delta_ = Vector::Zero(), gradient_ = Vector::Zero();
  Matrix hessian_ = Matrix::Zero();
  Scatter ring_, outline_;
  std::vector<Group> groups_;
  std::vector<double> residuals_;
  std::vector<Part> derivatives_;
  double ring_weight_ = 0, ring_square_ = 0;
  std::array<float, max_cells> support_{};
};

}  // namespace

void take_velocity(const TimedView& view, const LineFit& fit, Detection& d) {
  if (!view.clock.rolls()) return;
  d.moving = true;
  d.angular = fit.motion.angular;
  d.linear = fit.motion.linear;
  d.velocity_covariance = fit.covariance.bottomRightCorner<6, 6>();
}

LineFit LineFitter::fit(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& start,
                        const VelocityPrior& prior, std::span<const LineOptions> passes) {
  LineFit fit;
  fit.motion = start;
  Vector12d information = Vector12d::Zero();
  information.segment<3>(6).setConstant(1 / (prior.angular * prior.angular));
  information.tail<3>().setConstant(1 / (prior.linear * prior.linear));
  const auto pass = [&]<int N>(std::integral_constant<int, N>) {
    Vector12d mean = Vector12d::Zero();
    mean.segment<3>(6) = start.angular - fit.motion.angular;
    mean.tail<3>() = start.linear - fit.motion.linear;
    Solver<N> solver(set_, mean, information, scratch_);
    if (!solver.solve()) return false;
    const auto& d = solver.delta();
    // A step of more than a quarter of a radian or 10 % of the distance is a step off the linear model.
    if (d.template head<3>().norm() > 0.25 || d.template segment<3>(3).norm() > 0.1 * fit.motion.pose.t.norm())
      return false;
    fit.motion.pose = perturbed(fit.motion.pose, d.template head<6>());
    if constexpr (N == 12) {
      fit.motion.angular += d.template segment<3>(6);
      fit.motion.linear += d.template segment<3>(9);
    }
    fit.covariance.topLeftCorner<N, N>() = solver.covariance();
    fit.support = solver.support();
    fit.supported = solver.ring_weight();
    fit.rms = solver.rms();
    return fit.motion.pose.t.z() > 10 && fit.covariance.allFinite();
  };
  for (const LineOptions& options : passes) {
    measure_lines(view, rod, inks, fit.motion, options, set_);
    fit.expected = set_.expected;
    fit.shown = set_.shown;
    const bool solved =
        view.clock.rolls() ? pass(std::integral_constant<int, 12>{}) : pass(std::integral_constant<int, 6>{});
    if (!solved) return fit;
  }
  for (std::size_t c = 0; c < fit.support.size(); ++c) {
    if (set_.expected_at[c] == 0) continue;
    ++fit.edges;
    fit.support[c] /= static_cast<float>(set_.expected_at[c]);
  }
  fit.valid = true;
  return fit;
}

}  // namespace onestroke

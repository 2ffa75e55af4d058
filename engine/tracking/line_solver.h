#pragma once

#include "tracking/line_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace onestroke::line_solver {

using Vector12d = Eigen::Matrix<double, 12, 1>;

// Standard deviations of the growths, pixels.
inline constexpr double min_common_sigma = 0.02;
inline constexpr double ink_growth_sigma = 0.15, outline_growth_sigma = 0.05;

// Tukey's biweight at 95 % efficiency.
inline constexpr double cutoff = 4.7;

inline double tukey(double u) {
  if (std::abs(u) >= 1) return 0;
  const double v = 1 - u * u;
  return v * v;
}

// The upper one of the middle values; there must be a value.
inline double median_of(std::span<double> v) {
  if (v.size() == 1) return v[0];
  if (v.size() == 2) return std::max(v[0], v[1]);
  if (v.size() == 3) return std::max(std::min(v[0], v[1]), std::min(std::max(v[0], v[1]), v[2]));
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

/// One pass's measurements, solved by robust least squares for N of the 12 unknowns of a motion, those of the pose
/// first, and for the growths: iteratively reweighted, each group of lines with an error in common. Borrows what it is
/// given.
template <int N>
class LineSolver {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  LineSolver(const LineSet& set, const Vector12d& prior_mean, const Matrix12d& prior_information, LineMemory& memory)
      : set_(set),
        memory_(memory),
        mean_(prior_mean.head<N>()),
        information_(prior_information.topLeftCorner<N, N>()) {}

  bool solve(int reweightings) {
    gather();
    for (int i = 0; i < reweightings; ++i) {
      weigh();
      accumulate();
      if (ring_weight_ < 6) return false;
      eliminate_growths();
      hessian_ = squares_.template topLeftCorner<N, N>();
      hessian_ += information_;
      const Eigen::LLT<Matrix, Eigen::Lower> factors(hessian_);
      if (factors.info() != Eigen::Success) return false;
      delta_ = factors.solve(squares_.row(at_offset).template head<N>().transpose() + information_ * mean_);
      if (!delta_.allFinite()) return false;
      tell_growths();
    }
    return true;
  }

  const Vector& delta() const { return delta_; }
  double ring_weight() const { return ring_weight_; }
  /// Sums of the lines' weights, by the cell after the edge.
  const std::array<float, max_cells>& support() const { return support_; }
  /// Root mean square of what the solution moves the lines by, pixels.
  double moved() const {
    double sum = 0;
    for (const LineMeasurement& m : set_.lines) {
      const double by = m.by_pose.dot(delta_.template head<6>());
      sum += by * by;
    }
    return std::sqrt(sum / std::max<double>(1, static_cast<double>(set_.lines.size())));
  }
  double rms() const { return std::sqrt(ring_square_ / std::max(ring_weight_, 1e-9)); }
  Matrix covariance() const {
    const Matrix information = hessian_.template selfadjointView<Eigen::Lower>();
    if constexpr (N == 6) {
      return covariance_of(information);
    } else {
      // A velocity has a prior, so that only a pose may be badly determined.
      constexpr int rest = N - 6;
      const auto other = information.template bottomRightCorner<rest, rest>().llt();
      const Eigen::Matrix<double, 6, rest> mixed = information.template topRightCorner<6, rest>();
      const Eigen::Matrix<double, rest, 6> moves = other.solve(mixed.transpose());
      const Matrix6d pose = covariance_of(information.template topLeftCorner<6, 6>() - mixed * moves);
      Matrix whole;
      whole.template topLeftCorner<6, 6>() = pose;
      whole.template bottomRightCorner<rest, rest>() =
          other.solve(Eigen::Matrix<double, rest, rest>::Identity()) + moves * pose * moves.transpose();
      whole.template bottomLeftCorner<rest, 6>() = -moves * pose;
      whole.template topRightCorner<6, rest>() = -pose * moves.transpose();
      return whole;
    }
  }

 private:
  using Group = LineMemory::Group;
  // Standard deviations: of what a group is off by as a whole, pixels, and of a single line in units of its own.
  struct Scatter {
    double common = 1, single = 1;
  };

  // A line as a row of the system: the derivatives of its offset by the unknowns, the offset, and by_growth.
  static constexpr int width = N + 2, at_offset = N, at_growth = N + 1;
  using Row = Eigen::Matrix<double, width, 1>;

  Row row(std::size_t i) const { return Eigen::Map<const Row>(memory_.rows.data() + i * width); }

  void gather() {
    memory_.groups.clear();
    memory_.rows.resize(set_.lines.size() * width);
    for (std::size_t i = 0; i < set_.lines.size(); ++i) {
      const LineMeasurement& m = set_.lines[i];
      Eigen::Map<Row> r(memory_.rows.data() + i * width);
      r.template head<6>() = m.by_pose;
      if constexpr (N == 12) r.template segment<6>(6) = m.seconds * m.by_pose;
      r[at_offset] = m.offset;
      r[at_growth] = m.by_growth;
      const bool same = i > 0 && set_.lines[i - 1].cell == m.cell && set_.lines[i - 1].ring() == m.ring();
      if (!same) memory_.groups.push_back({i, i, m.ring()});
      memory_.groups.back().last = i + 1;
    }
  }

  double residual(std::size_t i) const {
    const Row r = row(i);
    return r[at_offset] - r.template head<N>().dot(delta_) -
           r[at_growth] * grown_[static_cast<std::size_t>(set_.lines[i].growth)];
  }

  // 1.4826 times the median of absolute values: the standard deviation, outliers aside.
  static double spread(std::span<double> values) { return values.empty() ? 0 : 1.4826 * median_of(values); }

  void weigh() {
    const std::size_t count = set_.lines.size();
    memory_.residuals.resize(count);
    memory_.scratch.resize(count);
    for (std::size_t i = 0; i < count; ++i) memory_.residuals[i] = residual(i);
    // Ring edges come before the outline.
    const auto outline =
        std::find_if(memory_.groups.begin(), memory_.groups.end(), [](const Group& g) { return !g.ring; });
    weigh({memory_.groups.begin(), outline}, ring_);
    weigh({outline, memory_.groups.end()}, outline_);
  }

  void weigh(std::span<Group> groups, Scatter& s) {
    double* const scratch = memory_.scratch.data();
    for (Group& g : groups) g.effect = median_effect(g);
    std::size_t n = 0;
    for (const Group& g : groups) scratch[n++] = std::abs(g.effect);
    s.common = std::max(min_common_sigma, spread({scratch, n}));
    n = 0;
    for (Group& g : groups) {
      g.weight = tukey(g.effect / (cutoff * s.common));
      for (std::size_t i = g.first; i < g.last; ++i) {
        const LineMeasurement& m = set_.lines[i];
        scratch[n++] = std::abs(memory_.residuals[i] - m.by_growth * g.effect) / m.sigma;
      }
    }
    s.single = std::max(1.0, spread({scratch, n}));
  }

  double median_effect(const Group& g) {
    double* const scratch = memory_.scratch.data();
    std::size_t n = 0;
    for (std::size_t i = g.first; i < g.last; ++i) scratch[n++] = memory_.residuals[i] / set_.lines[i].by_growth;
    return median_of({scratch, n});
  }

  void accumulate() {
    squares_.setZero();
    by_growth_.setZero();
    growth_.setZero();
    ring_weight_ = ring_square_ = 0;
    support_.fill(0);
    for (const Group& g : memory_.groups)
      if (g.weight > 0) add(g);
  }

  // Cholesky's steps for the growths, which come first: each is tied to no other growth but that of the outline's other
  // side. What is left is the system of the motion.
  void eliminate_growths() {
    for (int g = 0; g < growths; ++g) {
      const double sigma = g < outline_growth ? ink_growth_sigma : outline_growth_sigma;
      growth_(g, g) += 1 / (sigma * sigma);
    }
    for (int g = 0; g < growths; ++g) {
      const Row column = by_growth_.col(g), share = column / growth_(g, g);
      add_squares(-share, column);
      if (g < outline_growth || (g - outline_growth) % 2 == 1) continue;
      const double tie = growth_(g + 1, g) / growth_(g, g);
      by_growth_.col(g + 1) -= tie * column;
      growth_(g + 1, g + 1) -= tie * growth_(g + 1, g);
    }
  }

  // The growths that go with the motion.
  void tell_growths() {
    for (int g = growths - 1; g >= 0; --g) {
      const auto column = by_growth_.col(g);
      double sum = column[at_offset] - column.template head<N>().dot(delta_);
      if (g >= outline_growth && (g - outline_growth) % 2 == 0)
        sum -= growth_(g + 1, g) * grown_[static_cast<std::size_t>(g) + 1];
      grown_[static_cast<std::size_t>(g)] = sum / growth_(g, g);
    }
  }

  // Adds a times b's transpose to the lower triangle of the squares, by pairs of columns.
  void add_squares(const Row& a, const Row& b) {
    const auto add_pair = [&]<int C>(std::integral_constant<int, C>) {
      squares_.col(C).template tail<width - C>() += b[C] * a.template tail<width - C>();
      squares_.col(C + 1).template tail<width - C>() += b[C + 1] * a.template tail<width - C>();
    };
    [&]<int... C>(std::integer_sequence<int, C...>) {
      (add_pair(std::integral_constant<int, 2 * C>{}), ...);
    }
    (std::make_integer_sequence<int, width / 2>{});
  }

  // What a group is off by as a whole is one more unknown, normal about 0, eliminated here (Schur's complement).
  void add(const Group& g) {
    const Scatter& s = g.ring ? ring_ : outline_;
    // A ring edge has one pair of inks, the outline beside a cell two sides: what their lines say by their growth.
    Row along = Row::Zero(), second = Row::Zero();
    const int growth = set_.lines[g.first].growth;
    const int low = g.ring ? growth : growth - (growth - outline_growth) % 2;
    for (std::size_t i = g.first; i < g.last; ++i) {
      const LineMeasurement& m = set_.lines[i];
      const double sigma = m.sigma * s.single, residual = memory_.residuals[i];
      const double w = g.weight * tukey((residual - m.by_growth * g.effect) / (cutoff * sigma));
      if (w == 0) continue;
      const Row r = row(i), weighted = w / (sigma * sigma) * r;
      add_squares(weighted, r);
      along += m.by_growth * weighted;
      if (m.growth != low) second += m.by_growth * weighted;
      if (!g.ring) continue;
      ring_weight_ += w;
      support_[static_cast<std::size_t>(m.cell)] += static_cast<float>(w);
      ring_square_ += w * residual * residual;
    }
    const double whole = along[at_growth] + 1 / (s.common * s.common);
    const Row share = along / whole;
    add_squares(-share, along);
    add_side(low, along - second, share, whole);
    if (g.ring) return;
    add_side(low + 1, second, share, whole);
    growth_(low + 1, low) -= (along - second)[at_growth] * second[at_growth] / whole;
  }

  void add_side(int growth, const Row& side, const Row& share, double whole) {
    const double own = side[at_growth];
    by_growth_.col(growth) += side - own * share;
    growth_(growth, growth) += own - own * own / whole;
  }

  const LineSet& set_;
  LineMemory& memory_;
  const Vector mean_;
  const Matrix information_;
  Vector delta_ = Vector::Zero();
  std::array<double, growths> grown_{};
  Matrix hessian_ = Matrix::Zero();  // Lower triangle.
  Scatter ring_, outline_;
  // Sums of the rows' squares (lower triangle), and of the rows by each growth and of the growths alone; then the same
  // as it is left by the elimination.
  Eigen::Matrix<double, width, width> squares_;
  Eigen::Matrix<double, width, growths> by_growth_;
  Eigen::Matrix<double, growths, growths> growth_;
  double ring_weight_ = 0, ring_square_ = 0;
  std::array<float, max_cells> support_{};
};

}  // namespace onestroke::line_solver

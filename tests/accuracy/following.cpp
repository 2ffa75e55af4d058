#include "following.h"

#include "film.h"
#include "score.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke::accuracy {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int settling = 30;  // Pictures.
constexpr Vec3 middle{24, -24, 0};

double square(Vec3 v) {
  return dot(v, v);
}

Vec3 turn(const Pose& to, const Pose& from) {
  return log_so3(to.rotation * from.rotation.conjugate());
}

double normalised_error(const MarkerObservation& o, const Pose& truth) {
  const Vec3 w = turn(truth, o.T_camera_marker), v = truth.translation - o.T_camera_marker.translation;
  const Eigen::Vector<double, 6> e{w.x, w.y, w.z, v.x, v.y, v.z};
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(o.covariance.data());
  return e.dot(covariance.ldlt().solve(e));
}

}  // namespace

Stillness watch_still(int id, Quat rotation, double distance, int pictures) {
  const Pose truth = about_middle(rotation, {0, 0, distance});
  Film film;
  for (int i = 0; i < settling; ++i) film.take(id, truth);
  Stillness s;
  s.pictures = pictures;
  Pose before;
  std::vector<Vec3> turns, shifts;
  std::vector<double> nees, ms;
  for (int i = 0; i < pictures; ++i) {
    ms.push_back(film.take(id, truth).cost.ms());
    const MarkerObservation* o = film.find(id);
    if (!o || o->state != MarkerState::measured) continue;
    if (++s.measured > 1) s.step_deg = std::max(s.step_deg, turn_deg(before, o->T_camera_marker));
    before = o->T_camera_marker;
    turns.push_back(turn(o->T_camera_marker, truth));
    shifts.push_back(o->T_camera_marker * middle - truth * middle);
    nees.push_back(normalised_error(*o, truth));
  }
  const auto mean_of = [](const std::vector<Vec3>& values) {
    Vec3 sum;
    for (const Vec3& v : values) sum = sum + v;
    return sum / static_cast<double>(values.size());
  };
  const auto deviation = [&](const std::vector<Vec3>& values) {
    double sum = 0;
    for (const Vec3& v : values) sum += square(v - mean_of(values));
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
  };
  s.turn_deg = deviation(turns) / degree;
  s.shift_mm = deviation(shifts);
  s.bias_deg = norm(mean_of(turns)) / degree;
  s.nees = quantile(nees, 0.5);
  s.ms = quantile(ms, 0.5);
  return s;
}

Lag watch_moving(int id, const std::function<Pose(double)>& T_camera_marker, double seconds, double pictures_a_second) {
  Film film(pictures_a_second);
  Lag lag;
  std::vector<double> nees;
  // An error that is a lag of h is -h times the velocity.
  double turn_error = 0, turn_speed = 0, shift_error = 0, shift_speed = 0, turn_square = 0, shift_square = 0;
  while (film.time() < seconds) {
    const double t = film.time();
    constexpr double h = 1e-4;
    const Pose truth = T_camera_marker(t), earlier = T_camera_marker(t - h), later = T_camera_marker(t + h);
    film.take(id, truth);
    ++lag.pictures;
    const MarkerObservation* o = film.find(id);
    if (!o || o->state != MarkerState::measured) continue;
    ++lag.measured;
    const Vec3 w = turn(later, earlier) / (2 * h), v = (later * middle - earlier * middle) / (2 * h);
    const Vec3 off = turn(o->T_camera_marker, truth), away = o->T_camera_marker * middle - truth * middle;
    turn_error -= dot(off, w);
    turn_speed += square(w);
    shift_error -= dot(away, v);
    shift_speed += square(v);
    turn_square += square(off);
    shift_square += square(away);
    nees.push_back(normalised_error(*o, truth));
    lag.worst_deg = std::max(lag.worst_deg, norm(off) / degree);
  }
  lag.turn_ms = turn_speed > 0 ? 1e3 * turn_error / turn_speed : 0;
  lag.shift_ms = shift_speed > 0 ? 1e3 * shift_error / shift_speed : 0;
  lag.turn_deg = std::sqrt(turn_square / lag.measured) / degree;
  lag.shift_mm = std::sqrt(shift_square / lag.measured);
  lag.nees = quantile(nees, 0.5);
  return lag;
}

}  // namespace onestroke::accuracy

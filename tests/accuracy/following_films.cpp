#include "following_films.h"

#include "film.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace onestroke::accuracy {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double distance = 500;

Quat turned(double x_deg, double y_deg, double z_deg) {
  return from_euler_xyz(x_deg * degree, y_deg * degree, z_deg * degree);
}

// From where it stands, turned by an angle about an axis and moved with it to the side.
std::function<Pose(double)> along(Vec3 axis, double mm_a_radian, const std::function<double(double)>& angle) {
  return [=](double t) {
    const double a = angle(t);
    return about_middle(exp_so3(a * axis) * turned(25, -20, 15), {mm_a_radian * a, 0, distance});
  };
}

MovingFilm swing(double hertz, double amplitude_deg) {
  std::ostringstream name;
  name << "swings by " << amplitude_deg << " degrees at " << hertz << " Hz";
  return {name.str(), 3,
          along(normalized(Vec3{0.3, 0.8, 0.5}), 100,
                [=](double t) { return amplitude_deg * degree * std::sin(2 * std::numbers::pi * hertz * t); }),
          3, 1};
}

// All the way round about an axis of the picture's plane: both arms point at the camera on the way.
MovingFilm turn_round(int id, double deg_a_second) {
  std::ostringstream name;
  name << "turns round at " << deg_a_second << " degrees/s, " << (id % 2 ? "sharp" : "bent");
  return {name.str(),
          id,
          [=](double t) {
            return about_middle(exp_so3(deg_a_second * degree * t * normalized(Vec3{0.6, 1, 0})) * turned(0, 0, 20),
                                {40 * std::sin(t), 0, distance});
          },
          360 / deg_a_second,
          1,
          0.35};
}

// So slow that noise hides the motion from picture to picture.
MovingFilm creep(int id, double deg_a_second, double seconds, double max_lag_ms) {
  std::ostringstream name;
  name << "creeps at " << deg_a_second << " degrees/s";
  return {name.str(), id,
          along(normalized(Vec3{0.2, 1, 0.3}), 100, [=](double t) { return deg_a_second * degree * t; }), seconds,
          max_lag_ms};
}

}  // namespace

std::vector<StillFilm> still_films() {
  return {{"squarely, sharp", 3, {}},
          {"squarely, bent", 4, {}},
          {"squarely, turned by 45 degrees", 3, turned(0, 0, 45)},
          {"squarely from behind", 4, turned(180, 0, 20)},
          {"tilted by 30 degrees about x", 3, turned(30, 0, 0)},
          {"tilted by 45 degrees about y", 4, turned(0, 45, 10)},
          {"tilted about all axes", 3, turned(25, -20, 40)},
          {"one arm at 70 degrees to the picture", 4, turned(70, 0, 30)}};
}

std::vector<MovingFilm> moving_films() {
  return {
      {"turns at 60 degrees/s", 3, along({0, 0, 1}, 0, [](double t) { return 60 * degree * t; }), 2, 1},
      creep(3, 0.2, 4, 60),
      creep(3, 1, 3, 5),
      creep(4, 5, 2, 3),
      swing(0.5, 15),
      swing(1, 15),
      swing(2, 10),
      swing(1, 1),
      turn_round(3, 90),
      turn_round(4, 90),
      turn_round(3, 45),
      {"sets off after 1 s to 40 degrees/s and stops after 2 s", 3,
       along(normalized(Vec3{0.2, 1, 0.3}), 100, [](double t) { return 40 * degree * std::clamp(t - 1, 0.0, 1.0); }), 3,
       1}};
}

}  // namespace onestroke::accuracy

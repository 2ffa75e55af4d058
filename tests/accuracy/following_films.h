#pragma once

#include "following.h"

namespace onestroke::accuracy {

struct StillFilm {
  std::string name;
  int id;
  Quat rotation;
};
/// Sharp and bent markers in several orientations, those that face the camera squarely among them.
std::vector<StillFilm> still_films();

struct MovingFilm {
  std::string name;
  int id;
  std::function<Pose(double)> path;  ///< T_camera_marker by seconds.
  double seconds;
  double max_lag_ms;            ///< What the pictures' noise leaves to be told, and no visible delay.
  double max_worst_deg = 0.25;  ///< Of all pictures; an arm that points at the camera tells less.
};
/// A stick that turns evenly, creeps, swings at 0.5 to 2 Hz, turns all the way round, sets off and stops.
std::vector<MovingFilm> moving_films();

}  // namespace onestroke::accuracy

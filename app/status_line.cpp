#include "app/status_line.h"

namespace onestroke {

std::string_view StatusLine::update(const FrameFigures& figures) {
  if (rates_)
    line_.print("Tracker %.1f ms · %.0f pictures/s · %.0f frames/s · %llu pictures left out", figures.tracker_ms,
                figures.pictures_a_second, figures.frames_a_second, static_cast<unsigned long long>(figures.left_out));
  else
    line_.print("Tracker %.1f ms a picture", figures.tracker_ms);
  return line_.view();
}

}  // namespace onestroke

// following_table: how still a marker stands that is followed, and how late one is that moves, as Markdown tables.

#include "following_films.h"

#include <iomanip>
#include <iostream>

int main() {
  using namespace onestroke::accuracy;
  std::cout << std::fixed
            << "| still, 500 mm | measured | rotation, degrees | place, mm | largest step, degrees | bias, degrees "
               "| normalised error squared (median) | ms a picture (median) |\n|---|---|---|---|---|---|---|---|\n";
  for (const StillFilm& film : still_films()) {
    const Stillness s = watch_still(film.id, film.rotation);
    std::cout << "| " << film.name << " | " << s.measured << " of " << s.pictures << std::setprecision(4) << " | "
              << s.turn_deg << " | " << s.shift_mm << " | " << s.step_deg << " | " << s.bias_deg << " | "
              << std::setprecision(2) << s.nees << " | " << s.ms << " |\n"
              << std::flush;
  }
  std::cout << "\n| moving, 500 mm | measured | late by (rotation, ms) | late by (place, ms) | rotation error, degrees "
               "(RMS / "
               "max) | place error, mm (RMS) | normalised error squared (median) |\n|---|---|---|---|---|---|---|\n";
  for (const MovingFilm& film : moving_films()) {
    const Lag l = watch_moving(film.id, film.path, film.seconds);
    std::cout << "| " << film.name << " | " << l.measured << " of " << l.pictures << std::setprecision(2) << " | "
              << l.turn_ms << " | " << l.shift_ms << std::setprecision(3) << " | " << l.turn_deg << " / " << l.worst_deg
              << " | " << l.shift_mm << " | " << l.nees << " |\n"
              << std::flush;
  }
}

// draw_marker FOLDER: writes picture.ppm, catalog.json and truth.txt ("fov id x y z", degrees and millimetres).

#include "held_marker.h"

#include <fstream>
#include <iostream>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string folder = std::string(arguments[1]) + "/";
  const onestroke::test::HeldMarker scene{};
  const onestroke::SyntheticImage& image = scene.image;

  std::ofstream picture(folder + "picture.ppm", std::ios::binary);
  picture << "P6\n" << image.width << ' ' << image.height << "\n255\n";
  picture.write(reinterpret_cast<const char*>(image.rgb.data()), static_cast<std::streamsize>(image.rgb.size()));
  std::ofstream catalog(folder + "catalog.json");
  catalog << to_json(scene.catalog);
  std::ofstream truth(folder + "truth.txt");
  const onestroke::Vec3 t = scene.T_camera_marker.translation;
  truth << scene.fov_deg << ' ' << scene.held.id << ' ' << t.x << ' ' << t.y << ' ' << t.z << '\n';
  if (picture.flush() && catalog.flush() && truth.flush()) return 0;
  std::cerr << "draw_marker: cannot write into " << folder << '\n';
  return 1;
}

// example CATALOG.json PICTURE.ppm FOV: prints the markers in a picture (P6, no comments) of a lens of FOV degrees.

#include <onestroke/onestroke.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

int main(int count, char** arguments) try {
  if (count != 4) throw std::runtime_error("usage: example CATALOG.json PICTURE.ppm FOV");
  onestroke::CameraPicture picture;
  std::ifstream file(arguments[2], std::ios::binary);
  std::string kind;
  int brightest = 0;
  file >> kind >> picture.width >> picture.height >> brightest;
  if (!file || kind != "P6" || brightest != 255) throw std::runtime_error("not a PPM picture");
  file.get();
  picture.stride = 3 * static_cast<std::size_t>(picture.width);
  std::vector<char> pixels(picture.stride * static_cast<std::size_t>(picture.height));
  if (!file.read(pixels.data(), static_cast<std::streamsize>(pixels.size()))) throw std::runtime_error("it ends early");
  picture.data = reinterpret_cast<const std::uint8_t*>(pixels.data());

  auto tracker = onestroke::MarkerTracker::from_file(arguments[1], {.horizontal_fov_deg = std::stod(arguments[3])});
  for (const onestroke::TrackedMarker& marker : tracker.process(picture).markers) {
    const auto [x, y, z] = marker.translation_mm;
    std::printf("%d %s %.2f %.2f %.2f\n", marker.id, std::string(marker.name).c_str(), x, y, z);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "example: %s\n", error.what());
  return 1;
}

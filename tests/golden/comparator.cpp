#include "golden/comparator.h"

#include "core/error.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>

namespace onestroke::golden {

namespace {

int difference_at(const Picture& a, const Picture& b, int x, int y) {
  int worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
  return worst;
}

void paint(std::uint8_t* to, const std::uint8_t* expected, int difference, bool differs) {
  const int grey = (expected[0] + expected[1] + expected[2]) / 9;
  to[0] = static_cast<std::uint8_t>(differs ? std::min(255, 100 + 4 * difference) : grey);
  to[1] = to[2] = static_cast<std::uint8_t>(differs ? 0 : grey);
}

std::string size_of(const Picture& p) {
  return std::to_string(p.width) + " x " + std::to_string(p.height);
}

}  // namespace

Picture from_rgba(int width, int height, std::span<const std::uint8_t> rgba) {
  Picture p{width, height, {}};
  p.rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) p.rgb.insert(p.rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return p;
}

Picture read_png(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto check = [&](int good) {
    if (!good) throw Error("cannot read " + file.string() + ": " + image.message);
  };
  check(png_image_begin_read_from_file(&image, file.c_str()));
  image.format = PNG_FORMAT_RGB;
  Picture p{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  p.rgb.resize(PNG_IMAGE_SIZE(image));
  check(png_image_finish_read(&image, nullptr, p.rgb.data(), 0, nullptr));
  return p;
}

void write_png(const std::filesystem::path& file, const Picture& p) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(p.width);
  image.height = static_cast<png_uint_32>(p.height);
  image.format = PNG_FORMAT_RGB;
  std::filesystem::create_directories(file.parent_path());
  if (!png_image_write_to_file(&image, file.c_str(), 0, p.rgb.data(), 0, nullptr))
    throw Error("cannot write " + file.string() + ": " + image.message);
}

Comparison compare(const Picture& expected, const Picture& actual, Tolerance tolerance) {
  Comparison result;
  if (expected.width != actual.width || expected.height != actual.height) {
    result.differing = actual.width * actual.height;
    result.words = "the size is " + size_of(actual) + " instead of " + size_of(expected);
    return result;
  }
  result.difference = {expected.width, expected.height, std::vector<std::uint8_t>(expected.rgb.size())};
  for (int y = 0; y < expected.height; ++y)
    for (int x = 0; x < expected.width; ++x) {
      const int difference = difference_at(expected, actual, x, y);
      result.worst = std::max(result.worst, difference);
      result.differing += difference > tolerance.level;
      paint(result.difference.at(x, y), expected.at(x, y), difference, difference > tolerance.level);
    }
  result.same = result.differing <= tolerance.pixels;
  result.words = std::to_string(result.differing) + " pixels are off by more than " + std::to_string(tolerance.level) +
                 " levels (" + std::to_string(tolerance.pixels) + " may be), the worst by " +
                 std::to_string(result.worst);
  return result;
}

}  // namespace onestroke::golden

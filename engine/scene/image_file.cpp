#include "scene/image_file.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace onestroke {

namespace {

// A texture larger than this is damage, or more than any device takes.
constexpr int most_pixels_a_side = 16384;

}  // namespace

std::string decode_image(std::span<const std::uint8_t> bytes, ModelImage& image) {
  const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), std::numeric_limits<int>::max()));
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) return "is neither PNG nor JPEG";
  if (width > most_pixels_a_side || height > most_pixels_a_side)
    return "is larger than " + std::to_string(most_pixels_a_side) + " pixels";
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) return "is damaged";
  image.width = width;
  image.height = height;
  image.rgba.assign(pixels.get(),
                    pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return {};
}

}  // namespace onestroke

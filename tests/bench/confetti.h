#pragma once

#include <cstdint>
#include <vector>

namespace onestroke::bench {

/// Scatters some hundreds of brightly coloured scraps over a picture (packed RGB), the same ones each time, but not
/// where it differs from `empty`, the same picture without its markers.
void scatter_confetti(std::vector<std::uint8_t>& rgb, const std::vector<std::uint8_t>& empty, int width, int height);

}  // namespace onestroke::bench

#include "camera/room_paint.h"

#include "camera/sensor.h"

#include <algorithm>
#include <cmath>

namespace onestroke::room_paint {
namespace {

float lattice(int x, int y) {
  const std::uint64_t key =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
  return static_cast<float>(scramble(key) >> 40) * 0x1p-24f;
}

float smooth(float u) {
  return u * u * (3 - 2 * u);
}

float part(float v) {
  return v - std::floor(v);
}

bool between(float v, float a, float b) {
  return v >= a && v < b;
}

}  // namespace

float noise(float x, float y) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const float u = smooth(x - fx), v = smooth(y - fy);
  const float top = lattice(ix, iy) + u * (lattice(ix + 1, iy) - lattice(ix, iy));
  const float low = lattice(ix, iy + 1) + u * (lattice(ix + 1, iy + 1) - lattice(ix, iy + 1));
  return top + v * (low - top);
}

float rough(float x, float y) {
  return 0.57f * noise(x, y) + 0.29f * noise(2.03f * x + 17, 2.03f * y + 5) +
         0.14f * noise(4.1f * x + 3, 4.1f * y + 31);
}

Linear wood(float x, float z) {
  constexpr float board = 140;
  const float index = std::floor(z / board);
  const float tone = lattice(static_cast<int>(index), 71);
  const float along = x + 900 * tone, across = z - board * index;
  const float rings =
      across / 9 + 5 * rough(along / 420, across / 60 + 13 * tone) + 0.6f * rough(along / 60, across / 3);
  const float ring = 0.5f + 0.5f * std::sin(6.2832f * part(rings));
  const float fibre = rough(along / 90, across / 1.3f);
  const Linear light{0.42f, 0.245f, 0.115f}, dark{0.22f, 0.112f, 0.046f};
  const Linear grain = (0.72f + 0.45f * tone) * mix(light, dark, 0.55f * ring + 0.45f * fibre);
  return across < 1.5f ? 0.35f * grain : grain;
}

Linear outdoors(float u, float v) {
  const Linear sky = mix({0.75f, 1.05f, 1.65f}, {1.5f, 1.6f, 1.75f}, std::min(1.0f, 1.6f * v));
  const float cloud = std::clamp(2.6f * (rough(3.2f * u + 2, 5 * v) - 0.42f), 0.0f, 1.0f);
  const float ridge = 0.68f + 0.10f * rough(5 * u, 1) - 0.05f;
  if (v < ridge) return mix(sky, {2.1f, 2.1f, 2.1f}, cloud);
  const float leaf = rough(26 * u, 26 * v);
  return mix({0.05f, 0.13f, 0.03f}, {0.45f, 0.72f, 0.18f}, leaf * leaf * 1.2f);
}

Linear poster(float u, float v) {
  const Linear paper{0.72f, 0.66f, 0.52f};
  if (!between(u, 0.06f, 0.94f) || !between(v, 0.05f, 0.95f)) return paper;
  const auto disc = [&](float x, float y, float r) { return (u - x) * (u - x) + 0.9f * (v - y) * (v - y) < r * r; };
  if (disc(0.62f, 0.30f, 0.17f)) return {0.70f, 0.10f, 0.05f};
  if (disc(0.33f, 0.62f, 0.11f)) return {0.80f, 0.50f, 0.05f};
  if (v > 0.55f + 0.35f * std::abs(u - 0.55f))
    return v > 0.8f ? Linear{0.03f, 0.07f, 0.22f} : Linear{0.04f, 0.22f, 0.30f};
  if (v > 0.35f + 0.5f * std::abs(u - 0.28f)) return {0.06f, 0.30f, 0.12f};
  if (between(part(8 * u + 5 * v), 0.0f, 0.14f)) return {0.55f, 0.32f, 0.30f};
  return mix({0.62f, 0.50f, 0.36f}, {0.30f, 0.48f, 0.52f}, 1 - v);
}

Linear screen(float u, float v) {
  if (v > 0.93f) {  // icon bar
    const float icon = part(u * 18);
    const int kind = static_cast<int>(u * 18) % 3;
    const Linear icons[3] = {{0.75f, 0.08f, 0.07f}, {0.06f, 0.55f, 0.16f}, {0.07f, 0.22f, 0.85f}};
    return between(u, 0.2f, 0.8f) && between(icon, 0.25f, 0.75f) && between(v, 0.945f, 0.985f)
               ? icons[kind]
               : Linear{0.03f, 0.03f, 0.05f};
  }
  if (between(u, 0.05f, 0.52f) && between(v, 0.08f, 0.86f)) {  // a text editor
    if (v < 0.13f) return {0.20f, 0.21f, 0.25f};
    const float line = (v - 0.15f) * 36;
    const float length = 0.1f + 0.33f * lattice(static_cast<int>(line), 5);
    const float indent = 0.03f * static_cast<float>(static_cast<int>(line) % 3);
    const bool ink = between(part(line), 0.3f, 0.68f) && between(u, 0.08f + indent, 0.08f + length) &&
                     noise(u * 160, std::floor(line)) > 0.35f;
    const float hue = lattice(static_cast<int>(u * 14), static_cast<int>(line));
    const Linear text = hue < 0.5f    ? Linear{0.55f, 0.58f, 0.6f}
                        : hue < 0.75f ? Linear{0.15f, 0.55f, 0.8f}
                                      : Linear{0.8f, 0.45f, 0.1f};
    return ink ? text : Linear{0.022f, 0.025f, 0.034f};
  }
  if (between(u, 0.56f, 0.95f) && between(v, 0.12f, 0.66f)) {  // a chart on white
    if (v < 0.17f) return {0.35f, 0.36f, 0.38f};
    const float bar = (u - 0.60f) / 0.32f * 8;
    const int index = static_cast<int>(bar);
    const float top = 0.60f - 0.34f * lattice(index, 9);
    const Linear bars[3] = {{0.70f, 0.12f, 0.10f}, {0.12f, 0.50f, 0.22f}, {0.10f, 0.22f, 0.65f}};
    if (between(bar, 0, 8) && between(part(bar), 0.2f, 0.8f) && between(v, top, 0.60f)) return bars[index % 3];
    return {0.72f, 0.73f, 0.75f};
  }
  const float swirl = rough(3 * u, 3 * v);
  return mix({0.04f, 0.10f, 0.32f}, {0.38f, 0.14f, 0.36f}, swirl);
}

Linear curtain(float x, float y) {
  const float fold = 0.5f + 0.5f * std::sin(x / 13 + 1.5f * noise(x / 60, y / 400));
  return (0.35f + 0.65f * fold) * Linear{0.50f, 0.30f, 0.22f};
}

Linear keyboard(float u, float v) {
  const float row = v * 5, key = u * 15 + 0.25f * std::floor(row);
  const bool cap = between(part(key), 0.1f, 0.9f) && between(part(row), 0.12f, 0.88f);
  return cap ? Linear{0.085f, 0.088f, 0.095f} : Linear{0.02f, 0.02f, 0.022f};
}

Linear plaster(float x, float y) {
  const float tone = 0.93f + 0.10f * rough(x / 260, y / 260) + 0.05f * noise(x / 9, y / 9);
  return tone * Linear{0.66f, 0.61f, 0.53f};
}

}  // namespace onestroke::room_paint

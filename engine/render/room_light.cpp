#include "render/room_light.h"

#include "render/cube_directions.h"
#include "scene/frames.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {

namespace {

constexpr int sample_columns = 48, sample_rows = 36;
// What a direction was seen as is forgotten with this time constant; the light is estimated anew so often.
constexpr double settles_s = 0.3, again_s = 0.2;
// Grey world: the share of the light that what a camera sees throws back.
constexpr float throws_back = 0.45F, most_gain = 3;
// What was not seen is guessed to be no brighter than so many times what is usual, before that.
constexpr float most_guessed = 2;
// Above this code a camera's pixel is full, and what it saw was brighter than it says.
constexpr float full = 0.94F, beyond_full = 5;
// So many times the mean is a lamp or a window rather than something that is lit.
constexpr float lamp = 4;
// What is brighter than this in the darkest place of a picture is a bright thing and not a lens that flares.
constexpr float most_black = 0.012F;
// Levels of the cube on which what was not seen is guessed: from cells to cells.
constexpr int guess_from = 4, guess_to = 16;
// A mirrored direction counts half as much as one that was seen.
constexpr float mirrored_counts = 0.5F;

glm::vec3 vec(const Rgb& c) {
  return {c[0], c[1], c[2]};
}

float brightness(const glm::vec3& c) {
  return luminance({c.x, c.y, c.z});
}

glm::vec3 light_of(const Rgb& coded) {
  const float most = std::max({coded[0], coded[1], coded[2]});
  const float over = std::max(most - full, 0.0F) / (1 - full);
  return vec(linear_of(coded)) * (1 + beyond_full * over * over);
}

template <std::size_t count>
std::array<glm::vec3, count> cube_directions(int n) {
  std::array<glm::vec3, count> directions;
  for (std::size_t i = 0; i < count; ++i) directions[i] = cube_direction(i, n);
  return directions;
}

float eighth_power(float x) {
  const float x2 = x * x, x4 = x2 * x2;
  return x4 * x4;
}

/// A cosine lobe as wide as a GGX lobe of that roughness (Karis 2013).
float lobe_power(float roughness) {
  const float a = roughness * roughness;
  return 2 / (a * a) - 2;
}

}  // namespace

RoomLight::RoomLight() {
  set(Light{});
}

std::span<const glm::vec3> RoomLight::mirrored(int level) const {
  return std::span(mirrored_).subspan(cube_texels_before(side, level), cube_texels(side >> level));
}

void RoomLight::clear() {
  known_.fill(0);
  any_ = false;
}

void RoomLight::see(const Picture& picture) {
  const glm::vec3 forward = direction_to_graphics(rotate(picture.T_world_camera.rotation, {0, 0, 1}));
  const double passed = (picture.exposure.start - estimated_).seconds();
  const bool first = !any_;
  any_ = true;
  if (!first && passed >= 0 && passed < again_s) return;
  gather(picture);
  const float share = first ? 1.0F : static_cast<float>(1 - std::exp(-std::abs(passed) / settles_s));
  estimated_ = picture.exposure.start;
  for (std::size_t i = 0; i < texels; ++i) {
    if (counts_[i] <= 0) continue;
    const glm::vec3 now = sum_[i] / counts_[i];
    seen_[i] = known_[i] > 0 ? glm::mix(seen_[i], now, share) : now;
    known_[i] = 1;
  }
  noise_ += share * (noise_of(picture) - noise_);
  estimate(forward);
}

// Where the camera's exposure, or the room's light, changes, what it does not see just now changes with it.
void RoomLight::follow_exposure() {
  float before = 0, now = 0;
  for (std::size_t i = 0; i < texels; ++i) {
    if (counts_[i] <= 0 || known_[i] <= 0) continue;
    before += brightness(seen_[i]);
    now += brightness(sum_[i] / counts_[i]);
  }
  if (!(before > 0 && now > 0)) return;
  const float ratio = std::clamp(now / before, 0.1F, 10.0F);
  for (std::size_t i = 0; i < texels; ++i)
    if (counts_[i] <= 0) seen_[i] *= ratio;
}

void RoomLight::gather(const Picture& p) {
  sum_.fill(glm::vec3(0));
  counts_.fill(0);
  std::array<float, std::size_t{sample_columns} * sample_rows> levels{};
  std::size_t count = 0;
  for (int row = 0; row < sample_rows; ++row)
    for (int column = 0; column < sample_columns; ++column) {
      const int x = (2 * column + 1) * p.width / (2 * sample_columns), y = (2 * row + 1) * p.height / (2 * sample_rows);
      const Rgb coded = coded_at(p, x, y);
      // A lens's distortion is less than a texel of light.
      const Vec3 ray{(x - p.intrinsics.cx) / p.intrinsics.fx, (y - p.intrinsics.cy) / p.intrinsics.fy, 1};
      const glm::vec3 d = direction_to_graphics(rotate(p.T_world_camera.rotation, ray));
      const std::size_t texel = cube_texel(d, side);
      sum_[texel] += light_of(coded);
      counts_[texel] += 1;
      levels[count++] = luminance(linear_of(coded));
    }
  const auto low = levels.begin() + levels.size() / 100;
  std::nth_element(levels.begin(), low, levels.end());
  black_ = glm::vec3(std::min(*low, most_black));
  follow_exposure();
}

void RoomLight::estimate(const glm::vec3& camera_forward) {
  guess_unseen(camera_forward);
  take_out_key();
  fill_levels();
  fill_matt();
  ++version_;
}

float RoomLight::usual_brightness() const {
  std::array<float, texels> all;
  std::size_t count = 0;
  for (std::size_t i = 0; i < texels; ++i)
    if (known_[i] > 0) all[count++] = brightness(seen_[i]);
  if (count == 0) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(all.begin(), middle, all.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

void RoomLight::guess_unseen(const glm::vec3& forward) {
  std::array<glm::vec3, 6 * guess_from * guess_from> cells{};
  std::array<float, cells.size()> weights{};
  const float usual = usual_brightness();
  float seen_light = 0;
  for (std::size_t i = 0; i < texels; ++i) {
    if (known_[i] <= 0) continue;
    const glm::vec3 d = cube_direction(i, side);
    const float is = brightness(seen_[i]);
    seen_light += cube_solid_angle(i, side) * is;
    // A window is where it is, and not behind the camera as well.
    const glm::vec3 light = std::min(1.0F, most_guessed * usual / std::max(is, 1e-6F)) * seen_[i];
    const auto add = [&](const glm::vec3& towards, float share) {
      const std::size_t cell = cube_texel(towards, guess_from);
      cells[cell] += share * light;
      weights[cell] += share;
    };
    add(d, 1);
    add(d - 2 * glm::dot(d, forward) * forward, mirrored_counts);
  }
  const auto directions = cube_directions<cells.size()>(guess_from);
  std::array<glm::vec3, 6 * guess_to * guess_to> guesses{};
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const glm::vec3 d = cube_direction(i, guess_to);
    float weight = 1e-9F;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      if (weights[cell] <= 0) continue;
      const float near = eighth_power(0.5F + 0.5F * glm::dot(d, directions[cell]));
      guesses[i] += near * cells[cell];
      weight += near * weights[cell];
    }
    guesses[i] /= weight;
  }
  // As much light must come from all round as what is seen throws back.
  constexpr float whole = 4 * std::numbers::pi_v<float>;
  float unseen_light = 1e-9F;
  for (std::size_t i = 0; i < texels; ++i)
    if (known_[i] <= 0)
      unseen_light += cube_solid_angle(i, side) * brightness(guesses[cube_texel(cube_direction(i, side), guess_to)]);
  const float gain = std::clamp((whole * usual / throws_back - seen_light) / unseen_light, 1.0F, most_gain);
  for (std::size_t i = 0; i < texels; ++i) {
    const glm::vec3 d = cube_direction(i, side);
    const float from_above = 1 + (gain - 1) * (1 + d.y);
    mirrored_[i] = known_[i] > 0 ? seen_[i] : from_above * guesses[cube_texel(d, guess_to)];
  }
}

void RoomLight::take_out_key() {
  float light = 0;
  for (std::size_t i = 0; i < texels; ++i) light += cube_solid_angle(i, side) * brightness(mirrored_[i]);
  const float most = lamp * light / (4 * std::numbers::pi_v<float>);
  glm::vec3 towards(0), color(0);
  for (std::size_t i = 0; i < texels; ++i) {
    const float is = brightness(mirrored_[i]);
    if (is <= most || is <= 0) continue;
    const glm::vec3 over = cube_solid_angle(i, side) * (1 - most / is) * mirrored_[i];
    mirrored_[i] *= most / is;
    towards += brightness(over) * cube_direction(i, side);
    color += over;
  }
  key_ = color;
  if (glm::dot(towards, towards) > 0) to_key_ = glm::normalize(towards);
}

void RoomLight::fill_matt() {
  constexpr int level = 1;
  constexpr int n = side >> level;
  matt_.fill(glm::vec3(0));
  const auto light = mirrored(level);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const glm::vec3 d = cube_direction(i, n), l = cube_solid_angle(i, n) * light[i];
    const std::array<float, 9> basis{
        1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
    for (std::size_t k = 0; k < 9; ++k) matt_[k] += basis[k] * l;
  }
  // The squares of the harmonics' factors, and of the cosine lobe's over pi: 1, 2/3 and 1/4.
  constexpr std::array<float, 9> factors{
      0.282095F * 0.282095F,         0.488603F * 0.488603F * 2 / 3, 0.488603F * 0.488603F * 2 / 3,
      0.488603F * 0.488603F * 2 / 3, 1.092548F * 1.092548F / 4,     1.092548F * 1.092548F / 4,
      0.315392F * 0.315392F / 4,     1.092548F * 1.092548F / 4,     0.546274F * 0.546274F / 4};
  for (std::size_t k = 0; k < 9; ++k) matt_[k] *= factors[k];
}

void RoomLight::fill_levels() {
  // The first two below are as sharp as their texels; the rest need a lobe wider than that, taken from the second.
  constexpr int sharp = 2, n = side >> sharp;
  for (int level = 1; level <= sharp; ++level) {
    const int above = side >> (level - 1);
    const auto from = mirrored(level - 1);
    std::array<float, cube_texels(side >> 1)> counts{};
    const auto to = std::span(mirrored_).subspan(cube_texels_before(side, level), cube_texels(side >> level));
    std::fill(to.begin(), to.end(), glm::vec3(0));
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t texel = cube_texel(cube_direction(i, above), side >> level);
      to[texel] += from[i];
      counts[texel] += 1;
    }
    for (std::size_t i = 0; i < to.size(); ++i) to[i] /= counts[i];
  }
  const auto source = mirrored(sharp);
  const auto directions = cube_directions<cube_texels(side >> sharp)>(n);
  for (int level = sharp + 1; level < levels; ++level) {
    const float power = lobe_power(static_cast<float>(level) / (levels - 1));
    for (std::size_t i = 0; i < cube_texels(side >> level); ++i) {
      const glm::vec3 d = cube_direction(i, side >> level);
      glm::vec3 sum(0);
      float weight = 0;
      for (std::size_t k = 0; k < source.size(); ++k) {
        const float along = glm::dot(d, directions[k]);
        if (along <= 0) continue;
        // Times the cosine, as Karis weighs it.
        const float w = std::pow(along, power + 1) * cube_solid_angle(k, n);
        sum += w * source[k];
        weight += w;
      }
      mirrored_[cube_texels_before(side, level) + i] = sum / weight;
    }
  }
}

void RoomLight::set(const Light& light) {
  const auto color = [](const Color& c) { return glm::vec3(c.r, c.g, c.b); };
  for (std::size_t i = 0; i < texels; ++i)
    mirrored_[i] = glm::mix(color(light.ground), color(light.sky), 0.5F + 0.5F * cube_direction(i, side).y);
  to_key_ = glm::normalize(direction_to_graphics(light.to_key_world));
  key_ = color(light.key);
  black_ = glm::vec3(0);
  noise_ = 0;
  fill_levels();
  fill_matt();
  ++version_;
}

}  // namespace onestroke

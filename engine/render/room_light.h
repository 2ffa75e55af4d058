#pragma once

#include "core/picture.h"
#include "render/cube_directions.h"
#include "render/frame_scene.h"
#include "render/picture_samples.h"

#include <glm/vec3.hpp>

#include <array>
#include <span>

namespace onestroke {

/// The light of the room that the camera looks into, estimated from its pictures: linear, in units of the picture's own
/// white, so that what it lights is as bright and as coloured as what the camera sees. One thread, no allocation.
///
/// What the camera has seen of the room so far is kept by direction, in the world. Of the directions that it has not
/// seen there is a guess: the picture mirrored behind the camera, smoothed, and brighter from above, for a room's walls
/// throw back only part of the light that falls on them, so that much more light must come from elsewhere.
class RoomLight {
 public:
  /// Side of a face of the cube of directions, at the first of its levels.
  static constexpr int side = 32, levels = 6;

  RoomLight();

  /// Takes a picture into account.
  void see(const Picture& picture);
  /// A light that is known, in place of what was seen.
  void set(const Light& light);
  /// Forgets what was seen.
  void clear();

  /// What a white matt surface gives back, by the direction that it faces (graphics axes): 9 spherical harmonics after
  /// Ramamoorthi and Hanrahan 2001, the cosine lobe folded in.
  const std::array<glm::vec3, 9>& matt() const { return matt_; }
  /// What surfaces mirror, level by level: faces +x -x +y -y +z -z in Vulkan's layout, rows from the top, graphics
  /// axes. Level l is what roughness l / (levels - 1) makes of it.
  std::span<const glm::vec3> mirrored(int level) const;
  /// The brightest thing seen, a lamp or a window, as a light from one direction (graphics axes, unit): its irradiance
  /// on a surface that faces it. What is mirrored and what matt surfaces give back are without it.
  const glm::vec3& to_key() const { return to_key_; }
  const glm::vec3& key() const { return key_; }
  /// The darkest that the camera shows, linear.
  const glm::vec3& black() const { return black_; }
  /// See noise_of().
  float noise() const { return noise_; }
  /// Grows with every change of the above.
  std::uint64_t version() const { return version_; }

 private:
  void gather(const Picture& picture);
  void follow_exposure();
  void estimate(const glm::vec3& camera_forward);
  float usual_brightness() const;
  void guess_unseen(const glm::vec3& camera_forward);
  void take_out_key();
  void fill_matt();
  void fill_levels();

  static constexpr std::size_t texels = cube_texels(side);
  std::array<glm::vec3, texels> seen_{}, sum_{};
  std::array<float, texels> known_{}, counts_{};
  std::array<glm::vec3, cube_texels_before(side, levels)> mirrored_{};
  std::array<glm::vec3, 9> matt_{};
  glm::vec3 to_key_{0, 1, 0}, key_{0}, black_{0};
  float noise_ = 0;
  Time estimated_;
  bool any_ = false;
  std::uint64_t version_ = 0;
};

}  // namespace onestroke

#pragma once

#include "camera/synthetic_renderer.h"
#include "core/camera.h"
#include "marker/catalog.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

namespace onestroke::test {

inline constexpr double radian = std::numbers::pi / 180;

inline MarkerSpec angle_marker(int id, double bend_radius = 0) {
  constexpr std::uint64_t spread = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t value = (spread * static_cast<std::uint64_t>(id)) & ((1ULL << 34) - 1);
  return {id, "m" + std::to_string(id), encode(value, 36), Shape::angle(36, 4, 3, bend_radius), ""};
}

inline Catalog two_markers() {
  return {{angle_marker(3), angle_marker(5, 12)}};
}

/// A picture without noise before an even grey.
inline SyntheticFrame plain_frame(int width = 640, int height = 480, double fov = 40 * radian) {
  SyntheticFrame frame;
  frame.width = width;
  frame.height = height;
  frame.intrinsics = Intrinsics::from_fov(width, height, fov);
  return frame;
}

/// Something that starts at `middle` minus half the way and goes by `way` mm during the picture's span.
inline PosePath sliding(const Pose& middle, Vec3 way) {
  std::array<Pose, PosePath::knots> poses;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k] = middle;
    poses[k].translation = middle.translation + (static_cast<double>(k) / (PosePath::knots - 1) - 0.5) * way;
  }
  return PosePath(poses);
}

inline std::array<int, 3> pixel(const SyntheticImage& image, int x, int y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                                  static_cast<std::size_t>(x));
  return {p[0], p[1], p[2]};
}

inline double to_linear(int level) {
  const double v = level / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// A folder of its own for a test, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "onestroke-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no scratch folder");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The message of the Error that `call` throws; empty where it throws none.
template <typename Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const std::exception& e) {
    return e.what();
  }
  return {};
}

/// Takes a picture from a camera that must have one.
inline PictureHandle take(Camera& camera) {
  PictureHandle picture;
  EXPECT_EQ(camera.next(picture), Camera::Status::ok) << camera.message();
  return picture;
}

}  // namespace onestroke::test

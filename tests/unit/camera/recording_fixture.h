#pragma once

#include "camera/recorder.h"
#include "core/picture_planes.h"
#include "core/picture_pool.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace onestroke::test {

/// Pictures that are made up by a test, each its own only holder.
class Album : private PictureHandle::Lender {
 public:
  /// Planes of noise, in rows with some bytes of padding.
  PictureHandle noise(PixelFormat format, int width, int height, std::uint64_t sequence) {
    Page& page = add();
    Picture& p = page.picture;
    p.width = width;
    p.height = height;
    p.format = format;
    p.sequence = sequence;
    const std::size_t padding = 12, bytes = plane_bytes(format, width, height) / static_cast<std::size_t>(height);
    set_planes(p, nullptr);
    for (std::size_t& stride : p.strides) stride += stride > 0 ? padding : 0;
    page.bytes.resize(2 * (bytes + padding) * static_cast<std::size_t>(height));
    for (std::uint8_t& byte : page.bytes) byte = static_cast<std::uint8_t>(random_());
    p.planes[0] = page.bytes.data();
    if (format == PixelFormat::nv12) p.planes[1] = page.bytes.data() + p.strides[0] * static_cast<std::size_t>(height);
    p.exposure = {{1'000'000'007 + 33'333'333 * static_cast<std::int64_t>(sequence)}, {4'000'001}, {20'000'003}};
    p.intrinsics = Intrinsics::from_fov(width, height, 1);
    p.intrinsics.distortion = {0.1, -0.02, 1.0 / 3, 0, 1e-17};
    p.T_world_camera = {exp_so3({0.1, 0.2, std::sqrt(2.0)}), {1.0 / 3, -std::sqrt(3.0), 1e5 / 7}};
    return PictureHandle(page);
  }
  Picture& of(const PictureHandle& picture) { return const_cast<Picture&>(*picture); }

 private:
  struct Page : PictureHandle::Loan {
    std::vector<std::uint8_t> bytes;
  };
  Page& add() {
    pages_.push_back(std::make_unique<Page>());
    pages_.back()->lender = this;
    return *pages_.back();
  }
  void give_back(PictureHandle::Loan&) noexcept override {}

  std::vector<std::unique_ptr<Page>> pages_;
  std::minstd_rand random_{7};
};

/// The planes without padding.
inline std::vector<std::uint8_t> pixels_of(const Picture& p) {
  std::vector<std::uint8_t> bytes(plane_bytes(p.format, p.width, p.height));
  copy_planes(p, bytes.data());
  return bytes;
}

/// As if a marker had been found.
inline FrameRecord found_in(const Picture& p) {
  FrameRecord record;
  record.sequence = p.sequence;
  record.time = p.exposure.middle();
  record.T_world_camera = p.T_world_camera;
  record.marker_count = 1;
  MarkerObservation& m = record.markers[0];
  m.id = 3;
  std::strcpy(m.name.data(), "m3");
  m.state = MarkerState::measured;
  m.T_camera_marker = {exp_so3({0.1, -0.7, 2.0 / 3}), {1.0 / 3, -20, 450.25}};
  for (std::size_t i = 0; i < 36; ++i) m.covariance[i] = std::sin(static_cast<double>(i));
  return record;
}

/// Offers it until it is taken.
inline void add_to(Recorder& recorder, const PictureHandle& picture) {
  while (!recorder.add(picture, found_in(*picture))) std::this_thread::yield();
}

}  // namespace onestroke::test

#pragma once

#include "render/display.h"

#include <filesystem>
#include <memory>

namespace onestroke {

struct OffscreenOptions {
  /// Where the files go; made where it is missing. Empty: no files, for read_back() alone.
  std::filesystem::path directory{};
  /// Of the whole picture, both views together.
  int width = 1280, height = 720;
  /// Frames per second of the time that the display pretends; it does not wait for it.
  double rate = 30;
  /// Every Nth frame becomes frame_NNNNNN.png; 0 for none.
  int png_every = 1;
  /// All frames become film.mp4.
  bool film = true;
  /// 1, or 2 for a pair side by side, the left eye on the left.
  int views = 1;
  double eye_distance_mm = 63;
};

/// A display without a screen: frames at a fixed time step, as fast as they can be drawn, into files.
class OffscreenDisplay final : public Display {
 public:
  /// Throws Error where the directory cannot be made or written to, or a size is not sound.
  explicit OffscreenDisplay(const OffscreenOptions& options);
  ~OffscreenDisplay() override;

  GpuNeeds needs() const override { return {}; }
  void attach(Gpu& gpu) override;
  void begin(FrameInfo& frame) override;
  void end(const FrameInfo& frame) override;
  std::span<const Key> poll() override { return {}; }
  bool closed() const override;
  bool gpu_lost() const override;
  bool tracks_head() const override { return false; }
  void finish() override;
  std::vector<std::string> report() const override;

  /// The frame that end() took last: RGBA rows from the top, without padding. Waits for the GPU.
  std::span<const std::uint8_t> read_back();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

#pragma once

#include "render/display.h"

#include <memory>

namespace onestroke {

/// A headset, by whatever OpenXR runtime is active. The world is the runtime's LOCAL space, until
/// recentre() moves its origin.
class OpenXrDisplay final : public Display {
 public:
  /// Throws Error where there is no runtime or no headset, or the runtime cannot do what is needed.
  OpenXrDisplay();
  ~OpenXrDisplay() override;

  GpuNeeds needs() const override;
  void attach(Gpu& gpu) override;
  /// Where the headset is not worn, another program has it or the runtime went away, waits a little and wants nothing
  /// drawn.
  void begin(FrameInfo& frame) override;
  bool move_views(FrameInfo& frame) override;
  void end(const FrameInfo& frame) override;
  std::span<const Key> poll() override;
  bool closed() const override;
  /// Also where the runtime went away, once it is back: the Gpu was made through it.
  bool gpu_lost() const override;
  bool tracks_head() const override { return true; }
  std::optional<Pose> head_at(Time time) const override;
  bool recentre() override;
  void finish() override;
  std::vector<std::string> report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

#pragma once

#include "render/display.h"
#include "render/world.h"

#include <memory>

namespace onestroke {

struct OpenXrOptions {
  std::string title = "onestroke";
  /// What the wearer sees behind the models.
  World world = World::automatic;
  /// A window beside the headset that shows the left eye's picture and hears keys, where there is a screen. The display
  /// then must be made by the program's main thread.
  bool mirror = false;
};

/// A headset, by whatever OpenXR runtime is active. The world is the runtime's LOCAL space as it was at the start,
/// which the runtime's own recentring does not move, until recentre() moves its origin.
class OpenXrDisplay final : public Display {
 public:
  /// Throws Error where there is no runtime or no headset, or the runtime cannot do what is needed, or does not offer
  /// what is asked for.
  explicit OpenXrDisplay(const OpenXrOptions& options = {});
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
  bool shows_world() const override;
  std::optional<Pose> head_at(Time time) const override;
  bool recentre() override;
  std::string headset() const override;
  void finish() override;
  std::vector<std::string> report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

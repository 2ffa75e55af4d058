#pragma once

#include "render/display.h"

#include <memory>

namespace onestroke {

struct WindowOptions {
  std::string title = "onestroke";
  int width = 1280, height = 720;
  bool wait_for_screen = true;
};

/// Why no window can be opened, with the remedy; empty where one can.
std::string window_shortfall();

/// A window on the desktop. The thread that makes it must be the program's main one.
class WindowDisplay final : public Display {
 public:
  /// Throws Error where there is no desktop.
  explicit WindowDisplay(const WindowOptions& options);
  ~WindowDisplay() override;

  GpuNeeds needs() const override;
  void attach(Gpu& gpu) override;
  void begin(FrameInfo& frame) override;
  void end(const FrameInfo& frame) override;
  std::span<const Key> poll() override;
  bool closed() const override;
  bool gpu_lost() const override;
  bool tracks_head() const override { return false; }
  void finish() override;

  /// Asks for another size, as a user would with the mouse; the next frames follow it.
  void resize(int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

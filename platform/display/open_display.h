#pragma once

#include "render/display.h"
#include "render/world.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace onestroke {

struct DisplayOptions {
  std::string title = "onestroke";
  int width = 1280, height = 720;
  /// Window: waits for the screen's refresh. Otherwise the newest frame wins, where the driver can do that.
  bool wait_for_screen = true;
  /// Headset: see OpenXrOptions.
  World world = World::automatic;
  bool mirror = true;
  /// Headset: one that is not there yet is waited for, until this says true. Null: that is an error.
  bool (*give_up)() = nullptr;
  /// Off-screen: see OffscreenOptions.
  double rate = 30;
  int png_every = 1;
  bool film = true;
  int views = 1;
};

/// The folder of "offscreen:DIR"; none of another display's words.
std::optional<std::filesystem::path> offscreen_folder(const std::string& spec);

/// Opens "window", "openxr" or "offscreen:DIR". Throws UsageError for other words, and Error where the display cannot
/// be had.
std::unique_ptr<Display> open_display(const std::string& spec, const DisplayOptions& options);

}  // namespace onestroke

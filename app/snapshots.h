#pragma once

#include "render/renderer.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace onestroke {

class Gpu;

/// Saves pictures of what is seen, and the numbers that belong to them, into a folder: snapshot_001.png and .json, and
/// so on behind those that are there. One thread, the one that renders; files are written by another.
class Snapshots {
 public:
  /// The folder is made with the first one.
  explicit Snapshots(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Waits for what is being written.
  ~Snapshots() = default;

  /// Draws the scene once more, as `view` sees it. What goes wrong is said by notice(); nothing is thrown.
  void take(Gpu& gpu, Renderer& renderer, const FrameScene& scene, const View& view, std::string numbers) noexcept;

  /// What became of the last one, for a person; empty before the first, and while it is being written.
  std::string_view notice() const;
  /// Until the last one is written.
  void wait();
  /// How many have been saved; after wait().
  int saved() const { return saved_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
  };
  static Picture draw(Gpu& gpu, Renderer& renderer, const FrameScene& scene, View view);
  void write(const Picture& picture, const std::string& numbers);
  std::filesystem::path free_name();

  std::filesystem::path folder_;
  int next_ = 1, saved_ = 0;
  std::string notice_;  // the writer's, until it is done
  std::atomic<bool> done_{false};
  std::jthread writer_;
};

}  // namespace onestroke

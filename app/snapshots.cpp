#include "app/snapshots.h"

#include "core/error.h"
#include "display/offscreen.h"
#include "display/png_file.h"
#include "render/gpu.h"

#include <array>
#include <cstdio>
#include <fstream>

namespace onestroke {
namespace fs = std::filesystem;

void Snapshots::take(Gpu& gpu, Renderer& renderer, const FrameScene& scene, const View& view,
                     std::string numbers) noexcept {
  wait();
  done_ = false;
  try {
    Picture picture = draw(gpu, renderer, scene, view);
    writer_ = std::jthread([this, picture = std::move(picture), numbers = std::move(numbers)] {
      try {
        write(picture, numbers);
      } catch (const std::exception& error) {
        notice_ = "Snapshot not saved: " + std::string(error.what());
      }
      done_ = true;
    });
  } catch (const std::exception& error) {
    notice_ = "Snapshot not saved: " + std::string(error.what());
    done_ = true;
  }
}

Snapshots::Picture Snapshots::draw(Gpu& gpu, Renderer& renderer, const FrameScene& scene, View view) {
  view.viewport.x = view.viewport.y = 0;
  OffscreenDisplay display({.directory = {}, .width = view.viewport.width, .height = view.viewport.height});
  display.attach(gpu);
  FrameInfo frame;
  display.begin(frame);
  frame.views[0] = view;
  frame.view_count = 1;
  if (!frame.should_render || !renderer.draw(scene, frame)) throw Error("the GPU could not draw it");
  display.end(frame);
  const std::span<const std::uint8_t> bytes = display.read_back();
  return {view.viewport.width, view.viewport.height, {bytes.begin(), bytes.end()}};
}

void Snapshots::write(const Picture& picture, const std::string& numbers) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) throw Error("the folder " + folder_.string() + " cannot be made; give another one by --snapshots DIR");
  const fs::path name = free_name();
  write_png(fs::path(name).concat(".png"), picture.width, picture.height, picture.rgba);
  const fs::path text = fs::path(name).concat(".json");
  std::ofstream file(text, std::ios::binary);
  if (!(file << numbers).flush()) throw Error(text.string() + " cannot be written; check that the disk is not full");
  ++saved_;
  notice_ = "Saved " + fs::path(name).concat(".png").string() + " and its numbers";
}

fs::path Snapshots::free_name() {
  std::array<char, 32> name{};
  for (;; ++next_) {
    std::snprintf(name.data(), name.size(), "snapshot_%03d", next_);
    std::error_code unknown;
    const fs::path path = folder_ / name.data();
    if (!fs::exists(fs::path(path).concat(".png"), unknown) && !fs::exists(fs::path(path).concat(".json"), unknown))
      return path;
  }
}

std::string_view Snapshots::notice() const {
  return done_ ? std::string_view(notice_) : std::string_view();
}

void Snapshots::wait() {
  if (writer_.joinable()) writer_.join();
}

}  // namespace onestroke

#include "display/frame_files.h"

#include "core/error.h"
#include "display/png_file.h"

#include <array>
#include <cstdio>
#include <fstream>

namespace onestroke {

namespace {

std::filesystem::path picture_name(const std::filesystem::path& directory, int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%06d.png", frame);
  return directory / name.data();
}

void try_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  const auto probe = directory / ".onestroke";
  const bool writable = !error && std::ofstream(probe).put('\n').flush().good();
  std::filesystem::remove(probe, error);
  if (!writable) throw Error("cannot write to " + directory.string() + ": choose another directory or free some space");
}

}  // namespace

FrameFiles::FrameFiles(const OffscreenOptions& options) : options_(options) {
  if (options.directory.empty()) {
    options_.png_every = 0;
    options_.film = false;
    return;
  }
  try_directory(options.directory);
  if (options.film) film_.emplace(options.directory / "film.mp4", options.width, options.height, options.rate);
}

void FrameFiles::add(std::span<const std::uint8_t> rgba) {
  const int frame = frames_++;
  if (options_.png_every > 0 && frame % options_.png_every == 0) {
    write_png(picture_name(options_.directory, frame), options_.width, options_.height, rgba);
    ++pictures_;
    last_picture_ = frame;
  }
  if (!film_) return;
  film_->add(rgba);
  ++filmed_;
}

void FrameFiles::leave_out() {
  ++frames_;
  if (film_) film_->leave_out();
}

void FrameFiles::finish() {
  if (film_) film_->finish();
}

std::vector<std::string> FrameFiles::report() const {
  std::vector<std::string> lines;
  if (pictures_ > 0)
    lines.push_back("wrote " + picture_name(options_.directory, 0).string() + " to " +
                    picture_name(options_.directory, last_picture_).filename().string() + ", " +
                    std::to_string(pictures_) + " pictures");
  if (filmed_ > 0)
    lines.push_back("wrote " + (options_.directory / "film.mp4").string() + ", " + std::to_string(filmed_) + " frames");
  return lines;
}

}  // namespace onestroke

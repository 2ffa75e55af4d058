#include "app/graphics.h"

#include "app/cache_folder.h"
#include "app/progress.h"
#include "core/error.h"

#include <cstdlib>
#include <utility>

namespace onestroke {

GpuOptions gpu_options(const std::string& gpu) {
  const char* validation = std::getenv("ONESTROKE_VALIDATION");
  return {.validation = validation && *validation, .gpu = gpu, .cache_folder = cache_folder()};
}

Graphics::Graphics(Display& display, Wanted wanted) : display_(display), wanted_(std::move(wanted)) {
  wanted_.gpu.needs = display.needs();
  build();
}

void Graphics::build() {
  gpu_.emplace(wanted_.gpu);
  display_.attach(*gpu_);
  renderer_.emplace(*gpu_, RendererOptions{.room = room_});
  room_ = renderer_->room();
  shelf_.emplace(wanted_.catalog, wanted_.catalog_file.parent_path(), *renderer_);
  differences_.emplace(wanted_.catalog, wanted_.catalog_file, *renderer_);
  if (!wanted_.models_first) return;
  Progress progress;
  shelf_->wait([&](const std::string& line) { progress.say(line); });
}

void Graphics::rebuild() {
  differences_.reset();
  shelf_.reset();
  renderer_.reset();
  gpu_.reset();
  try {
    build();
  } catch (const std::exception& error) {
    throw Error(std::string("the GPU was lost and does not start again: restart the program (") + error.what() + ")");
  }
}

}  // namespace onestroke

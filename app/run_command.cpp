#include "app/run_command.h"

#include "app/source.h"
#include "core/error.h"
#include "display/open_display.h"
#include "render/renderer.h"

#include <ostream>

namespace onestroke {

int run_command(const RunOptions& options, std::ostream& out) {
  const Catalog catalog = load_catalog(options.catalog);
  const std::unique_ptr<Camera> camera = open_source(options.source, catalog);
  const std::unique_ptr<Display> display = open_display(options.display.empty() ? "window" : options.display, {});
  Gpu gpu({.needs = display->needs()});
  display->attach(gpu);
  Renderer renderer(gpu);
  PictureHandle picture;
  for (int n = 0; !display->closed() && (!options.frames || n < *options.frames); ++n) {
    if (camera->next(picture) == Camera::Status::end) break;
    if (picture) renderer.set_picture(*picture);
    FrameInfo frame;
    display->begin(frame);
    if (frame.should_render && !renderer.draw({}, frame)) throw Error(renderer.failure());
    display->end(frame);
  }
  display->finish();
  for (const std::string& line : display->report()) out << line << '\n';
  return 0;
}

}  // namespace onestroke

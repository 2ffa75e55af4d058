#include "display/open_display.h"

#include "core/error.h"
#include "display/offscreen.h"
#include "display/openxr.h"
#include "display/window.h"

#include <string_view>

namespace onestroke {

std::unique_ptr<Display> open_display(const std::string& spec, const DisplayOptions& o) {
  constexpr std::string_view offscreen = "offscreen:";
  if (spec == "window")
    return std::make_unique<WindowDisplay>(
        WindowOptions{.title = o.title, .width = o.width, .height = o.height, .wait_for_screen = o.wait_for_screen});
  if (spec == "openxr") return std::make_unique<OpenXrDisplay>();
  if (spec.starts_with(offscreen) && spec.size() > offscreen.size())
    return std::make_unique<OffscreenDisplay>(OffscreenOptions{.directory = spec.substr(offscreen.size()),
                                                               .width = o.width,
                                                               .height = o.height,
                                                               .rate = o.rate,
                                                               .png_every = o.png_every,
                                                               .film = o.film,
                                                               .views = o.views});
  throw UsageError("there is no display \"" + spec + "\": use window, openxr or offscreen:DIR");
}

}  // namespace onestroke

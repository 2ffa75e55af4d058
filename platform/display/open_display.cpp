#include "display/open_display.h"

#include "core/error.h"
#include "display/offscreen.h"
#include "display/openxr.h"
#include "display/openxr_wait.h"
#include "display/window.h"

#include <string_view>

namespace onestroke {

std::optional<std::filesystem::path> offscreen_folder(const std::string& spec) {
  constexpr std::string_view offscreen = "offscreen:";
  if (!spec.starts_with(offscreen) || spec.size() == offscreen.size()) return std::nullopt;
  return spec.substr(offscreen.size());
}

std::unique_ptr<Display> open_display(const std::string& spec, const DisplayOptions& o) {
  if (spec == "window")
    return std::make_unique<WindowDisplay>(
        WindowOptions{.title = o.title, .width = o.width, .height = o.height, .wait_for_screen = o.wait_for_screen});
  if (spec == "openxr") {
    const OpenXrOptions options{.title = o.title, .world = o.world, .mirror = o.mirror};
    if (o.give_up) return wait_for_headset(options, o.give_up);
    return std::make_unique<OpenXrDisplay>(options);
  }
  if (const auto folder = offscreen_folder(spec))
    return std::make_unique<OffscreenDisplay>(OffscreenOptions{.directory = *folder,
                                                               .width = o.width,
                                                               .height = o.height,
                                                               .rate = o.rate,
                                                               .png_every = o.png_every,
                                                               .film = o.film,
                                                               .views = o.views});
  throw UsageError("there is no display \"" + spec + "\": use window, openxr or offscreen:DIR");
}

}  // namespace onestroke

#pragma once

#include "camera/capture.h"
#include "camera/live_options.h"

#include <span>
#include <string>
#include <vector>

namespace onestroke {

/// One of a device's formats, by the name that libcamera gives it, and its sizes.
struct OfferedFormat {
  std::string name{};
  std::vector<PictureSize> sizes{};
};

struct FormatChoice {
  std::string name{};
  CaptureCoding coding = CaptureCoding::yuyv;
  PictureSize size;
};

/// The format to ask a device for. Without a wish: the size nearest to 1280 x 720, and of the codings the one with the
/// least work that also fits USB 2, which carries no more than small pictures uncompressed. `camera` is its name, for
/// messages. Throws Error, which says why, where none will do: grey alone tells no inks apart.
FormatChoice choose_format(std::span<const OfferedFormat> offered, const LiveOptions& wishes,
                           const std::string& camera);

/// What libcamera calls a format, as the coding that this program reads; none for those that it does not.
std::optional<CaptureCoding> coding_of(const std::string& name);

/// As --format spells it.
std::string_view coding_name(CaptureCoding coding);

}  // namespace onestroke

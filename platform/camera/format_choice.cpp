#include "camera/format_choice.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace onestroke {
namespace {

constexpr PictureSize usual{1280, 720};
constexpr double usual_rate = 30;
// Bytes a second of one stream over USB 2, which is 60 MB on paper.
constexpr double usb2 = 24e6;

struct Coding {
  CaptureCoding coding;
  std::string_view name;  // libcamera's, which are DRM's: RGB888 has blue first in memory
  std::string_view wish;  // --format's
};
constexpr std::array codings{Coding{CaptureCoding::nv12, "NV12", "nv12"}, Coding{CaptureCoding::yuyv, "YUYV", "yuyv"},
                             Coding{CaptureCoding::rgb8, "BGR888", "rgb"}, Coding{CaptureCoding::bgr8, "RGB888", "rgb"},
                             Coding{CaptureCoding::mjpeg, "MJPEG", "mjpeg"}};

std::string words_of(const PictureSize& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

bool is_grey(const std::string& name) {
  constexpr std::array prefixes{"R8", "R10", "R12", "R14", "R16", "Y8", "Y10", "Y12", "Y14", "Y16", "GREY", "MONO"};
  return std::ranges::any_of(prefixes, [&](const char* prefix) { return name.starts_with(prefix); });
}

std::string names_of(std::span<const OfferedFormat> offered) {
  std::string names;
  for (const OfferedFormat& format : offered) names += (names.empty() ? "" : ", ") + format.name;
  return names;
}

std::string sizes_of(std::span<const OfferedFormat> offered, const std::string& wish) {
  std::vector<std::pair<int, int>> sizes;
  for (const OfferedFormat& format : offered) {
    const auto coding = coding_of(format.name);
    if (!coding || (!wish.empty() && wish != coding_name(*coding))) continue;
    for (const PictureSize& size : format.sizes) sizes.emplace_back(size.width, size.height);
  }
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  std::string words;
  for (const auto& [width, height] : sizes)
    words += (words.empty() ? "" : ", ") + std::to_string(width) + "x" + std::to_string(height);
  return words;
}

[[noreturn]] void refuse_all(std::span<const OfferedFormat> offered, const std::string& camera) {
  if (offered.empty()) throw Error("camera " + camera + " names no format; try another port or another camera");
  if (std::ranges::all_of(offered, [](const OfferedFormat& f) { return is_grey(f.name); }))
    throw Error("camera " + camera + " gives grey pictures alone (" + names_of(offered) +
                "), in which no inks can be told apart; use a colour camera");
  throw Error("camera " + camera + " gives " + names_of(offered) +
              " and none of NV12, YUYV, MJPEG, RGB888, BGR888; use another camera");
}

/// Least is best: how far the size is from the one that is wished, then how much work the coding is.
std::pair<double, int> rank(const FormatChoice& choice, const PictureSize& wish, double rate, bool over_usb) {
  const double pixels = double(choice.size.width) * choice.size.height, wished = double(wish.width) * wish.height;
  // Rather a smaller picture of a shape than a larger one, which costs time.
  const double distance =
      std::abs(choice.size.width - wish.width) + std::abs(choice.size.height - wish.height) + (pixels > wished ? 1 : 0);
  int work = 0;
  while (codings.at(static_cast<std::size_t>(work)).coding != choice.coding) ++work;
  const bool heavy = choice.coding != CaptureCoding::mjpeg && over_usb && 2 * pixels * rate > usb2;
  return {distance, heavy ? work + static_cast<int>(codings.size()) : work};
}

}  // namespace

std::optional<CaptureCoding> coding_of(const std::string& name) {
  const auto* found = std::ranges::find(codings, name, &Coding::name);
  return found == codings.end() ? std::nullopt : std::optional(found->coding);
}

std::string_view coding_name(CaptureCoding coding) {
  return std::ranges::find(codings, coding, &Coding::coding)->wish;
}

FormatChoice choose_format(std::span<const OfferedFormat> offered, const LiveOptions& wishes,
                           const std::string& camera) {
  // Who sends JPEG sends it over USB; a sensor beside the processor has no such narrow way.
  const bool over_usb = std::ranges::any_of(offered, [](const OfferedFormat& f) { return f.name == "MJPEG"; });
  const PictureSize wish = wishes.size.value_or(usual);
  std::optional<FormatChoice> best;
  bool readable = false;
  for (const OfferedFormat& format : offered) {
    const auto coding = coding_of(format.name);
    if (!coding) continue;
    readable = true;
    if (!wishes.format.empty() && wishes.format != coding_name(*coding)) continue;
    for (const PictureSize& size : format.sizes) {
      if (wishes.size && (size.width != wish.width || size.height != wish.height)) continue;
      const FormatChoice choice{format.name, *coding, size};
      const double rate = wishes.rate.value_or(usual_rate);
      if (!best || rank(choice, wish, rate, over_usb) < rank(*best, wish, rate, over_usb)) best = choice;
    }
  }
  if (best) return *best;
  if (!readable) refuse_all(offered, camera);
  const std::string sizes = sizes_of(offered, wishes.format);
  if (sizes.empty())
    throw Error("camera " + camera + " has no format " + wishes.format + ", but " + names_of(offered) +
                "; leave out --format or give another");
  throw Error("camera " + camera + " has no size " + words_of(wish) +
              (wishes.format.empty() ? "" : " in format " + wishes.format) + ", but " + sizes +
              "; leave out --size or give one of these");
}

}  // namespace onestroke

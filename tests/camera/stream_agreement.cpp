#include "stream_agreement.h"

#include <linux/usb/video.h>

#include <algorithm>

namespace onestroke::usb {
namespace {

constexpr u16 layout_bytes = 26;
// The longest interval that the descriptors offer, in shortest ones.
constexpr u32 longest = 6;

}  // namespace

StreamAgreement::StreamAgreement(std::span<const VideoMode> modes, double rate)
    : modes_(modes), indices_(index_modes(modes)), shortest_(frame_interval(rate)) {
  probed_.interval = committed_.interval = shortest_;
}

Agreed StreamAgreement::agree(std::span<const u8> wish) const {
  Agreed agreed{0, shortest_};
  if (wish.size() < 8) return agreed;
  const ModeIndex wished{wish[2], wish[3]};
  for (std::size_t i = 0; i < indices_.size(); ++i)
    if (indices_[i].format == wished.format && indices_[i].frame == wished.frame) agreed.mode = i;
  if (const u32 interval = number_in(&wish[4], 4); interval != 0)
    agreed.interval = std::clamp(interval, shortest_, longest * shortest_);
  return agreed;
}

Bytes StreamAgreement::layout(const Agreed& agreed) const {
  constexpr u16 interval_is_kept = 1;
  const ModeIndex index = indices_[agreed.mode];
  Bytes out;
  append(out, interval_is_kept, index.format, index.frame, agreed.interval, u16{0}, u16{0}, u16{0}, u16{0}, u16{0},
         modes_[agreed.mode].picture_bytes(), static_cast<u32>(payload_bytes));
  return out;
}

std::optional<Bytes> StreamAgreement::answer(u8 request, u8 selector, std::span<const u8> sent) {
  if (selector != UVC_VS_PROBE_CONTROL && selector != UVC_VS_COMMIT_CONTROL) return std::nullopt;
  Agreed& current = selector == UVC_VS_PROBE_CONTROL ? probed_ : committed_;
  constexpr u8 can_be_read_and_set = 3;
  switch (request) {
    case UVC_SET_CUR:
      current = agree(sent);
      return Bytes{};
    case UVC_GET_CUR:
      return layout(current);
    case UVC_GET_MIN:
    case UVC_GET_DEF:
      return layout({probed_.mode, shortest_});
    case UVC_GET_MAX:
      return layout({probed_.mode, longest * shortest_});
    case UVC_GET_INFO:
      return Bytes{can_be_read_and_set};
    case UVC_GET_LEN:
      return Bytes{layout_bytes, 0};
    default:
      return std::nullopt;
  }
}

}  // namespace onestroke::usb

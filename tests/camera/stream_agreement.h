#pragma once

#include "uvc_descriptors.h"

#include <optional>
#include <span>

namespace onestroke::usb {

/// What camera and driver have agreed on.
struct Agreed {
  std::size_t mode = 0;  ///< Its place among the modes.
  u32 interval = 0;      ///< From one picture to the next, units of 100 ns.
};

/// The most bytes of a payload, its header included; 32 packets, which is the most that Linux's driver takes at once.
constexpr std::size_t payload_bytes = 32 * 512;

/// How camera and driver agree on a mode: UVC 1.0's probe and commit, chapter 4.3.1.1.
class StreamAgreement {
 public:
  /// modes: as long as this lives.
  StreamAgreement(std::span<const VideoMode> modes, double rate);

  /// The answer to a request of the probe or the commit control, with `sent` for SET_CUR; none where it is refused.
  std::optional<Bytes> answer(u8 request, u8 selector, std::span<const u8> sent);
  const Agreed& committed() const { return committed_; }

 private:
  /// What the camera makes of a wish.
  Agreed agree(std::span<const u8> wish) const;
  /// As UVC 1.0 lays it out.
  Bytes layout(const Agreed& agreed) const;

  std::span<const VideoMode> modes_;
  std::vector<ModeIndex> indices_;
  u32 shortest_;
  Agreed probed_, committed_;
};

}  // namespace onestroke::usb

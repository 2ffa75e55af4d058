#pragma once

#include "payload_stream.h"
#include "stream_agreement.h"
#include "uvc_controls.h"

#include <optional>
#include <span>
#include <vector>

namespace onestroke::usb {

/// A request on USB's control pipe, USB 2.0's chapter 9.3.
struct ControlRequest {
  u8 type = 0, request = 0;
  u16 value = 0, index = 0, length = 0;
};

/// A camera of USB Video Class 1.0 as the bus sees it, without the bus.
class UvcDevice {
 public:
  /// All as long as this lives; at least one mode.
  UvcDevice(std::span<const VideoMode> modes, const CameraScript& script, EventLog& log);

  /// The answer to a request, with what was `sent` with it; none where the device stalls.
  std::optional<Bytes> answer(const ControlRequest& request, std::span<const u8> sent);
  /// None where the host has not started it.
  PayloadStream* stream() { return stream_ ? &*stream_ : nullptr; }
  void stop();
  /// How many pictures have been sent in all streams.
  std::uint64_t sent() const { return sent_before_ + (stream_ ? stream_->sent() : 0); }

 private:
  std::optional<Bytes> standard_answer(const ControlRequest& request);
  std::optional<Bytes> descriptor(u8 kind, u8 number) const;
  std::optional<Bytes> streaming_answer(const ControlRequest& request, std::span<const u8> sent);
  void start();

  std::span<const VideoMode> modes_;
  const CameraScript& script_;
  EventLog& log_;
  StreamAgreement agreement_;
  UvcControls controls_;
  std::optional<PayloadStream> stream_;
  std::uint64_t sent_before_ = 0;
};

}  // namespace onestroke::usb

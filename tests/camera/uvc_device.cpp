#include "uvc_device.h"

#include <linux/usb/ch9.h>
#include <linux/usb/video.h>

namespace onestroke::usb {

UvcDevice::UvcDevice(std::span<const VideoMode> modes, const CameraScript& script, EventLog& log)
    : modes_(modes), script_(script), log_(log), agreement_(modes, script.rate), controls_(log) {}

std::optional<Bytes> UvcDevice::answer(const ControlRequest& request, std::span<const u8> sent) {
  std::optional<Bytes> out;
  if ((request.type & USB_TYPE_MASK) == USB_TYPE_STANDARD)
    out = standard_answer(request);
  else if ((request.type & USB_TYPE_MASK) != USB_TYPE_CLASS)
    return std::nullopt;
  else if ((request.index & 0xff) == streaming_interface)
    out = streaming_answer(request, sent);
  else
    out = controls_.answer(request.request, static_cast<u8>(request.index >> 8), static_cast<u8>(request.value >> 8),
                           sent);
  if (out && out->size() > request.length) out->resize(request.length);
  return out;
}

std::optional<Bytes> UvcDevice::standard_answer(const ControlRequest& request) {
  switch (request.request) {
    case USB_REQ_GET_DESCRIPTOR:
      return descriptor(static_cast<u8>(request.value >> 8), static_cast<u8>(request.value));
    case USB_REQ_GET_STATUS:
      return Bytes{0, 0};
    case USB_REQ_CLEAR_FEATURE:
      // How Linux's driver ends a stream of bulk transfers.
      if ((request.type & USB_RECIP_MASK) == USB_RECIP_ENDPOINT && request.index == stream_endpoint) stop();
      return Bytes{};
    case USB_REQ_GET_CONFIGURATION:
      return Bytes{1};
    case USB_REQ_GET_INTERFACE:
      return Bytes{0};
    case USB_REQ_SET_FEATURE:
    case USB_REQ_SET_CONFIGURATION:
    case USB_REQ_SET_INTERFACE:
      return Bytes{};
    default:
      return std::nullopt;
  }
}

std::optional<Bytes> UvcDevice::descriptor(u8 kind, u8 number) const {
  switch (kind) {
    case USB_DT_DEVICE:
      return device_descriptor();
    case USB_DT_DEVICE_QUALIFIER:
      return qualifier_descriptor();
    case USB_DT_CONFIG:
      return configuration_descriptor(modes_, script_.rate);
    case USB_DT_STRING:
      return string_descriptor(number, "Played camera", "0001");
    default:
      return std::nullopt;
  }
}

std::optional<Bytes> UvcDevice::streaming_answer(const ControlRequest& request, std::span<const u8> sent) {
  const auto selector = static_cast<u8>(request.value >> 8);
  std::optional<Bytes> out = agreement_.answer(request.request, selector, sent);
  if (out && request.request == UVC_SET_CUR && selector == UVC_VS_COMMIT_CONTROL) start();
  return out;
}

void UvcDevice::start() {
  stop();
  const Agreed& agreed = agreement_.committed();
  const VideoMode& mode = modes_[agreed.mode];
  stream_.emplace(mode, Duration{agreed.interval * std::int64_t{100}}, script_, log_);
  log_.add("stream", {{"on", true},
                      {"format", word_of(mode.format)},
                      {"width", mode.width},
                      {"height", mode.height},
                      {"interval_us", agreed.interval / 10}});
}

void UvcDevice::stop() {
  if (!stream_) return;
  sent_before_ += stream_->sent();
  stream_.reset();
  log_.add("stream", {{"on", false}});
}

}  // namespace onestroke::usb

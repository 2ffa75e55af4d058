#include "uvc_descriptors.h"

#include <linux/usb/ch9.h>
#include <linux/usb/video.h>

#include <algorithm>
#include <cmath>

namespace onestroke::usb {
namespace {

constexpr u8 output_terminal = 3;
constexpr u8 video_class = USB_CLASS_VIDEO, class_interface = USB_DT_CS_INTERFACE;

// Which controls there are: bits of UVC 1.0's tables 3-6 and 3-8.
constexpr u8 exposure_mode_and_time = 1U << 1 | 1U << 3;
constexpr u16 brightness_contrast_saturation = 1U << 0 | 1U << 1 | 1U << 3;
constexpr u16 white_balance_and_auto = 1U << 6 | 1U << 12, gain = 1U << 9;

void append_control_interface(Bytes& out) {
  append_descriptor(out, u8{USB_DT_INTERFACE}, control_interface, u8{0}, u8{0}, video_class, u8{UVC_SC_VIDEOCONTROL},
                    u8{0}, u8{2});
  const std::size_t header = out.size();
  append_descriptor(out, class_interface, u8{UVC_VC_HEADER}, u16{0x0100}, u16{0}, clock_hz, u8{1}, streaming_interface);
  append_descriptor(out, class_interface, u8{UVC_VC_INPUT_TERMINAL}, camera_terminal, u16{UVC_ITT_CAMERA}, u8{0}, u8{0},
                    u16{0}, u16{0}, u16{0}, u8{3}, exposure_mode_and_time, u16{0});
  append_descriptor(out, class_interface, u8{UVC_VC_PROCESSING_UNIT}, processing_unit, camera_terminal, u16{0}, u8{2},
                    static_cast<u16>(brightness_contrast_saturation | white_balance_and_auto | gain), u8{0});
  append_descriptor(out, class_interface, u8{UVC_VC_OUTPUT_TERMINAL}, output_terminal, u16{UVC_TT_STREAMING}, u8{0},
                    processing_unit, u8{0});
  put(out, header + 5, static_cast<u16>(out.size() - header));
}

void append_format(Bytes& out, VideoFormat format, u8 index, u8 frames) {
  constexpr u8 default_frame = 1;
  if (format == VideoFormat::mjpeg) {
    append_descriptor(out, class_interface, u8{UVC_VS_FORMAT_MJPEG}, index, frames, u8{1}, default_frame, u32{0});
    return;
  }
  // The format's GUID begins with its name.
  append_descriptor(out, class_interface, u8{UVC_VS_FORMAT_UNCOMPRESSED}, index, frames, u8{'Y'}, u8{'U'}, u8{'Y'},
                    u8{'2'}, u16{0}, u16{0x10}, u8{0x80}, u8{0}, u8{0}, u8{0xaa}, u8{0}, u8{0x38}, u8{0x9b}, u8{0x71},
                    u8{16}, default_frame, u32{0});
}

void append_frame(Bytes& out, const VideoMode& mode, u8 index, u32 interval) {
  const double seconds = interval * 1e-7;
  const auto bits = static_cast<u32>(std::min(8 * mode.picture_bytes() / seconds, 4e9));
  append_descriptor(out, class_interface,
                    static_cast<u8>(mode.format == VideoFormat::mjpeg ? UVC_VS_FRAME_MJPEG : UVC_VS_FRAME_UNCOMPRESSED),
                    index, u8{0}, mode.width, mode.height, bits / 6, bits, mode.picture_bytes(), interval, u8{3},
                    interval, 2 * interval, 6 * interval);
}

void append_streaming_interface(Bytes& out, std::span<const VideoMode> modes, u32 interval) {
  append_descriptor(out, u8{USB_DT_INTERFACE}, streaming_interface, u8{0}, u8{1}, video_class,
                    u8{UVC_SC_VIDEOSTREAMING}, u8{0}, u8{0});
  const std::vector<ModeIndex> indices = index_modes(modes);
  const u8 formats = indices.back().format;
  const std::size_t header = out.size();
  append(out, static_cast<u8>(13 + formats), class_interface, u8{UVC_VS_INPUT_HEADER}, formats, u16{0}, stream_endpoint,
         u8{0}, output_terminal, u8{0}, u8{0}, u8{0}, u8{1});
  out.resize(out.size() + formats);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (indices[i].frame == 1)
      append_format(out, modes[i].format, indices[i].format,
                    static_cast<u8>(std::ranges::count(indices, indices[i].format, &ModeIndex::format)));
    append_frame(out, modes[i], indices[i].frame, interval);
    // Colours are those of BT.601 with its curve of BT.709.
    if (i + 1 == modes.size() || indices[i + 1].frame == 1)
      append_descriptor(out, class_interface, u8{UVC_VS_COLORFORMAT}, u8{1}, u8{1}, u8{4});
  }
  put(out, header + 4, static_cast<u16>(out.size() - header));
  append_descriptor(out, u8{USB_DT_ENDPOINT}, stream_endpoint, u8{USB_ENDPOINT_XFER_BULK}, u16{512}, u8{0});
}

}  // namespace

std::vector<ModeIndex> index_modes(std::span<const VideoMode> modes) {
  std::vector<ModeIndex> indices;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (i == 0)
      indices.push_back({1, 1});
    else if (modes[i].format == modes[i - 1].format)
      indices.push_back({indices.back().format, static_cast<u8>(indices.back().frame + 1)});
    else
      indices.push_back({static_cast<u8>(indices.back().format + 1), 1});
  }
  return indices;
}

u32 frame_interval(double rate) {
  return static_cast<u32>(std::lround(1e7 / rate));
}

Bytes device_descriptor() {
  Bytes out;
  append_descriptor(out, u8{USB_DT_DEVICE}, u16{0x0200}, u8{USB_CLASS_MISC}, u8{2}, u8{1}, u8{64}, vendor_id,
                    product_id, device_release, u8{1}, u8{2}, u8{3}, u8{1});
  return out;
}

Bytes qualifier_descriptor() {
  Bytes out;
  append_descriptor(out, u8{USB_DT_DEVICE_QUALIFIER}, u16{0x0200}, u8{USB_CLASS_MISC}, u8{2}, u8{1}, u8{64}, u8{1},
                    u8{0});
  return out;
}

Bytes configuration_descriptor(std::span<const VideoMode> modes, double rate) {
  Bytes out;
  constexpr u8 bus_powered = 0x80, half_an_ampere = 250;
  append_descriptor(out, u8{USB_DT_CONFIG}, u16{0}, u8{2}, u8{1}, u8{0}, bus_powered, half_an_ampere);
  append_descriptor(out, u8{USB_DT_INTERFACE_ASSOCIATION}, control_interface, u8{2}, video_class,
                    u8{UVC_SC_VIDEO_INTERFACE_COLLECTION}, u8{0}, u8{0});
  append_control_interface(out);
  append_streaming_interface(out, modes, frame_interval(rate));
  put(out, 2, static_cast<u16>(out.size()));
  return out;
}

std::optional<Bytes> string_descriptor(u8 number, const std::string& product, const std::string& serial) {
  constexpr u16 english = 0x0409;
  Bytes out{0, USB_DT_STRING};
  const std::string maker = "onestroke";
  switch (number) {
    case 0:
      append(out, english);
      break;
    case 1:
    case 2:
    case 3:
      for (const char c : number == 1 ? maker : number == 2 ? product : serial) append(out, static_cast<u16>(c));
      break;
    default:
      return std::nullopt;
  }
  out[0] = static_cast<u8>(out.size());
  return out;
}

}  // namespace onestroke::usb

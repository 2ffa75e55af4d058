#pragma once

#include "bytes.h"
#include "video_mode.h"

#include <optional>
#include <span>
#include <string>

namespace onestroke::usb {

/// The parts of the camera, by the numbers its descriptors give them.
constexpr u8 control_interface = 0, streaming_interface = 1;
constexpr u8 camera_terminal = 1, processing_unit = 2;
constexpr u8 stream_endpoint = 0x81;  ///< Bulk, in.
constexpr u16 vendor_id = 0x1d6b, product_id = 0x0102;
constexpr u16 device_release = 0x0100;
constexpr u32 clock_hz = 48'000'000;  ///< Of the times in the payloads' headers.

/// Where a mode is among the formats and among the frames of its format, both from 1.
struct ModeIndex {
  u8 format = 1, frame = 1;
};

/// The modes as the descriptors count them; those of a format come after one another.
std::vector<ModeIndex> index_modes(std::span<const VideoMode> modes);

/// USB 2.0's device descriptor, chapter 9.6.1.
Bytes device_descriptor();
/// The qualifier of a device of high speed, chapter 9.6.2.
Bytes qualifier_descriptor();
/// All of the configuration: the interfaces of USB Video Class 1.0 with the modes at `rate` pictures a second, half and
/// a sixth of it.
Bytes configuration_descriptor(std::span<const VideoMode> modes, double rate);
/// A string of the device by its number, none where it has no such string.
std::optional<Bytes> string_descriptor(u8 number, const std::string& product, const std::string& serial);

/// Units of 100 ns from one picture to the next.
u32 frame_interval(double rate);

}  // namespace onestroke::usb

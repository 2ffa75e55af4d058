#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace onestroke::usb {

enum class VideoFormat { mjpeg, yuyv };

/// One file of a folder, as it is.
struct PlayedPicture {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// A format and size that the camera offers, with the pictures it plays in it.
struct VideoMode {
  VideoFormat format = VideoFormat::mjpeg;
  std::uint16_t width = 0, height = 0;
  std::vector<PlayedPicture> pictures;  ///< At least one, in the order of their names.

  /// The most bytes that a picture has.
  std::uint32_t picture_bytes() const { return 2U * width * height; }
};

/// Reads "MJPG:640x480:FOLDER" or "YUYV:640x480:FOLDER" and the folder's files. Throws Error where the folder has none
/// or one of another size, and UsageError where the words are wrong.
VideoMode read_video_mode(const std::string& text);

/// The name that format has in the words above.
const char* word_of(VideoFormat format);

}  // namespace onestroke::usb

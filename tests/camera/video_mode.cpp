#include "video_mode.h"

#include "core/error.h"

#include <algorithm>
#include <fstream>
#include <regex>

namespace onestroke::usb {
namespace {

std::vector<std::uint8_t> read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  std::vector<std::uint8_t> bytes(in ? static_cast<std::size_t>(in.tellg()) : 0);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw Error(file.string() + " cannot be read; check that you may");
  return bytes;
}

std::vector<PlayedPicture> read_folder(const std::filesystem::path& folder) {
  std::vector<PlayedPicture> pictures;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    pictures.push_back({entry.path().filename().string(), read_file(entry.path())});
  if (failed || pictures.empty()) throw Error(folder.string() + " holds no pictures; give a folder that does");
  std::ranges::sort(pictures, {}, &PlayedPicture::name);
  return pictures;
}

}  // namespace

VideoMode read_video_mode(const std::string& text) {
  static const std::regex form("(MJPG|YUYV):(\\d{1,4})x(\\d{1,4}):(.+)");
  std::smatch part;
  if (!std::regex_match(text, part, form))
    throw UsageError("--format " + text +
                     " is not possible; give MJPG:WIDTHxHEIGHT:FOLDER or YUYV:WIDTHxHEIGHT:FOLDER");
  VideoMode mode{part[1] == "MJPG" ? VideoFormat::mjpeg : VideoFormat::yuyv,
                 static_cast<std::uint16_t>(std::stoi(part[2])), static_cast<std::uint16_t>(std::stoi(part[3])),
                 read_folder(part[4].str())};
  for (const PlayedPicture& picture : mode.pictures) {
    const bool fits = mode.format == VideoFormat::yuyv ? picture.bytes.size() == mode.picture_bytes()
                                                       : picture.bytes.size() <= mode.picture_bytes();
    if (picture.bytes.empty() || !fits) throw Error(picture.name + " has not the size of a picture of " + text);
  }
  return mode;
}

const char* word_of(VideoFormat format) {
  return format == VideoFormat::mjpeg ? "MJPG" : "YUYV";
}

}  // namespace onestroke::usb

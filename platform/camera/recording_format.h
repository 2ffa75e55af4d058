#pragma once

#include "core/frame_record.h"
#include "core/picture.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace onestroke {

/// A folder of files that `--record` writes, `folder:DIR` reads and other programs can read, too; the README.txt in it
/// explains it to a person (recording_readme()).
inline constexpr int recording_format = 1;

namespace recording_files {
inline constexpr const char* header = "recording.json";
inline constexpr const char* lines = "pictures.jsonl";
inline constexpr const char* catalog = "catalog.json";
inline constexpr const char* readme = "README.txt";
inline constexpr const char* pictures = "pictures";  ///< A folder of JPEG files.
inline constexpr const char* video = "pictures.mkv";
inline constexpr const char* second_video = "second.mkv";
}  // namespace recording_files

/// What holds for all pictures.
struct RecordingHeader {
  std::string program{};  ///< The version that wrote it.
  std::string camera{};   ///< As for --camera.
  double rate = 0;        ///< Pictures a second as the camera said it; 0 where it did not.
};

/// Where in a video a picture is.
struct VideoPlace {
  std::uint64_t frame = 0;  ///< From 0.
  std::int64_t ms = 0;      ///< By the video's own clock.
};

/// One picture without its pixels.
struct StoredPicture {
  std::uint64_t sequence = 0;
  Exposure exposure;
  PixelFormat format = PixelFormat::rgb8;  ///< Of the planes that the tracker saw.
  PictureLens lens;
  Pose T_world_camera;
  std::string source{};               ///< What its camera calls it.
  std::string file{};                 ///< In the recording's folder.
  std::optional<VideoPlace> video{};  ///< Where the file is a video.
};

/// What a camera gave at a time: a picture, or a pair of two.
struct StoredShot {
  StoredPicture picture;
  std::optional<StoredPicture> second{};
};

/// All but where the pixels are.
StoredPicture stored_picture(const Picture& picture);

std::string header_text(const RecordingHeader& header);
/// Throws Error where the text is no recording's header or that of a newer format.
RecordingHeader header_of_text(const std::string& text);

/// The lines of a recording, without their ends. A lens is written where it is another than that of the line before.
class RecordingLines {
 public:
  std::string line(const StoredShot& shot, const FrameRecord& record);
  static std::string left_out(std::uint64_t pictures);

  /// The way back, without the record; none where the line tells of pictures that were left out, which are added to
  /// `left_out`. Throws Error.
  std::optional<StoredShot> shot_of(const std::string& line, std::uint64_t& left_out);

 private:
  PictureLens lens_, second_lens_;
};

/// What was tracked when the picture was taken. Throws Error.
void record_of_line(const std::string& line, FrameRecord& record);

/// README.txt.
extern const char* const recording_readme;

}  // namespace onestroke

#pragma once

#include "camera/lossless_video.h"
#include "camera/recording_format.h"
#include "marker/catalog.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace onestroke {

/// Writes a recording's folder. What write() has written can be read, whatever happens afterwards. One thread.
class RecordingWriter {
 public:
  /// Makes the folder, or takes an empty one. Throws Error where it is not empty or cannot be written.
  RecordingWriter(std::filesystem::path folder, const RecordingHeader& header, const Catalog& catalog);

  /// A picture, and the right eye's where there is one; each as JPEG where it has one, otherwise its planes. Throws
  /// Error where that cannot be written, or the pictures change their size.
  void write(const Picture& picture, const FrameRecord& record);
  /// So many pictures are missing here. Throws Error likewise.
  void leave_out(std::uint64_t pictures);
  /// Throws Error likewise. Nothing is written after it.
  void finish();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  StoredPicture store(const Picture& picture, std::optional<LosslessVideo>& video, const char* video_name,
                      const char* jpeg_ending);
  void write_file(const std::filesystem::path& file, std::string_view bytes) const;
  void write_line(const std::string& line);

  const std::filesystem::path folder_;
  std::ofstream lines_;
  RecordingLines format_;
  std::optional<LosslessVideo> video_, second_video_;
  std::uint64_t shots_ = 0;
};

}  // namespace onestroke

#include "camera/recording_writer.h"

#include "core/error.h"

#include <array>
#include <cstdio>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& file) {
  return Error(file.string() + " cannot be written; check that you may write there and that the disk is not full");
}

fs::path made(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder / recording_files::pictures, failed);
  if (failed) throw Error("folder " + folder.string() + " cannot be made; check that you may write there");
  return folder;
}

fs::path checked(fs::path folder) {
  std::error_code failed;
  if (!fs::exists(folder, failed)) return folder;
  if (!fs::is_directory(folder, failed))
    throw Error(folder.string() + " is no folder; name a new one for the recording");
  if (!fs::is_empty(folder, failed) || failed)
    throw Error("folder " + folder.string() + " is not empty; name a new one for the recording");
  return folder;
}

}  // namespace

RecordingWriter::RecordingWriter(fs::path folder, const RecordingHeader& header, const Catalog& catalog)
    : folder_(made(checked(std::move(folder)))) {
  write_file(folder_ / recording_files::readme, recording_readme);
  write_file(folder_ / recording_files::catalog, to_json(catalog));
  lines_.open(folder_ / recording_files::lines, std::ios::binary);
  if (!lines_) throw cannot_write(folder_ / recording_files::lines);
  // The last, since a folder is a recording by it.
  write_file(folder_ / recording_files::header, header_text(header));
}

void RecordingWriter::write(const Picture& picture, const FrameRecord& record) {
  StoredShot shot{.picture = store(picture, video_, recording_files::video, ".jpg")};
  if (picture.second) shot.second = store(*picture.second, second_video_, recording_files::second_video, "_second.jpg");
  write_line(format_.line(shot, record));
  ++shots_;
}

StoredPicture RecordingWriter::store(const Picture& picture, std::optional<LosslessVideo>& video,
                                     const char* video_name, const char* jpeg_ending) {
  StoredPicture stored = stored_picture(picture);
  if (!picture.jpeg.empty()) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%06llu", static_cast<unsigned long long>(shots_));
    stored.file = std::string(recording_files::pictures) + "/" + number.data() + jpeg_ending;
    write_file(folder_ / stored.file, {reinterpret_cast<const char*>(picture.jpeg.data()), picture.jpeg.size()});
    return stored;
  }
  if (!video) video.emplace(folder_ / video_name, picture);
  if (!video->takes(picture))
    throw Error("the pictures of " + folder_.string() + " changed their size or format; record them anew");
  stored.file = video_name;
  stored.video = video->add(picture);
  return stored;
}

void RecordingWriter::leave_out(std::uint64_t pictures) {
  write_line(RecordingLines::left_out(pictures));
}

void RecordingWriter::finish() {
  for (std::optional<LosslessVideo>* video : {&video_, &second_video_})
    if (*video) (*video)->finish();
  lines_.close();
  if (!lines_) throw cannot_write(folder_ / recording_files::lines);
}

void RecordingWriter::write_file(const fs::path& file, std::string_view bytes) const {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw cannot_write(file);
}

void RecordingWriter::write_line(const std::string& line) {
  lines_ << line << '\n' << std::flush;
  if (!lines_) throw cannot_write(folder_ / recording_files::lines);
}

}  // namespace onestroke

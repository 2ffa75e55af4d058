#include "camera/recording_camera.h"

#include "camera/jpeg_decoder.h"
#include "camera/lossless_video.h"
#include "camera/picture_file.h"
#include "camera/recording_format.h"
#include "camera/video_stream.h"
#include "core/error.h"
#include "core/picture_planes.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

std::vector<StoredShot> read_shots(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error("recording " + file.string() + " cannot be read; check that you may read it");
  std::vector<StoredShot> shots;
  RecordingLines format;
  std::uint64_t left_out = 0, number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    try {
      if (auto shot = format.shot_of(line, left_out)) shots.push_back(std::move(*shot));
    } catch (const Error& error) {
      // Its writer was ended by force.
      if (in.eof()) break;
      throw Error("recording " + file.string() + ", line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (shots.empty()) throw Error("recording " + file.string() + " holds no picture; give another");
  return shots;
}

RecordingHeader read_header(const fs::path& folder) {
  const fs::path file = folder / recording_files::header;
  std::ifstream in(file, std::ios::binary);
  try {
    return header_of_text({std::istreambuf_iterator<char>(in), {}});
  } catch (const Error& error) {
    throw Error("recording " + file.string() + ": " + error.what());
  }
}

std::size_t bytes_of(const StoredPicture& p) {
  return plane_bytes(p.format, p.lens.width, p.lens.height);
}

class RecordingCamera final : public RecordedCamera {
 public:
  RecordingCamera(const fs::path& folder, const LensSource& lens, std::optional<Duration> readout)
      : RecordedCamera("recording " + folder.string()),
        folder_(folder),
        header_(read_header(folder)),
        shots_(read_shots(folder / recording_files::lines)) {
    std::size_t bytes = 0;
    for (StoredShot& shot : shots_) {
      if (lens.known())
        shot.picture.lens.intrinsics = lens.intrinsics(shot.picture.lens.width, shot.picture.lens.height, name());
      for (StoredPicture* eye : {&shot.picture, shot.second ? &*shot.second : nullptr})
        if (eye && readout) eye->exposure.readout = *readout;
      bytes = std::max(bytes, bytes_of(shot.picture) + (shot.second ? bytes_of(*shot.second) : 0));
    }
    set_buffers(bytes);
    set_first(shots_.front().picture.exposure.start, shots_.front().picture.sequence);
  }

  double rate() const override { return header_.rate; }

 protected:
  std::size_t pictures() const override { return shots_.size(); }

  bool read(PictureHandle::Loan& loan) override {
    if (next_ == shots_.size()) return false;
    const StoredShot& shot = shots_[next_];
    std::uint8_t* bytes = pool().bytes(loan).data();
    if (!fill(shot.picture, bytes, loan.picture)) return false;
    if (shot.second) {
      Picture& second = seconds_[pool().index(loan)] = {};
      if (!fill(*shot.second, bytes + bytes_of(shot.picture), second)) return false;
      shift(second);
      loan.picture.second = &second;
    }
    ++next_;
    return true;
  }

  bool go_to(Duration after_start) override {
    const auto late = [&](const StoredShot& shot) { return shot.picture.exposure.start - began() >= after_start; };
    next_ = static_cast<std::size_t>(std::ranges::find_if(shots_, late) - shots_.begin());
    return next_ < shots_.size();
  }

 private:
  bool fill(const StoredPicture& stored, std::uint8_t* bytes, Picture& p) {
    p.width = stored.lens.width;
    p.height = stored.lens.height;
    p.format = stored.format;
    p.sequence = stored.sequence;
    p.exposure = stored.exposure;
    p.intrinsics = stored.lens.intrinsics;
    p.T_world_camera = stored.T_world_camera;
    p.source = stored.source.c_str();
    set_planes(p, bytes);
    const std::string wrong = stored.video ? read_frame(stored, p, bytes) : read_jpeg(stored, p, bytes);
    if (!wrong.empty()) fail(name() + ": " + stored.file + " " + wrong);
    return wrong.empty();
  }

  std::string read_frame(const StoredPicture& stored, const Picture& picture, std::uint8_t* bytes) {
    try {
      VideoStream& video = videos_.try_emplace(stored.file, folder_ / stored.file, 1).first->second;
      const std::uint64_t wanted = stored.video->frame;
      const bool ahead = video.started() && video.number() < wanted && video.number() + farthest_ahead > wanted;
      if (!ahead && (wanted > 0 || video.started()))
        video.go_to(Duration::from_ms(static_cast<double>(stored.video->ms)));
      const AVFrame* frame = video.next();
      while (frame && video.number() < wanted) frame = video.next();
      if (frame && video.number() == wanted && unpack_frame(*frame, picture, bytes)) return {};
    } catch (const Error& error) {
      return error.what();
    }
    return "lacks picture " + std::to_string(stored.video->frame) + ": it was changed or is damaged";
  }

  std::string read_jpeg(const StoredPicture& stored, const Picture& p, std::uint8_t* bytes) {
    if (!read_whole_file(folder_ / stored.file, jpeg_)) return "cannot be opened";
    const auto result = stored.format == PixelFormat::rgb8
                            ? decoder_.decode(jpeg_, {p.width, p.height}, bytes, p.strides[0])
                            : JpegDecoder::Result::damaged;
    if (result != JpegDecoder::Result::ok) return "cannot be decoded: it was changed or is damaged";
    return {};
  }

  // Decoding so many pictures is quicker than finding another place.
  static constexpr std::uint64_t farthest_ahead = 30;

  const fs::path folder_;
  const RecordingHeader header_;
  std::vector<StoredShot> shots_;
  std::size_t next_ = 0;
  std::map<std::string, VideoStream> videos_;
  JpegDecoder decoder_;
  std::vector<std::uint8_t> jpeg_;
  std::array<Picture, buffers> seconds_;
};

}  // namespace

bool is_recording(const fs::path& folder) {
  std::error_code unknown;
  return fs::is_regular_file(folder / recording_files::header, unknown);
}

std::unique_ptr<RecordedCamera> open_recording(const fs::path& folder, const LensSource& lens,
                                               std::optional<Duration> readout) {
  return std::make_unique<RecordingCamera>(folder, lens, readout);
}

}  // namespace onestroke

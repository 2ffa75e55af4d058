#include "camera/video_camera.h"

#include "camera/frame_pixels.h"
#include "camera/video_stream.h"
#include "core/error.h"

#include <array>
#include <cstdio>

namespace onestroke {
namespace {

constexpr std::size_t name_length = 32;

class VideoCamera final : public RecordedCamera {
 public:
  VideoCamera(const std::filesystem::path& file, const LensSource& lens, Duration readout)
      : RecordedCamera("video " + file.string()), stream_(file), readout_(readout) {
    const AVFrame* first = stream_.next();
    if (!first) throw Error(name() + " holds no picture that can be decoded; give another");
    pixels_.emplace(*first, checked_turn());
    intrinsics_ = lens.intrinsics(pixels_->width(), pixels_->height(), file.string());
    set_buffers(pixels_->bytes());
    set_first({}, 0);
    ahead_ = first;
  }

  double rate() const override { return stream_.rate(); }

 protected:
  std::size_t pictures() const override { return stream_.length(); }

  bool read(PictureHandle::Loan& loan) override {
    const AVFrame* frame = ahead_ ? std::exchange(ahead_, nullptr) : stream_.next();
    if (!frame) {
      if (stream_.cut_short())
        fail(name() + " ends after " + std::to_string(stream_.number() + 1) + " of " +
             std::to_string(stream_.length()) + " pictures: it is cut short or damaged");
      return false;
    }
    if (!pixels_->fill(*frame, pool().bytes(loan).data(), loan.picture)) {
      fail(name() + " changes its size after " + std::to_string(stream_.number()) + " pictures; split it");
      return false;
    }
    Picture& p = loan.picture;
    p.sequence = stream_.number();
    p.exposure = {Time{stream_.time().ns}, {}, readout_};
    p.intrinsics = intrinsics_;
    std::array<char, name_length>& text = names_[pool().index(loan)];
    std::snprintf(text.data(), text.size(), "frame_%06llu", static_cast<unsigned long long>(p.sequence));
    p.source = text.data();
    return true;
  }

  bool go_to(Duration after_start) override {
    ahead_ = nullptr;
    return stream_.go_to(after_start);
  }

 private:
  int checked_turn() const {
    const int turn = stream_.turn();
    if (turn < 0) throw Error(name() + " is to be shown mirrored or turned by less than a right angle; write it anew");
    // Rows of the sensor are read one after the other, and columns would be then.
    if (turn != 0 && readout_.ns != 0)
      throw Error(name() + " is to be turned by " + std::to_string(turn) +
                  " degrees, so that its rows are not the sensor's; leave out --readout-ms");
    return turn;
  }

  VideoStream stream_;
  const Duration readout_;
  std::optional<FramePixels> pixels_;
  Intrinsics intrinsics_;
  const AVFrame* ahead_;  // the first picture, until it is read
  std::array<std::array<char, name_length>, buffers> names_{};
};

}  // namespace

std::unique_ptr<RecordedCamera> open_video(const std::filesystem::path& file, const LensSource& lens,
                                           Duration readout) {
  return std::make_unique<VideoCamera>(file, lens, readout);
}

}  // namespace onestroke

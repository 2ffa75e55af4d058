#pragma once

#include "camera/capture.h"
#include "camera/jpeg_decoder.h"
#include "camera/stamp_clock.h"
#include "core/picture_pool.h"

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

namespace onestroke {

/// A device's stream and the memory of its pictures, from start to stop and until the last picture is given back. One
/// thread, but for the handles, which any thread may release.
class LiveSession final : private PictureHandle::Lender {
 public:
  /// So many pictures may be held by tracker, renderer and what lies between them while the device goes on.
  static constexpr std::size_t held = 5, pictures = held + 2;

  /// The waker, which outlives the session, is woken by what comes back.
  LiveSession(std::unique_ptr<CaptureStream> stream, Waker& waker);

  CaptureStream& stream() { return *stream_; }
  const CaptureFormat& format() const { return stream_->format(); }
  /// Whether pictures lie in the device's own memory.
  bool lends() const { return !pool_; }
  /// How often the bytes of a picture are written before the tracker sees them: 0 or 1.
  int copies() const { return lends() ? 0 : 1; }

  /// Gives the device the buffers again that have come back.
  void requeue() noexcept;
  enum class Made { ok, damaged, full };
  /// Makes a picture of a capture, whose buffer belongs to the picture or to the device afterwards. `full`: every
  /// buffer is lent.
  Made make(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept;

  /// Every buffer is lent, so that the device cannot go on.
  bool starved() const noexcept;
  /// No handle is left. Any thread may release one; asked by the session's own.
  bool idle() const noexcept;

 private:
  enum class Place { device, out, back };
  struct Lent : PictureHandle::Loan {
    std::atomic<Place> place{Place::device};
  };

  void give_back(PictureHandle::Loan& loan) noexcept override;
  Made lend(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept;
  Made copy(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept;
  Picture in_device(const Capture& capture, const Picture& about) const noexcept;
  bool fill(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept;
  bool decode(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept;

  std::unique_ptr<CaptureStream> stream_;
  Waker& waker_;
  JpegDecoder jpeg_;
  std::vector<std::vector<std::uint8_t>> jpegs_;  // by the pool's index, as they came
  std::unique_ptr<Lent[]> lent_;                  // by buffer, where the device's own are lent
  std::optional<PicturePool> pool_;               // otherwise
};

}  // namespace onestroke

#include "camera/live_session.h"

#include "camera/picture_file.h"

#include <algorithm>
#include <cstring>

namespace onestroke {
namespace {

constexpr std::size_t rows_of(std::size_t index, const PictureSize& size) {
  const auto height = static_cast<std::size_t>(size.height);
  return index == 0 ? height : (height + 1) / 2;
}

std::size_t row_bytes(CaptureCoding coding, std::size_t index, int width) {
  const auto w = static_cast<std::size_t>(width), even = (w + 1) / 2 * 2;
  switch (coding) {
    case CaptureCoding::nv12:
      return index == 0 ? w : even;
    case CaptureCoding::yuyv:
      return index == 0 ? 2 * even : 0;
    case CaptureCoding::rgb8:
    case CaptureCoding::bgr8:
    case CaptureCoding::mjpeg:
      break;
  }
  return index == 0 ? 3 * w : 0;
}

constexpr std::size_t planes = 2;

std::size_t packed_bytes(const CaptureFormat& format) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < planes; ++i)
    bytes += row_bytes(format.coding, i, format.size.width) * rows_of(i, format.size);
  return bytes;
}

/// What the device must have sent for a picture to be whole, and must have room for.
bool has_rows(const CaptureStream& stream, const Capture& capture) {
  const CaptureFormat& format = stream.format();
  std::size_t needed = 0;
  for (std::size_t i = 0; i < planes; ++i) {
    const std::size_t row = row_bytes(format.coding, i, format.size.width), rows = rows_of(i, format.size);
    if (row == 0) continue;
    // The last row may end without its padding.
    const std::size_t plane = format.strides.at(i) * (rows - 1) + row;
    if (format.strides.at(i) < row || stream.plane(capture.buffer, i).size() < plane) return false;
    needed += plane;
  }
  return capture.bytes >= needed;
}

PixelFormat pixel_format(CaptureCoding coding) {
  if (coding == CaptureCoding::nv12) return PixelFormat::nv12;
  return coding == CaptureCoding::yuyv ? PixelFormat::yuyv : PixelFormat::rgb8;
}

}  // namespace

LiveSession::LiveSession(std::unique_ptr<CaptureStream> stream, Waker& waker)
    : stream_(std::move(stream)), waker_(waker) {
  const CaptureCoding coding = format().coding;
  const bool as_it_is = coding != CaptureCoding::mjpeg && coding != CaptureCoding::bgr8;
  if (as_it_is && stream_->buffers() >= pictures) {
    lent_ = std::make_unique<Lent[]>(stream_->buffers());
    for (std::size_t i = 0; i < stream_->buffers(); ++i) lent_[i].lender = this;
    return;
  }
  pool_.emplace(pictures, packed_bytes(format()));
  if (coding != CaptureCoding::mjpeg) return;
  jpegs_.resize(pictures);
  for (auto& jpeg : jpegs_) jpeg.reserve(stream_->plane(0, 0).size());
}

void LiveSession::requeue() noexcept {
  for (std::size_t i = 0; lends() && i < stream_->buffers(); ++i) {
    if (lent_[i].place.load(std::memory_order_acquire) != Place::back) continue;
    lent_[i].place.store(Place::device, std::memory_order_relaxed);
    stream_->give(i);
  }
}

bool LiveSession::idle() const noexcept {
  if (!lends()) return pool_->lent() == 0;
  return std::none_of(lent_.get(), lent_.get() + stream_->buffers(),
                      [](const Lent& lent) { return lent.place.load(std::memory_order_acquire) == Place::out; });
}

bool LiveSession::starved() const noexcept {
  if (!lends()) return false;
  return std::all_of(lent_.get(), lent_.get() + stream_->buffers(),
                     [](const Lent& lent) { return lent.place.load(std::memory_order_acquire) == Place::out; });
}

void LiveSession::give_back(PictureHandle::Loan& loan) noexcept {
  // Once the last one is back this session may be gone.
  Waker& waker = waker_;
  static_cast<Lent&>(loan).place.store(Place::back, std::memory_order_release);
  waker.wake();
}

LiveSession::Made LiveSession::make(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept {
  const bool whole = !capture.damaged && (format().coding == CaptureCoding::mjpeg || has_rows(*stream_, capture));
  if (!whole) {
    stream_->give(capture.buffer);
    return Made::damaged;
  }
  return lends() ? lend(capture, picture, about) : copy(capture, picture, about);
}

LiveSession::Made LiveSession::lend(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept {
  Lent& lent = lent_[capture.buffer];
  lent.picture = about;
  lent.picture.format = pixel_format(format().coding);
  lent.picture.strides = format().strides;
  for (std::size_t i = 0; i < planes; ++i) lent.picture.planes.at(i) = stream_->plane(capture.buffer, i).data();
  lent.place.store(Place::out, std::memory_order_relaxed);
  picture = PictureHandle(lent);
  return Made::ok;
}

LiveSession::Made LiveSession::copy(const Capture& capture, PictureHandle& picture, const Picture& about) noexcept {
  PictureHandle::Loan* const loan = pool_->acquire();
  bool whole = false;
  if (loan) {
    loan->picture = about;
    whole = fill(capture, loan->picture, pool_->bytes(*loan));
    if (!whole) pool_->give_back(*loan);
  }
  stream_->give(capture.buffer);
  if (!loan) return Made::full;
  if (!whole) return Made::damaged;
  picture = PictureHandle(*loan);
  return Made::ok;
}

/// Packs the planes one behind the other.
bool LiveSession::fill(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept {
  const CaptureCoding coding = format().coding;
  const PictureSize& size = format().size;
  p.format = pixel_format(coding);
  std::uint8_t* to = bytes.data();
  for (std::size_t i = 0; i < planes; ++i) {
    p.strides.at(i) = row_bytes(coding, i, size.width);
    p.planes.at(i) = p.strides.at(i) > 0 ? to : nullptr;
    to += p.strides.at(i) * rows_of(i, size);
  }
  if (coding == CaptureCoding::mjpeg) return decode(capture, p, bytes);
  if (coding == CaptureCoding::bgr8) {
    swap_to_rgb(stream_->plane(capture.buffer, 0).data(), format().strides[0], size.width, size.height, bytes.data());
    return true;
  }
  to = bytes.data();
  for (std::size_t i = 0; i < planes && p.planes.at(i); ++i) {
    const std::uint8_t* from = stream_->plane(capture.buffer, i).data();
    for (std::size_t row = 0; row < rows_of(i, size); ++row, from += format().strides.at(i), to += p.strides.at(i))
      std::memcpy(to, from, p.strides.at(i));
  }
  return true;
}

bool LiveSession::decode(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept {
  const auto sent = stream_->plane(capture.buffer, 0);
  std::vector<std::uint8_t>& jpeg = jpegs_[pool_->index(p)];
  // Within what was reserved, so that nothing is allocated.
  const std::size_t length = std::min({capture.bytes, sent.size(), jpeg.capacity()});
  jpeg.assign(sent.begin(), sent.begin() + static_cast<std::ptrdiff_t>(length));
  p.jpeg = jpeg;
  return jpeg_.decode(jpeg, {format().size.width, format().size.height}, bytes.data(), p.strides[0]) ==
         JpegDecoder::Result::ok;
}

}  // namespace onestroke

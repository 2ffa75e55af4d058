#include "camera/live_session.h"

#include "camera/picture_bytes.h"
#include "core/picture_planes.h"

#include <algorithm>

namespace onestroke {
namespace {

PixelFormat pixel_format(CaptureCoding coding) {
  if (coding == CaptureCoding::nv12) return PixelFormat::nv12;
  return coding == CaptureCoding::yuyv ? PixelFormat::yuyv : PixelFormat::rgb8;
}

/// What the device must have sent for a picture to be whole, and must have room for.
bool has_rows(const CaptureStream& stream, const Capture& capture) {
  const CaptureFormat& format = stream.format();
  std::size_t needed = 0;
  for (std::size_t i = 0; i < format.strides.size(); ++i) {
    const PlaneShape shape = plane_shape(pixel_format(format.coding), format.size.width, format.size.height, i);
    if (shape.rows == 0) continue;
    // The last row may end without its padding.
    const std::size_t plane = format.strides.at(i) * (shape.rows - 1) + shape.row_bytes;
    if (format.strides.at(i) < shape.row_bytes || stream.plane(capture.buffer, i).size() < plane) return false;
    needed += plane;
  }
  return capture.bytes >= needed;
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
  pool_.emplace(pictures, plane_bytes(pixel_format(coding), format().size.width, format().size.height));
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
  lent.picture = in_device(capture, about);
  lent.place.store(Place::out, std::memory_order_relaxed);
  picture = PictureHandle(lent);
  return Made::ok;
}

/// The picture where the device put it.
Picture LiveSession::in_device(const Capture& capture, const Picture& about) const noexcept {
  Picture p = about;
  p.format = pixel_format(format().coding);
  p.strides = format().strides;
  for (std::size_t i = 0; i < p.planes.size(); ++i) p.planes.at(i) = stream_->plane(capture.buffer, i).data();
  return p;
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

bool LiveSession::fill(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept {
  const Picture sent = in_device(capture, p);
  p.format = sent.format;
  set_planes(p, bytes.data());
  switch (format().coding) {
    case CaptureCoding::mjpeg:
      return decode(capture, p, bytes);
    case CaptureCoding::bgr8:
      swap_to_rgb(sent.planes[0], sent.strides[0], p.width, p.height, bytes.data());
      return true;
    case CaptureCoding::nv12:
    case CaptureCoding::yuyv:
    case CaptureCoding::rgb8:
      break;
  }
  copy_planes(sent, bytes.data());
  return true;
}

bool LiveSession::decode(const Capture& capture, Picture& p, std::span<std::uint8_t> bytes) noexcept {
  const auto sent = stream_->plane(capture.buffer, 0);
  std::vector<std::uint8_t>& jpeg = jpegs_[pool_->index(p)];
  // Within what was reserved, so that nothing is allocated.
  const std::size_t length = std::min({capture.bytes, sent.size(), jpeg.capacity()});
  jpeg.assign(sent.begin(), sent.begin() + static_cast<std::ptrdiff_t>(length));
  p.jpeg = jpeg;
  return jpeg_.decode(jpeg, format().size, bytes.data(), p.strides[0]) == JpegDecoder::Result::ok;
}

}  // namespace onestroke

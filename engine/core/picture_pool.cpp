#include "core/picture_pool.h"

#include "core/error.h"
#include "core/spsc_queue.h"

#include <memory>

namespace onestroke {

PicturePool::PicturePool(std::size_t count, std::size_t bytes_each) : count_(count), bytes_each_(bytes_each) {
  if (count == 0 || bytes_each == 0) throw Error("a picture pool needs at least one buffer of at least one byte");
  const std::size_t stride = (bytes_each + cache_line - 1) / cache_line * cache_line;
  memory_.resize(stride * count + cache_line);
  void* aligned = memory_.data();
  std::size_t room = memory_.size();
  std::align(cache_line, stride * count, aligned, room);
  buffers_ = std::make_unique<Buffer[]>(count);
  for (std::size_t i = 0; i < count; ++i) {
    buffers_[i].lender = this;
    buffers_[i].bytes = static_cast<std::uint8_t*>(aligned) + i * stride;
  }
}

PictureHandle::Loan* PicturePool::acquire() noexcept {
  for (Buffer& buffer : std::span(buffers_.get(), count_)) {
    if (buffer.lent.load(std::memory_order_relaxed) || buffer.lent.exchange(true, std::memory_order_acquire)) continue;
    buffer.picture = Picture{};
    return &buffer;
  }
  return nullptr;
}

void PicturePool::give_back(PictureHandle::Loan& loan) noexcept {
  static_cast<Buffer&>(loan).lent.store(false, std::memory_order_release);
}

std::span<std::uint8_t> PicturePool::bytes(PictureHandle::Loan& loan) const noexcept {
  return {static_cast<Buffer&>(loan).bytes, bytes_each_};
}

std::size_t PicturePool::index(const PictureHandle::Loan& loan) const noexcept {
  return static_cast<std::size_t>(static_cast<const Buffer*>(&loan) - buffers_.get());
}

std::size_t PicturePool::index(const Picture& picture) const noexcept {
  for (std::size_t i = 0; i < count_; ++i)
    if (&buffers_[i].picture == &picture) return i;
  return count_;
}

std::size_t PicturePool::lent() const noexcept {
  std::size_t sum = 0;
  for (const Buffer& buffer : std::span(buffers_.get(), count_)) sum += buffer.lent.load(std::memory_order_acquire);
  return sum;
}

}  // namespace onestroke

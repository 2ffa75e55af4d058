#pragma once

#include "core/picture.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace onestroke {

/// A fixed number of picture buffers that a camera fills and lends. acquire() and give_back() may be called on any
/// thread and neither lock nor allocate. The pool must outlive every handle to its loans.
class PicturePool : public PictureHandle::Lender {
 public:
  /// Allocates count buffers of bytes_each, aligned to a cache line. Throws Error where either is 0.
  PicturePool(std::size_t count, std::size_t bytes_each);

  /// A free buffer, its Picture blank; nullptr where all are lent. Fill bytes() and loan->picture, then make a
  /// PictureHandle from it, which gives it back at its end, or call give_back() yourself.
  PictureHandle::Loan* acquire() noexcept;
  void give_back(PictureHandle::Loan& loan) noexcept override;

  /// The buffer of a loan of this pool, to write while no handle has been handed on.
  std::span<std::uint8_t> bytes(PictureHandle::Loan& loan) const noexcept;
  /// 0 .. count() - 1: for what a camera keeps beside each buffer.
  std::size_t index(const PictureHandle::Loan& loan) const noexcept;
  /// The same for a picture of a loan of this pool; count() for any other.
  std::size_t index(const Picture& picture) const noexcept;

  std::size_t count() const { return count_; }
  /// How many are lent at this moment; exact only while no other thread lends or returns.
  std::size_t lent() const noexcept;

 private:
  struct Buffer : PictureHandle::Loan {
    std::atomic<bool> lent{false};
    std::uint8_t* bytes = nullptr;
  };

  std::size_t count_, bytes_each_;
  std::vector<std::uint8_t> memory_;
  std::unique_ptr<Buffer[]> buffers_;
};

}  // namespace onestroke

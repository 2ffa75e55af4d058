#pragma once

#include "core/picture.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>

namespace onestroke {

/// A fixed number of loans that lend the pictures of two eyes under one handle, whoever their memory belongs to.
/// acquire() and give_back() may be called on any thread and neither lock nor allocate. The pool must outlive every
/// handle to its loans.
class PairPool final : public PictureHandle::Lender {
 public:
  struct Pair : PictureHandle::Loan {
    std::array<PictureHandle, 2> held;  ///< What the pictures are of: kept until the pair is given back.
    Picture right;

    /// Makes `right` the second of `picture`.
    void join() { picture.second = second = &right; }

   private:
    friend PairPool;
    std::atomic<bool> lent{false};
  };

  explicit PairPool(std::size_t count) : count_(count), pairs_(std::make_unique<Pair[]>(count)) {}

  /// A free one, blank; nullptr where all are lent. Fill it and make a PictureHandle of it, or give it back.
  Pair* acquire() noexcept;
  void give_back(PictureHandle::Loan& loan) noexcept override;
  /// The pair that a picture is either of; nullptr for any other.
  const Pair* find(const Picture& picture) const noexcept;
  /// How many are lent at this moment; exact only while no other thread lends or returns.
  std::size_t lent() const noexcept;

 private:
  std::size_t count_;
  std::unique_ptr<Pair[]> pairs_;
};

}  // namespace onestroke

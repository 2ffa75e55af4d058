#include "camera/pair_pool.h"

#include <algorithm>
#include <span>

namespace onestroke {

PairPool::Pair* PairPool::acquire() noexcept {
  for (Pair& pair : std::span(pairs_.get(), count_)) {
    if (pair.lent.load(std::memory_order_relaxed) || pair.lent.exchange(true, std::memory_order_acquire)) continue;
    pair.lender = this;
    pair.second = nullptr;
    return &pair;
  }
  return nullptr;
}

void PairPool::give_back(PictureHandle::Loan& loan) noexcept {
  Pair& pair = static_cast<Pair&>(loan);
  for (PictureHandle& held : pair.held) held.reset();
  pair.lent.store(false, std::memory_order_release);
}

const PairPool::Pair* PairPool::find(const Picture& picture) const noexcept {
  const auto pairs = std::span<const Pair>(pairs_.get(), count_);
  const auto of = [&](const Pair& pair) { return &pair.picture == &picture || &pair.right == &picture; };
  const auto found = std::ranges::find_if(pairs, of);
  return found == pairs.end() ? nullptr : &*found;
}

std::size_t PairPool::lent() const noexcept {
  std::size_t sum = 0;
  for (const Pair& pair : std::span(pairs_.get(), count_)) sum += pair.lent.load(std::memory_order_relaxed);
  return sum;
}

}  // namespace onestroke

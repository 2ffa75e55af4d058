#pragma once

#include <array>
#include <cstddef>

namespace onestroke {

/// A vector of at most N items that lie in the object itself, so that it never allocates. What does not fit is left
/// out.
template <typename T, std::size_t N>
class InlineVector {
 public:
  using value_type = T;

  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == N; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }
  void push_back(const T& item) {
    if (!full()) items_[size_++] = item;
  }

  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& front() { return items_[0]; }
  const T& front() const { return items_[0]; }
  T& back() { return items_[size_ - 1]; }
  const T& back() const { return items_[size_ - 1]; }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

 private:
  std::array<T, N> items_;
  std::size_t size_ = 0;
};

}  // namespace onestroke

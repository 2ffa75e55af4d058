#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace onestroke {

/// A short line of UTF-8 text of bounded length, so that a frame can make its words without allocating.
class Text {
 public:
  static constexpr std::size_t capacity = 159;

  Text() = default;
  explicit Text(std::string_view text) { print("%.*s", static_cast<int>(text.size()), text.data()); }

  /// As printf; what does not fit is cut off at the last whole character.
  void print(const char* format, ...) __attribute__((format(printf, 2, 3)));
  void clear() { length_ = 0; }
  std::string_view view() const { return {characters_.data(), length_}; }

 private:
  std::array<char, capacity + 1> characters_{};
  std::size_t length_ = 0;
};

}  // namespace onestroke

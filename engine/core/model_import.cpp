#include "core/model_import.h"

#include <algorithm>
#include <cstdio>

namespace onestroke {

namespace {

template <class Enum, std::size_t N>
std::optional<Enum> find(const std::array<std::string_view, N>& words, std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Enum>(found - words.begin());
}

}  // namespace

std::optional<LengthUnit> length_unit_of(std::string_view word) {
  return find<LengthUnit>(length_unit_words, word);
}

std::optional<UpAxis> up_axis_of(std::string_view word) {
  return find<UpAxis>(up_axis_words, word);
}

double metres_of(LengthUnit unit) {
  constexpr std::array<double, length_unit_words.size()> metres{1, 1e-2, 1e-3, 0.0254, 0.3048};
  return metres[static_cast<std::size_t>(unit)];
}

std::string words_of(const ModelImport& import) {
  std::string words;
  if (import.unit) words += ", " + std::string(word_of(*import.unit));
  if (import.up) words += ", " + std::string(word_of(*import.up)) + " up";
  if (import.fit) {
    std::array<char, 40> number{};
    std::snprintf(number.data(), number.size(), "%.6g", *import.fit);
    words += ", fit " + std::string(number.data()) + " mm";
  }
  return words;
}

}  // namespace onestroke

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace onestroke {

enum class LengthUnit { metre, centimetre, millimetre, inch, foot };
enum class UpAxis { x, y, z };

/// As they are written: "mm", "z". The order is that of the enumerators.
inline constexpr std::array<std::string_view, 5> length_unit_words{"m", "cm", "mm", "in", "ft"};
inline constexpr std::array<std::string_view, 3> up_axis_words{"x", "y", "z"};

constexpr std::string_view word_of(LengthUnit unit) {
  return length_unit_words[static_cast<std::size_t>(unit)];
}
constexpr std::string_view word_of(UpAxis up) {
  return up_axis_words[static_cast<std::size_t>(up)];
}

/// Nothing where there is no such word.
std::optional<LengthUnit> length_unit_of(std::string_view word);
std::optional<UpAxis> up_axis_of(std::string_view word);

double metres_of(LengthUnit unit);

/// What a person says of a model file beyond what is in it. What is not given is as usual for the kind of file: metres
/// and y up in glTF, millimetres and y up in OBJ, millimetres and z up in STL and PLY; and the model keeps its size.
struct ModelImport {
  std::optional<LengthUnit> unit{};
  std::optional<UpAxis> up{};
  std::optional<double> fit{};  ///< The longest side of the model as it is shown, mm.

  bool operator==(const ModelImport&) const = default;
};

/// ", mm, z up, fit 60 mm" for what is given; empty where nothing is.
std::string words_of(const ModelImport& import);

}  // namespace onestroke

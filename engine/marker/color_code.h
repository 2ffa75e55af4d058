#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace onestroke {

/// Numbered so that the code's forward transition R -> G -> B -> R is +1 modulo 3.
enum class CellColor : std::uint8_t { red = 0, green = 1, blue = 2 };

using Cells = std::vector<CellColor>;

constexpr char to_letter(CellColor c) {
  return "RGB"[static_cast<int>(c)];
}

/// The most cells a code may have; its value then needs 62 bits.
inline constexpr int max_cells = 64;

/// Reads letters R, G, B. Throws Error that names the first wrong letter. Does not check the code's law.
Cells cells_from_letters(std::string_view letters);
std::string to_letters(const Cells& cells);

/// Empty where the cells obey the code's law (3 to max_cells cells, first red, neighbours differ, last not red);
/// otherwise what is wrong, for a message. After a red cell the stop cell may be green, as encode() makes it, or blue:
/// it carries no data, and markers with either are in use.
std::string law_violation(const Cells& cells);

/// The code of n cells that carries value, 0 <= value < 2^(n-2), first transition most significant. Throws Error.
Cells encode(std::uint64_t value, int n);
/// The value of a lawful code; codes that differ in the stop cell alone have the same. Throws Error where unlawful.
std::uint64_t decode(const Cells& cells);
/// As decode, for cells read from either end: the red end comes first. Throws Error.
std::uint64_t decode_either_end(Cells cells);

}  // namespace onestroke

#include "marker/color_code.h"

#include "core/error.h"

#include <algorithm>

namespace onestroke {
namespace {

CellColor step(CellColor from, bool backward) {
  return static_cast<CellColor>((static_cast<int>(from) + (backward ? 2 : 1)) % 3);
}

std::string name(CellColor c) {
  return c == CellColor::red ? "red" : c == CellColor::green ? "green" : "blue";
}

void check_count(int n) {
  if (n < 3 || n > max_cells)
    throw Error("a code has 3 to " + std::to_string(max_cells) + " cells, not " + std::to_string(n));
}

}  // namespace

Cells cells_from_letters(std::string_view letters) {
  Cells cells;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const auto color = std::string_view("RGB").find(letters[i]);
    if (color == std::string_view::npos)
      throw Error("cell " + std::to_string(i + 1) + " is '" + letters[i] + "'; cells are written R, G or B");
    cells.push_back(static_cast<CellColor>(color));
  }
  return cells;
}

std::string to_letters(const Cells& cells) {
  std::string letters;
  for (const CellColor c : cells) letters += to_letter(c);
  return letters;
}

std::string law_violation(const Cells& cells) {
  const int n = static_cast<int>(cells.size());
  if (n < 3 || n > max_cells)
    return "a code has 3 to " + std::to_string(max_cells) + " cells, not " + std::to_string(cells.size());
  if (cells.front() != CellColor::red) return "the first cell is " + name(cells.front()) + ", not red";
  const auto repeat = std::adjacent_find(cells.begin(), cells.end());
  if (repeat != cells.end()) {
    const auto i = repeat - cells.begin() + 1;
    return "cells " + std::to_string(i) + " and " + std::to_string(i + 1) + " are both " + name(*repeat);
  }
  if (cells.back() == CellColor::red) return "the last cell is red; the stop cell is green or blue";
  return {};
}

Cells encode(std::uint64_t value, int n) {
  check_count(n);
  const int bits = n - 2;
  if (value >> bits != 0)
    throw Error("the value " + std::to_string(value) + " does not fit in " + std::to_string(n) +
                " cells; the largest is " + std::to_string((std::uint64_t{1} << bits) - 1));
  Cells cells{CellColor::red};
  for (int bit = bits - 1; bit >= 0; --bit) cells.push_back(step(cells.back(), (value >> bit & 1) != 0));
  const bool forward_is_red = cells.back() == CellColor::blue;
  cells.push_back(step(cells.back(), forward_is_red));
  return cells;
}

std::uint64_t decode(const Cells& cells) {
  const std::string violation = law_violation(cells);
  if (!violation.empty()) throw Error(violation);
  std::uint64_t value = 0;
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) value = value << 1 | (cells[i] != step(cells[i - 1], false));
  return value;
}

std::uint64_t decode_either_end(Cells cells) {
  const bool start_red = !cells.empty() && cells.front() == CellColor::red;
  const bool end_red = !cells.empty() && cells.back() == CellColor::red;
  if (start_red == end_red)
    throw Error(start_red ? "both ends are red; only the start is" : "neither end is red; the start is");
  if (end_red) std::reverse(cells.begin(), cells.end());
  return decode(cells);
}

}  // namespace onestroke

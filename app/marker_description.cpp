#include "app/marker_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

namespace onestroke {
namespace {

const char* kind_name(Shape::Kind kind) {
  constexpr const char* names[] = {"angle", "stroke", "line"};
  return names[static_cast<int>(kind)];
}

/// Up to three decimals, without trailing zeros.
std::string number(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << value;
  std::string digits = text.str();
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

std::string point(Vec3 p) {
  return "(" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ")";
}

std::size_t columns(const std::string& utf8) {
  return static_cast<std::size_t>(std::ranges::count_if(utf8, [](char c) { return (c & 0xc0) != 0x80; }));
}

using Row = std::vector<std::string>;

std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(row[i]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - columns(row[i]) + 2, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string pieces_text(const Shape& shape) {
  std::string text;
  for (const Shape::Piece& piece : shape.pieces()) {
    if (!text.empty()) text += ", ";
    text += piece.radius == 0 ? "straight " + number(piece.length)
                              : "arc " + number(piece.length) + " (radius " + number(piece.radius) + ", " +
                                    number(piece.length / piece.radius * 180 / std::numbers::pi) + " degrees)";
  }
  return text;
}

std::string code_text(const MarkerSpec& marker) {
  const int bits = static_cast<int>(marker.cells.size()) - 2;
  return std::to_string(decode(marker.cells)) + " of " + std::to_string(std::uint64_t{1} << bits) + " (" +
         std::to_string(bits) + " bits)";
}

/// The two axes to draw, across and down, and the one to look along.
struct View {
  std::size_t across, down, along;
};

View flattest_view(const std::vector<std::array<double, 3>>& points) {
  std::array<double, 3> extent{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto by_axis = [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::ranges::minmax_element(points, by_axis);
    extent[axis] = (*high)[axis] - (*low)[axis];
  }
  // z wherever it is as flat as any, because that is how the marker frame is meant to be looked at.
  std::size_t along = 2;
  for (const std::size_t axis : {std::size_t{1}, std::size_t{0}})
    if (extent[axis] < extent[along] - 1e-9) along = axis;
  return {along == 0 ? 1u : 0u, along == 2 ? 1u : 2u, along};
}

std::string model_text(const MarkerSpec& marker, const std::string& none) {
  return marker.model.empty() ? none : marker.model + words_of(marker.import);
}

/// What is said of the model, each a row below it.
std::vector<Row> model_rows(const MarkerSpec& marker) {
  std::vector<Row> rows;
  if (!marker.model_name.empty()) rows.push_back({"  name", marker.model_name});
  if (!marker.version.empty()) rows.push_back({"  version", marker.version});
  for (const auto& [key, text] : marker.notes) rows.push_back({"  " + key, text});
  return rows;
}

}  // namespace

std::string describe(const Catalog& catalog) {
  std::vector<Row> rows{{"ID", "NAME", "SHAPE", "CELLS", "PITCH", "RADIUS", "BEND", "MODEL"}};
  for (const MarkerSpec& m : catalog.markers)
    rows.push_back({std::to_string(m.id), m.name, kind_name(m.shape.kind()), std::to_string(m.shape.cells()),
                    number(m.shape.pitch()), number(m.shape.radius()), number(m.shape.bend_radius()),
                    model_text(m, "-")});
  const auto versioned = [](const MarkerSpec& m) { return !m.version.empty(); };
  if (std::ranges::any_of(catalog.markers, versioned)) {
    rows.front().push_back("VERSION");
    for (std::size_t i = 0; i < catalog.markers.size(); ++i)
      rows[i + 1].push_back(versioned(catalog.markers[i]) ? catalog.markers[i].version : "-");
  }
  return table(rows);
}

std::string letter_picture(const MarkerSpec& marker) {
  const Shape& shape = marker.shape;
  std::vector<std::array<double, 3>> centres;
  for (int cell = 0; cell < shape.cells(); ++cell) {
    const Vec3 p = shape.at((cell + 0.5) * shape.pitch()).position / shape.pitch();
    centres.push_back({p.x, p.y, p.z});
  }
  const View view = flattest_view(centres);
  const auto least = [&](std::size_t axis) {
    return (*std::ranges::min_element(centres, {}, [axis](const auto& p) { return p[axis]; }))[axis];
  };
  const double left = least(view.across), top = least(view.down);
  std::vector<std::string> lines;
  for (std::size_t cell = 0; cell < centres.size(); ++cell) {
    const auto row = static_cast<std::size_t>(std::lround(centres[cell][view.down] - top));
    const auto column = static_cast<std::size_t>(std::lround(2 * (centres[cell][view.across] - left)));
    if (lines.size() <= row) lines.resize(row + 1);
    if (lines[row].size() <= column) lines[row].resize(column + 1, ' ');
    lines[row][column] = to_letter(marker.cells[cell]);
  }
  const std::string axes = "xyz";
  std::string text = std::string("seen along ") + axes[view.along] + ": " + axes[view.across] + " to the right, " +
                     axes[view.down] + " down\n\n";
  for (const std::string& line : lines) text += "    " + line + "\n";
  return text;
}

std::string describe(const MarkerSpec& marker) {
  const Shape& shape = marker.shape;
  std::vector<Row> rows{
      {"id", std::to_string(marker.id)},
      {"name", marker.name},
      {"model", model_text(marker, "none")},
      {"cells", to_letters(marker.cells)},
      {"value", code_text(marker)},
      {"shape", std::string(kind_name(shape.kind())) + ", " + std::to_string(shape.cells()) + " cells of " +
                    number(shape.pitch()) + " mm, " + number(shape.length()) + " mm in all"},
      {"rod", "round, radius " + number(shape.radius()) + " mm"},
      {"bend radius", number(shape.bend_radius()) + " mm"},
      {"centreline", pieces_text(shape) + " mm"},
      {"red tip", point(shape.at(0).position) + " mm"},
      {"stop tip", point(shape.at(shape.length()).position) + " mm"},
      {"roll", shape.has_roll() ? "can be told: six degrees of freedom" : "cannot be told: five degrees of freedom"},
  };
  const std::vector<Row> said = model_rows(marker);
  rows.insert(rows.begin() + 3, said.begin(), said.end());
  return table(rows) + "\n" + letter_picture(marker);
}

}  // namespace onestroke

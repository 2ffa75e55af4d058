#include "marker/catalog.h"
#include "scene/model.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace onestroke {
namespace {

const std::filesystem::path assets = std::filesystem::path(ONESTROKE_SOURCE_DIR) / "assets";

// Every stretch of so many cells, read either way, is there once: a hand that covers the rest leaves no doubt.
TEST(Assets, AnySevenCellsTellTheMarkerThePlaceAndTheDirection) {
  constexpr std::size_t window = 7;
  std::multiset<std::string> seen;
  for (const MarkerSpec& marker : load_catalog(assets / "catalog.json").markers) {
    const std::string letters = to_letters(marker.cells);
    EXPECT_EQ(letters.size(), 36U);
    EXPECT_EQ(law_violation(marker.cells), "") << marker.name;
    for (std::size_t i = 0; i + window <= letters.size(); ++i) {
      std::string piece = letters.substr(i, window);
      seen.insert(piece);
      std::reverse(piece.begin(), piece.end());
      seen.insert(piece);
    }
  }
  EXPECT_EQ(seen.size(), 2U * 2U * 30U);
  for (const std::string& piece : seen) EXPECT_EQ(seen.count(piece), 1U) << piece;
}

TEST(Assets, NineCellsWithOneWrongColourMatchNothingElse) {
  constexpr std::size_t window = 9;
  std::vector<std::string> seen;
  for (const MarkerSpec& marker : load_catalog(assets / "catalog.json").markers) {
    const std::string letters = to_letters(marker.cells);
    for (std::size_t i = 0; i + window <= letters.size(); ++i) {
      seen.push_back(letters.substr(i, window));
      seen.emplace_back(seen.back().rbegin(), seen.back().rend());
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = i + 1; j < seen.size(); ++j) {
      int different = 0;
      for (std::size_t k = 0; k < window; ++k) different += seen[i][k] != seen[j][k];
      EXPECT_GE(different, 2) << seen[i] << " and " << seen[j];
    }
  }
}

TEST(Assets, MarkersOneAndTwoCarryTheBracketsOnASharpAndABentRod) {
  const Catalog catalog = load_catalog(assets / "catalog.json");
  ASSERT_EQ(catalog.markers.size(), 2U);
  EXPECT_EQ(catalog.find(1)->name, "bracket v1");
  EXPECT_EQ(catalog.find(2)->name, "bracket v2");
  EXPECT_EQ(catalog.find(1)->shape.bend_radius(), 0);
  EXPECT_EQ(catalog.find(2)->shape.bend_radius(), 8);
  for (const MarkerSpec& marker : catalog.markers)
    EXPECT_TRUE(std::filesystem::is_regular_file(assets / marker.model)) << marker.model;
}

class Bracket : public testing::TestWithParam<const char*> {};

TEST_P(Bracket, IsABracketOfItsTrueSize) {
  const Model m = load_model(assets / GetParam());
  EXPECT_EQ(m.parts.size(), 3U);
  EXPECT_GT(m.indices.size() / 3, 2000U);
  EXPECT_LE(m.indices.size() / 3, 20000U);
  EXPECT_NEAR(m.upper[0] - m.lower[0], 0.060F, 1e-5F);
  EXPECT_NEAR(m.lower[1], 0, 1e-6F);
  EXPECT_NEAR(m.upper[1], 0.050F, 1e-5F);
  EXPECT_NEAR(m.upper[2] - m.lower[2], 0.0408F, 1e-5F);
}

using Point = std::array<float, 3>;

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double dot(const Point& u, const Point& v) {
  return double{u[0]} * double{v[0]} + double{u[1]} * double{v[1]} + double{u[2]} * double{v[2]};
}

TEST_P(Bracket, EnclosesMaterialAndItsNormalsPointOutwards) {
  const Model m = load_model(assets / GetParam());
  double volume = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const auto vertex = [&](std::size_t k) -> const ModelVertex& { return m.vertices[m.indices[i + k]]; };
    const Point& a = vertex(0).position;
    const Point face = cross(minus(vertex(1).position, a), minus(vertex(2).position, a));
    volume += dot(a, cross(vertex(1).position, vertex(2).position)) / 6;
    const double area = std::sqrt(dot(face, face));
    // Slivers have no direction to speak of in single precision.
    if (area < 1e-9) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(dot(vertex(k).normal, vertex(k).normal), 1, 1e-4);
      EXPECT_GT(dot(vertex(k).normal, face) / area, std::cos(0.6)) << "triangle " << i / 3;
    }
  }
  // Two plates of a few millimetres: between 10 and 40 cubic centimetres of material.
  EXPECT_GT(volume, 10e-6);
  EXPECT_LT(volume, 40e-6);
}

INSTANTIATE_TEST_SUITE_P(Both, Bracket, testing::Values("bracket_v1.glb", "bracket_v2.glb"),
                         [](const auto& info) { return std::string(info.param).substr(0, 10); });

}  // namespace
}  // namespace onestroke

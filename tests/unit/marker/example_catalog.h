#pragma once

#include "../core/error_of.h"
#include "core/error.h"
#include "marker/catalog.h"

#include <functional>
#include <string>

namespace onestroke::test {

inline MarkerSpec marker(int id, const std::string& name, std::uint64_t value, Shape shape, std::string model = "") {
  return {id, name, encode(value, shape.cells()), std::move(shape), std::move(model)};
}

inline MarkerSpec with(MarkerSpec marker, ModelImport import) {
  marker.import = import;
  return marker;
}

/// Notes in an order that no sorting makes.
inline MarkerSpec told_of(MarkerSpec marker) {
  marker.model_name = "Bügel \"A\"";
  marker.version = "v2";
  marker.notes = {{"material", "6061-T6"}, {"changed", "two ribs"}, {"Ü", ""}, {"a", "last"}};
  return marker;
}

/// One marker of every kind of shape, models of which more or less is said, and numbers that do not print in few
/// digits.
inline Catalog example_catalog() {
  return {{marker(1, "m01", 12345, Shape::angle(36, 4, 3, 0), "models/bracket a.glb"),
           marker(2, "bent", 54321, Shape::angle(36, 4, 3, 8)),
           with(told_of(marker(5, "Größe \"5\"", 7, Shape::line(12, 1.0 / 3, 0.1), "b.stl")),
                {.unit = LengthUnit::inch, .up = UpAxis::x, .fit = 200.0 / 3}),
           marker(9, "stroke", 99, Shape::stroke(20, 4, 2, 0, {{0, 0, 0}, {0.1, 40, 0}, {0.1, 40, 39.999875}}))}};
}

inline bool same(const Catalog& a, const Catalog& b) {
  return to_json(a) == to_json(b);
}

}  // namespace onestroke::test

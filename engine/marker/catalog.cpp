#include "marker/catalog.h"

#include "core/error.h"
#include "core/frame_record.h"
#include "marker/catalog_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace onestroke {
namespace {

constexpr double largest_fit = 10'000;  // mm
constexpr std::string_view sqlite_magic{"SQLite format 3\0", 16};

std::string read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(file.string() + " is a folder; name the catalogue file in it");
  try {
    std::ifstream in(file, std::ios::binary);
    in.exceptions(std::ios::badbit);
    if (in) return {std::istreambuf_iterator<char>(in), {}};
  } catch (const std::ios::failure&) {
    // Said below, as for a file that does not open.
  }
  throw Error(file.string() + " cannot be read; check that it exists and that you may read it");
}

}  // namespace

const MarkerSpec* Catalog::find(int id) const {
  const auto found = std::ranges::find(markers, id, &MarkerSpec::id);
  return found == markers.end() ? nullptr : &*found;
}

std::string entry_label(long long number, const std::string& name) {
  return "marker " + std::to_string(number) + (name.empty() ? "" : " (\"" + name + "\")");
}

void check_marker(const MarkerSpec& marker) {
  if (marker.id < 0) throw Error("the id must be 0 or more, not " + std::to_string(marker.id));
  if (marker.name.empty()) throw Error("the name is empty");
  if (marker.name.size() > max_name_length)
    throw Error("the name is longer than " + std::to_string(max_name_length) + " bytes");
  if (std::ranges::any_of(marker.name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    throw Error("the name contains a control character");
  if (marker.model.empty() && marker.import != ModelImport{})
    throw Error("there is no model, but something is said of it");
  if (marker.import.fit && !(*marker.import.fit > 0 && *marker.import.fit <= largest_fit))
    throw Error("\"fit\" must be more than 0 and at most 10000 mm");
  const std::string violation = law_violation(marker.cells);
  if (!violation.empty()) throw Error("cells break the law of the code: " + violation);
  if (marker.cells.size() != static_cast<std::size_t>(marker.shape.cells()))
    throw Error("the code has " + std::to_string(marker.cells.size()) + " cells but the shape " +
                std::to_string(marker.shape.cells()));
}

void Uniqueness::add(const MarkerSpec& marker, const std::string& label) {
  const auto id = ids_.find(marker.id);
  if (id != ids_.end()) throw Error("id " + std::to_string(marker.id) + " is given twice, first by " + id->second);
  const auto name = names_.find(marker.name);
  if (name != names_.end()) throw Error("name \"" + marker.name + "\" is given twice, first by " + name->second);
  const std::pair code{marker.cells.size(), decode(marker.cells)};
  const auto same = codes_.find(code);
  if (same != codes_.end())
    throw Error("code " + to_letters(marker.cells) + " is given twice, first by " + same->second);
  ids_.emplace(marker.id, label);
  names_.emplace(marker.name, label);
  codes_.emplace(code, label);
}

void sort_by_id(Catalog& catalog) {
  std::ranges::sort(catalog.markers, {}, &MarkerSpec::id);
}

Catalog load_catalog(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  if (content.starts_with(sqlite_magic)) return CatalogStore(file).load();
  return catalog_from_json(content, file.string());
}

}  // namespace onestroke

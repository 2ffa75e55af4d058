#include "marker/catalog.h"

#include "core/error.h"
#include "core/frame_record.h"
#include "marker/catalog_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace onestroke {
namespace {

constexpr double largest_fit = 10'000;     // mm
constexpr std::size_t longest_said = 200;  // bytes: more does not fit beside a model
constexpr std::size_t most_notes = 32;
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

void check_text(const std::string& what, const std::string& text, std::size_t longest) {
  if (text.size() > longest) throw Error(what + " is longer than " + std::to_string(longest) + " bytes");
  if (std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    throw Error(what + " contains a control character");
}

void check_notes(const std::vector<ModelNote>& notes) {
  if (notes.size() > most_notes)
    throw Error("the model has " + std::to_string(notes.size()) + " notes, and at most " + std::to_string(most_notes) +
                " are kept");
  for (auto note = notes.begin(); note != notes.end(); ++note) {
    if (note->first.empty()) throw Error("a note of the model has an empty key");
    check_text("the key of the model's note " + std::to_string(note - notes.begin() + 1), note->first, longest_said);
    check_text("the model's note \"" + note->first + "\"", note->second, longest_said);
    if (std::ranges::count(notes, note->first, &ModelNote::first) > 1)
      throw Error("the model's note \"" + note->first + "\" is given twice");
  }
}

void check_model(const MarkerSpec& marker) {
  const bool said =
      marker.import != ModelImport{} || !marker.model_name.empty() || !marker.version.empty() || !marker.notes.empty();
  if (marker.model.empty() && said) throw Error("there is no model, but something is said of it");
  if (marker.import.fit && !(*marker.import.fit > 0 && *marker.import.fit <= largest_fit))
    throw Error("\"fit\" must be more than 0 and at most 10000 mm");
  check_text("the model's name", marker.model_name, longest_said);
  check_text("the model's version", marker.version, longest_said);
  check_notes(marker.notes);
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
  check_text("the name", marker.name, max_name_length);
  check_model(marker);
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

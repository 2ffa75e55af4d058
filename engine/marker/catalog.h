#pragma once

#include "core/model_import.h"
#include "marker/color_code.h"
#include "marker/shape.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace onestroke {

/// What is said of a model: a key and what it is, such as "material" and "6061-T6".
using ModelNote = std::pair<std::string, std::string>;

/// One marker: what it is called, its code, its rod, and the model that stands on it (a path as written; empty for
/// none) with what is said of it.
struct MarkerSpec {
  int id = 0;
  std::string name;
  Cells cells;
  Shape shape;
  std::string model;
  ModelImport import{};
  std::string model_name{};        ///< Its title; empty where it has none.
  std::string version{};           ///< Of the model; empty where it has none.
  std::vector<ModelNote> notes{};  ///< In the order in which they are shown; keys are unique and not empty.
};

/// Markers in the order of their ids; ids, names and codes (read from either end) are unique.
struct Catalog {
  std::vector<MarkerSpec> markers;

  /// nullptr where there is none.
  const MarkerSpec* find(int id) const;
};

/// Reads the exchange form (JSON text). Every bad entry is an Error that names the entry and what is wrong with it.
/// origin is the name used in messages (a file name).
Catalog catalog_from_json(const std::string& text, const std::string& origin);
/// The exchange form, one marker a line, byte for byte stable.
std::string to_json(const Catalog& catalog);

/// The catalogue as the program keeps it: an SQLite database. Every change is one transaction: all of it or nothing.
/// Opening an existing file that is no catalogue, is damaged or comes from a newer version throws Error. One of an
/// older version is read as it is, and brought up to date by the first change.
class CatalogStore {
 public:
  /// Opens, and creates where it is missing and `create` says so.
  explicit CatalogStore(const std::filesystem::path& file, bool create = false);
  ~CatalogStore();
  CatalogStore(CatalogStore&&) noexcept;
  CatalogStore& operator=(CatalogStore&&) noexcept;

  Catalog load() const;
  /// Adds the markers; with `replace`, those whose id exists take the place of the old. Throws Error, changing nothing,
  /// when an id, name or code is there already.
  void import(const Catalog& more, bool replace = false);

 private:
  struct Database;
  Database* database_;
};

/// Either form by its content: an SQLite database or the exchange JSON. What `--catalog FILE` means.
Catalog load_catalog(const std::filesystem::path& file);

}  // namespace onestroke

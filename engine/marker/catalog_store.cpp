#include "core/error.h"
#include "marker/catalog.h"
#include "marker/catalog_rules.h"
#include "marker/catalog_schema.h"
#include "marker/sqlite.h"

#include <set>
#include <utility>

namespace onestroke {
namespace {

using sqlite::Connection;
using sqlite::Statement;
using sqlite::Transaction;

std::vector<Vec3> read_vertices(const Connection& database, int id) {
  Statement rows(database, "SELECT x, y, z FROM vertex WHERE marker = ? ORDER BY position");
  rows.bind(static_cast<long long>(id));
  std::vector<Vec3> vertices;
  while (rows.step()) {
    const double x = rows.real(), y = rows.real(), z = rows.real();
    vertices.push_back({x, y, z});
  }
  return vertices;
}

ModelImport read_import(Statement& row) {
  const std::string unit = row.text(), up = row.text();
  const double fit = row.real();
  ModelImport import;
  import.unit = length_unit_of(unit);
  import.up = up_axis_of(up);
  if (fit != 0) import.fit = fit;
  return import;
}

std::vector<ModelNote> read_notes(const Connection& database, int id) {
  if (format_of(database) < 3) return {};
  Statement rows(database, "SELECT key, text FROM note WHERE marker = ? ORDER BY position");
  rows.bind(static_cast<long long>(id));
  std::vector<ModelNote> notes;
  while (rows.step()) {
    std::string key = rows.text();
    notes.emplace_back(std::move(key), rows.text());
  }
  return notes;
}

/// The columns that say more of a model than its file, and what stands for those that an older format lacks.
std::string model_columns(long long format) {
  const std::string import = format < 2 ? "'', '', 0" : "unit, up, fit";
  return import + (format < 3 ? ", '', ''" : ", model_name, version");
}

MarkerSpec read_marker(const Connection& database, Statement& row, int id, const std::string& name) {
  Cells cells = cells_from_letters(row.text());
  const std::string kind = row.text();
  const double pitch = row.real(), radius = row.real(), bend = row.real();
  const int count = static_cast<int>(cells.size());
  Shape shape = kind == "angle"    ? Shape::angle(count, pitch, radius, bend)
                : kind == "stroke" ? Shape::stroke(count, pitch, radius, bend, read_vertices(database, id))
                                   : Shape::line(count, pitch, radius);
  MarkerSpec marker{id, name, std::move(cells), std::move(shape), row.text()};
  marker.import = read_import(row);
  marker.model_name = row.text();
  marker.version = row.text();
  marker.notes = read_notes(database, id);
  check_marker(marker);
  return marker;
}

Catalog read_all(const Connection& database) {
  Catalog catalog;
  Uniqueness unique;
  Statement rows(database, "SELECT id, name, cells, kind, pitch, radius, bend_radius, model, " +
                               model_columns(format_of(database)) + " FROM marker ORDER BY id");
  while (rows.step()) {
    const int id = static_cast<int>(rows.integer());
    const std::string name = rows.text();
    try {
      catalog.markers.push_back(read_marker(database, rows, id, name));
      unique.add(catalog.markers.back(), entry_label(id, name));
    } catch (const Error& error) {
      throw Error(database.file() + ": " + entry_label(id, name) + ": " + error.what());
    }
  }
  return catalog;
}

void insert_notes(Connection& database, const MarkerSpec& marker) {
  Statement row(database, "INSERT INTO note VALUES (?, ?, ?, ?)");
  long long position = 0;
  for (const auto& [key, text] : marker.notes)
    row.bind(static_cast<long long>(marker.id)).bind(position++).bind(key).bind(text).run();
}

void insert(Connection& database, const MarkerSpec& marker) {
  constexpr const char* kinds[] = {"angle", "stroke", "line"};
  const Shape& shape = marker.shape;
  Statement(database, "INSERT INTO marker VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(static_cast<long long>(marker.id))
      .bind(marker.name)
      .bind(to_letters(marker.cells))
      .bind(kinds[static_cast<int>(shape.kind())])
      .bind(shape.pitch())
      .bind(shape.radius())
      .bind(shape.bend_radius())
      .bind(marker.model)
      .bind(marker.import.unit ? word_of(*marker.import.unit) : "")
      .bind(marker.import.up ? word_of(*marker.import.up) : "")
      .bind(marker.import.fit.value_or(0))
      .bind(marker.model_name)
      .bind(marker.version)
      .run();
  insert_notes(database, marker);
  if (shape.kind() != Shape::Kind::stroke) return;
  Statement row(database, "INSERT INTO vertex VALUES (?, ?, ?, ?, ?)");
  long long position = 0;
  for (const Vec3& v : shape.vertices())
    row.bind(static_cast<long long>(marker.id)).bind(position++).bind(v.x).bind(v.y).bind(v.z).run();
}

/// Throws where the new markers cannot stand beside those that stay.
void check_together(const Catalog& kept, const Catalog& more, const std::string& file) {
  Uniqueness unique;
  for (const MarkerSpec& marker : kept.markers)
    unique.add(marker, "the catalogue's " + entry_label(marker.id, marker.name));
  for (const MarkerSpec& marker : more.markers) {
    const std::string label = entry_label(marker.id, marker.name);
    try {
      check_marker(marker);
      unique.add(marker, label);
    } catch (const Error& error) {
      const bool replaceable = kept.find(marker.id) != nullptr;
      throw Error(file + ": " + label + ": " + error.what() +
                  (replaceable ? "; use --replace to put the new one in its place" : "") + "; nothing was changed");
    }
  }
}

}  // namespace

struct CatalogStore::Database {
  Connection connection;
};

CatalogStore::CatalogStore(const std::filesystem::path& file, bool create) : database_(nullptr) {
  std::error_code unknown;
  const bool existed = std::filesystem::exists(file, unknown);
  if (!existed && !create)
    throw Error(file.string() + " does not exist; make it with `onestroke marker import FILE.json --catalog " +
                file.string() + "`");
  auto database = std::make_unique<Database>(Database{Connection(file, create)});
  try {
    Connection& connection = database->connection;
    connection.run("PRAGMA foreign_keys = ON");
    if (create && connection.number("SELECT count(*) FROM sqlite_master") == 0 &&
        connection.number("PRAGMA application_id") == 0)
      create_tables(connection);
    check_format(connection);
  } catch (const Error&) {
    database.reset();
    if (!existed) std::filesystem::remove(file, unknown);
    throw;
  }
  database_ = database.release();
}

CatalogStore::~CatalogStore() {
  delete database_;
}

CatalogStore::CatalogStore(CatalogStore&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}

CatalogStore& CatalogStore::operator=(CatalogStore&& other) noexcept {
  std::swap(database_, other.database_);
  return *this;
}

Catalog CatalogStore::load() const {
  Transaction transaction(database_->connection, Transaction::Kind::read);
  return read_all(database_->connection);
}

void CatalogStore::import(const Catalog& more, bool replace) {
  Connection& database = database_->connection;
  Transaction transaction(database, Transaction::Kind::write);
  bring_up_to_date(database);
  Catalog kept = read_all(database);
  if (replace) {
    std::erase_if(kept.markers, [&](const MarkerSpec& old) { return more.find(old.id) != nullptr; });
    Statement remove(database, "DELETE FROM marker WHERE id = ?");
    for (const MarkerSpec& marker : more.markers) remove.bind(static_cast<long long>(marker.id)).run();
  }
  check_together(kept, more, database.file());
  for (const MarkerSpec& marker : more.markers) insert(database, marker);
  transaction.commit();
}

}  // namespace onestroke

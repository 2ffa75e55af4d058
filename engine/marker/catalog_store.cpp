#include "core/error.h"
#include "marker/catalog.h"
#include "marker/catalog_rules.h"
#include "marker/sqlite.h"

#include <set>
#include <utility>

namespace onestroke {
namespace {

using sqlite::Connection;
using sqlite::Statement;
using sqlite::Transaction;

// 2 says more of the models than their files: columns unit, up and fit.
constexpr long long format = 2;
constexpr long long application_id = 0x31737472;  // "1str", written into the file's header

constexpr const char* schema = R"(
CREATE TABLE marker (
  id INTEGER PRIMARY KEY CHECK (id BETWEEN 0 AND 2147483647),
  name TEXT NOT NULL UNIQUE,
  cells TEXT NOT NULL UNIQUE,
  kind TEXT NOT NULL CHECK (kind IN ('angle', 'stroke', 'line')),
  pitch REAL NOT NULL,
  radius REAL NOT NULL,
  bend_radius REAL NOT NULL,
  model TEXT NOT NULL,
  unit TEXT NOT NULL DEFAULT '' CHECK (unit IN ('', 'm', 'cm', 'mm', 'in', 'ft')),
  up TEXT NOT NULL DEFAULT '' CHECK (up IN ('', 'x', 'y', 'z')),
  fit REAL NOT NULL DEFAULT 0
) STRICT;
CREATE TABLE vertex (
  marker INTEGER NOT NULL REFERENCES marker (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  PRIMARY KEY (marker, position)
) STRICT, WITHOUT ROWID;
)";

constexpr const char* from_1_to_2 = R"(
ALTER TABLE marker ADD COLUMN unit TEXT NOT NULL DEFAULT '' CHECK (unit IN ('', 'm', 'cm', 'mm', 'in', 'ft'));
ALTER TABLE marker ADD COLUMN up TEXT NOT NULL DEFAULT '' CHECK (up IN ('', 'x', 'y', 'z'));
ALTER TABLE marker ADD COLUMN fit REAL NOT NULL DEFAULT 0;
)";

long long format_of(const Connection& database) {
  Statement statement(database, "PRAGMA user_version");
  return statement.step() ? statement.integer() : 0;
}

/// Inside a transaction.
void bring_up_to_date(Connection& database) {
  if (format_of(database) == format) return;
  database.run(from_1_to_2);
  database.run("PRAGMA user_version = " + std::to_string(format));
}

void create_tables(Connection& database) {
  Transaction transaction(database, Transaction::Kind::write);
  database.run(schema);
  database.run("PRAGMA application_id = " + std::to_string(application_id));
  database.run("PRAGMA user_version = " + std::to_string(format));
  transaction.commit();
}

void check_format(Connection& database) {
  const std::string name = database.file() + " ";
  if (database.number("PRAGMA application_id") != application_id)
    throw Error(name + "is no catalogue; name a database made by `onestroke marker import`");
  const long long found = format_of(database);
  if (found < 1 || found > format)
    throw Error(name + "is a catalogue of format " + std::to_string(found) + " and this program knows formats up to " +
                std::to_string(format) + "; update the program");
  if (database.text("PRAGMA quick_check(1)") != "ok")
    throw Error(name + "is damaged; restore a copy, or import the markers into a new file");
}

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
  check_marker(marker);
  return marker;
}

Catalog read_all(const Connection& database) {
  Catalog catalog;
  Uniqueness unique;
  const std::string import = format_of(database) == 1 ? "'', '', 0" : "unit, up, fit";
  Statement rows(database, "SELECT id, name, cells, kind, pitch, radius, bend_radius, model, " + import +
                               " FROM marker ORDER BY id");
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

void insert(Connection& database, const MarkerSpec& marker) {
  constexpr const char* kinds[] = {"angle", "stroke", "line"};
  const Shape& shape = marker.shape;
  Statement(database, "INSERT INTO marker VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
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
      .run();
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

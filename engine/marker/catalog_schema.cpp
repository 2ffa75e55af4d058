#include "marker/catalog_schema.h"

#include "core/error.h"

#include <string>

namespace onestroke {

using sqlite::Connection;
using sqlite::Statement;
using sqlite::Transaction;

namespace {

// 2 says how to read the models' files: columns unit, up and fit. 3 says what the models are: columns model_name and
// version, and the notes.
constexpr long long format = 3;
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
  fit REAL NOT NULL DEFAULT 0,
  model_name TEXT NOT NULL DEFAULT '',
  version TEXT NOT NULL DEFAULT ''
) STRICT;
CREATE TABLE vertex (
  marker INTEGER NOT NULL REFERENCES marker (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  PRIMARY KEY (marker, position)
) STRICT, WITHOUT ROWID;
)";

constexpr const char* note_table = R"(
CREATE TABLE note (
  marker INTEGER NOT NULL REFERENCES marker (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  key TEXT NOT NULL,
  text TEXT NOT NULL,
  PRIMARY KEY (marker, position),
  UNIQUE (marker, key)
) STRICT, WITHOUT ROWID;
)";

constexpr const char* from_1_to_2 = R"(
ALTER TABLE marker ADD COLUMN unit TEXT NOT NULL DEFAULT '' CHECK (unit IN ('', 'm', 'cm', 'mm', 'in', 'ft'));
ALTER TABLE marker ADD COLUMN up TEXT NOT NULL DEFAULT '' CHECK (up IN ('', 'x', 'y', 'z'));
ALTER TABLE marker ADD COLUMN fit REAL NOT NULL DEFAULT 0;
)";

constexpr const char* from_2_to_3 = R"(
ALTER TABLE marker ADD COLUMN model_name TEXT NOT NULL DEFAULT '';
ALTER TABLE marker ADD COLUMN version TEXT NOT NULL DEFAULT '';
)";

}  // namespace

long long format_of(const Connection& database) {
  Statement statement(database, "PRAGMA user_version");
  return statement.step() ? statement.integer() : 0;
}

void bring_up_to_date(Connection& database) {
  const long long found = format_of(database);
  if (found == format) return;
  if (found < 2) database.run(from_1_to_2);
  database.run(from_2_to_3);
  database.run(note_table);
  database.run("PRAGMA user_version = " + std::to_string(format));
}

void create_tables(Connection& database) {
  Transaction transaction(database, Transaction::Kind::write);
  database.run(schema);
  database.run(note_table);
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

}  // namespace onestroke

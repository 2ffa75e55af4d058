#pragma once

#include "marker/sqlite.h"

namespace onestroke {

/// The catalogue's format as the database says it; 0 where it says none.
long long format_of(const sqlite::Connection& database);

/// Makes an empty catalogue of the newest format, in a transaction of its own.
void create_tables(sqlite::Connection& database);
/// Adds what an older format lacks. Inside a transaction.
void bring_up_to_date(sqlite::Connection& database);
/// Throws Error where the database is no catalogue, is damaged or comes from a newer version.
void check_format(sqlite::Connection& database);

}  // namespace onestroke

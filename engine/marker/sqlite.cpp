#include "marker/sqlite.h"

#include "core/error.h"

#include <sqlite3.h>

namespace onestroke::sqlite {
namespace {

constexpr int patience_ms = 2000;  // how long another program's transaction is waited for

std::string remedy(int code, const char* detail) {
  switch (code & 0xff) {
    case SQLITE_NOTADB:
      return "is no catalogue; name a database made by `onestroke marker import`";
    case SQLITE_CORRUPT:
      return "is damaged; restore a copy, or import the markers into a new file";
    case SQLITE_FULL:
      return "cannot grow, so nothing was changed; free some disk space and try again";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "may not be written, so nothing was changed; check the permissions of the file and of its folder";
    case SQLITE_CANTOPEN:
      return "cannot be opened; check that its folder exists and that you may read and write there";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "is in use by another program; try again when that is done";
    case SQLITE_IOERR:
      return "cannot be read or written (" + std::string(detail) + "); check the disk";
    default:
      return "failed: " + std::string(detail);
  }
}

}  // namespace

void Connection::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

Connection::Connection(const std::filesystem::path& file, bool create) : file_(file.string()) {
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
  const int code = sqlite3_open_v2(file_.c_str(), &opened, flags, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail(code);
  sqlite3_busy_timeout(opened, patience_ms);
}

void Connection::fail(int code) const {
  throw Error(file_ + " " + remedy(code, database_ ? sqlite3_errmsg(database_.get()) : sqlite3_errstr(code)));
}

void Connection::run(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

long long Connection::number(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.integer() : 0;
}

std::string Connection::text(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.text() : "";
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(const Connection& connection, const std::string& sql) : connection_(connection) {
  sqlite3_stmt* prepared = nullptr;
  check(sqlite3_prepare_v2(connection.database_.get(), sql.c_str(), -1, &prepared, nullptr));
  statement_.reset(prepared);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) connection_.fail(code);
}

Statement& Statement::bind(long long value) {
  check(sqlite3_bind_int64(statement_.get(), ++parameter_, value));
  return *this;
}

Statement& Statement::bind(double value) {
  check(sqlite3_bind_double(statement_.get(), ++parameter_, value));
  return *this;
}

Statement& Statement::bind(std::string_view value) {
  check(sqlite3_bind_text64(statement_.get(), ++parameter_, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

bool Statement::step() {
  column_ = 0;
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) connection_.fail(code);
  return code == SQLITE_ROW;
}

void Statement::run() {
  step();
  check(sqlite3_reset(statement_.get()));
  parameter_ = 0;
}

long long Statement::integer() {
  return sqlite3_column_int64(statement_.get(), column_++);
}

double Statement::real() {
  return sqlite3_column_double(statement_.get(), column_++);
}

std::string Statement::text() {
  const auto* characters = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column_));
  const int size = sqlite3_column_bytes(statement_.get(), column_++);
  return characters ? std::string(characters, static_cast<std::size_t>(size)) : "";
}

Transaction::Transaction(Connection& connection, Kind kind) : connection_(connection) {
  connection.run(kind == Kind::write ? "BEGIN IMMEDIATE" : "BEGIN");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    connection_.run("ROLLBACK");
  } catch (const Error&) {
    // A failure grave enough has rolled back already; the error on its way says what happened.
  }
}

void Transaction::commit() {
  connection_.run("COMMIT");
  open_ = false;
}

}  // namespace onestroke::sqlite

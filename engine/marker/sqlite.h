#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace onestroke::sqlite {

/// A database file. Every failure is an Error that names the file and what to do. Belongs to one thread at a time.
class Connection {
 public:
  /// Opens for writing where the file allows it, otherwise for reading; creates the file where `create` says so.
  Connection(const std::filesystem::path& file, bool create);

  /// Statements without results.
  void run(const std::string& sql);
  /// The first column of the first row.
  long long number(const std::string& sql);
  std::string text(const std::string& sql);

  const std::string& file() const { return file_; }
  [[noreturn]] void fail(int code) const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// One prepared statement; the connection must outlive it.
class Statement {
 public:
  Statement(const Connection& connection, const std::string& sql);

  /// Parameters in order, columns in order: both count from the left by themselves.
  Statement& bind(long long value);
  Statement& bind(double value);
  Statement& bind(std::string_view value);

  /// True where there is a row to read.
  bool step();
  /// Runs a statement without results and makes it ready for new parameters.
  void run();

  long long integer();
  double real();
  std::string text();

 private:
  void check(int code) const;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  const Connection& connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int parameter_ = 0, column_ = 0;
};

/// All or nothing: what is not committed is rolled back.
class Transaction {
 public:
  enum class Kind { read, write };
  Transaction(Connection& connection, Kind kind);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Connection& connection_;
  bool open_ = true;
};

}  // namespace onestroke::sqlite

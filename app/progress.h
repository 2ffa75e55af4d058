#pragma once

#include <cstddef>
#include <string>

namespace onestroke {

/// A line on standard error that says how far a command is; nothing where that is no terminal.
class Progress {
 public:
  /// quiet: says nothing at all.
  explicit Progress(bool quiet = false);
  Progress(const Progress&) = delete;
  /// Leaves the last line standing.
  ~Progress();

  bool shown() const { return shown_; }
  /// At most some ten times a second.
  void say(std::size_t done, std::size_t of, const std::string& more);
  void say(const std::string& line);

 private:
  void print();

  bool shown_;
  std::string line_;
  long long next_ns_ = 0;
};

/// True where the program's standard output is a terminal.
bool output_is_terminal();

}  // namespace onestroke

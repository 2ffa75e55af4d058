#pragma once

#include "app/session_frame.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace onestroke {

/// Reads a session's log frame by frame, as SessionLog wrote it.
class SessionReader {
 public:
  /// Reads the header. Throws Error where the file is no session's log or comes from a newer version.
  explicit SessionReader(std::filesystem::path file);

  const SessionHeader& header() const { return header_; }
  /// The next frame, which lives until the next call; nullptr after the last. Throws Error, which names file and line,
  /// where a line is not one of a log. A last line that is cut short, as where the program or the computer was
  /// stopped, is left out.
  const SessionFrame* next();
  /// What the log lacks, one line; empty where it is whole. Complete after the last frame.
  std::string note() const;

 private:
  [[noreturn]] void refuse(const std::string& why) const;

  const std::filesystem::path file_;
  std::ifstream in_;
  SessionHeader header_;
  std::unique_ptr<SessionFrame> frame_;
  std::uint64_t line_number_ = 0;
  std::uint64_t missed_ = 0;
  bool cut_short_ = false;
};

}  // namespace onestroke

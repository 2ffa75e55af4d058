#include "app/session_reader.h"

#include "app/session_json.h"
#include "core/error.h"

#include <utility>

namespace onestroke {

SessionReader::SessionReader(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code unknown;
  const bool folder = std::filesystem::is_directory(file_, unknown);
  if (!folder) in_.open(file_, std::ios::binary);
  if (folder || !in_) throw Error(file_.string() + " cannot be read; name a file that `onestroke run --log` wrote");
  std::string line;
  std::getline(in_, line);
  line_number_ = 1;
  if (line.find("\"onestroke_session\"") == std::string::npos)
    throw Error(file_.string() + " is no log of a session; name a file that `onestroke run --log` wrote");
  try {
    header_ = header_of_line(line);
  } catch (const Error& error) {
    refuse(error.what());
  }
  frame_ = std::make_unique<SessionFrame>();
}

const SessionFrame* SessionReader::next() {
  std::string line;
  frame_->missed = 0;
  bool shown = false;
  while (!shown && std::getline(in_, line)) {
    ++line_number_;
    const bool whole = !in_.eof();
    try {
      shown = read_session_line(line, *frame_);
    } catch (const Error& error) {
      if (whole) refuse(error.what());
      cut_short_ = true;
    }
  }
  missed_ += frame_->missed;
  return shown ? frame_.get() : nullptr;
}

std::string SessionReader::note() const {
  std::string text;
  if (missed_ > 0) text = std::to_string(missed_) + " frames are missing, since the disk was too slow";
  if (cut_short_)
    text += (text.empty() ? "" : "; ") + ("line " + std::to_string(line_number_)) + " is cut short and was left out";
  return text.empty() ? text : file_.string() + ": " + text;
}

void SessionReader::refuse(const std::string& why) const {
  throw Error(file_.string() + ", line " + std::to_string(line_number_) + ": " + why);
}

}  // namespace onestroke

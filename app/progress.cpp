#include "app/progress.h"

#include "core/time.h"

#include <unistd.h>

#include <cstdio>

namespace onestroke {

Progress::Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (line_.empty()) return;
  print();
  std::fputc('\n', stderr);
}

void Progress::say(std::size_t done, std::size_t of, const std::string& more) {
  if (shown_) say(std::to_string(done) + (of ? "/" + std::to_string(of) : std::string()) + " pictures" + more);
}

void Progress::say(const std::string& line) {
  if (!shown_) return;
  line_ = line;
  const Time now = Time::now();
  if (now.ns < next_ns_) return;
  next_ns_ = (now + Duration::from_ms(100)).ns;
  print();
}

// Over the line before, whose rest is erased.
void Progress::print() {
  std::fprintf(stderr, "\r%s\x1b[K", line_.c_str());
}

bool output_is_terminal() {
  return isatty(STDOUT_FILENO) == 1;
}

}  // namespace onestroke

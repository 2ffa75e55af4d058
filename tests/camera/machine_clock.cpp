#include "machine_clock.h"

#include "core/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace onestroke {

MachineClock::MachineClock() {
  const char* const port = std::getenv("CAMERA_CLOCK");
  if (port) port_ = open(port, O_RDWR | O_CLOEXEC);
  if (port_ < 0) throw Error("CAMERA_CLOCK names no port of this machine's clock; run this with with_camera");
}

MachineClock::~MachineClock() {
  close(port_);
}

MachineClock::Lead MachineClock::ask() const {
  constexpr int times = 50;
  Lead best = ask_once();
  for (int i = 1; i < times; ++i)
    if (const Lead lead = ask_once(); lead.error < best.error) best = lead;
  return best;
}

MachineClock::Lead MachineClock::ask_once() const {
  const Time asked = Time::now();
  std::int64_t answer = 0;
  if (write(port_, "?", 1) != 1) throw Error("the machine's clock cannot be asked; see camera.log");
  for (std::size_t got = 0; got < sizeof answer;) {
    const ssize_t more = ::read(port_, reinterpret_cast<char*>(&answer) + got, sizeof answer - got);
    if (more <= 0) throw Error("the machine's clock does not answer; see camera.log");
    got += static_cast<std::size_t>(more);
  }
  const Duration half = (Time::now() - asked) / 2;
  return {asked + half, Time{answer} - (asked + half), half};
}

}  // namespace onestroke

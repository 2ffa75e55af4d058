#include "clock_service.h"

#include "bytes.h"
#include "core/time.h"

#include <sys/socket.h>

#include <array>

namespace onestroke::usb {

bool ClockService::answer() const {
  std::array<u8, 64> asked{};
  const ssize_t count = recv(socket_, asked.data(), asked.size(), MSG_DONTWAIT);
  if (count <= 0) return count != 0;
  for (ssize_t i = 0; i < count; ++i) {
    Bytes answer;
    append(answer, static_cast<std::uint64_t>(Time::now().ns));
    if (send(socket_, answer.data(), answer.size(), MSG_NOSIGNAL) < 0) return false;
  }
  return true;
}

}  // namespace onestroke::usb

#include "local_socket.h"

#include "core/error.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <string>

namespace onestroke::usb {

LocalSocket::~LocalSocket() {
  if (descriptor_ >= 0) close(descriptor_);
}

LocalSocket LocalSocket::accept() const {
  const int descriptor = ::accept(descriptor_, nullptr, nullptr);
  if (descriptor < 0) throw Error("nobody can connect to the camera; start it again");
  return LocalSocket(descriptor);
}

LocalSocket listen_at(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = path.string();
  LocalSocket socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (name.copy(address.sun_path, sizeof address.sun_path - 1) != name.size() ||
      bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(socket.descriptor(), 1) != 0)
    throw Error(name + " cannot be listened at; give a short path, of nothing that is there, in a folder that is");
  return socket;
}

}  // namespace onestroke::usb

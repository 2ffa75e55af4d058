#pragma once

namespace onestroke::usb {

/// Tells a program in the guest what this machine's clock says: for every byte that comes the 8 bytes, lowest first, of
/// CLOCK_MONOTONIC in ns are sent back.
class ClockService {
 public:
  explicit ClockService(int socket) : socket_(socket) {}

  /// Answers what has come. False where nobody is there any more.
  bool answer() const;

 private:
  int socket_;
};

}  // namespace onestroke::usb

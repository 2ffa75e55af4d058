#pragma once

#include <filesystem>

namespace onestroke::usb {

/// A socket that belongs to this.
class LocalSocket {
 public:
  explicit LocalSocket(int descriptor) : descriptor_(descriptor) {}
  LocalSocket(LocalSocket&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  LocalSocket(const LocalSocket&) = delete;
  ~LocalSocket();

  int descriptor() const { return descriptor_; }
  /// Waits for the next one to come.
  LocalSocket accept() const;

 private:
  int descriptor_;
};

/// Listens at a path of this machine. Throws Error where it cannot.
LocalSocket listen_at(const std::filesystem::path& path);

}  // namespace onestroke::usb

#pragma once

#include <libcamera/libcamera.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace onestroke {

/// libcamera's camera manager, of which a process has one at most: whoever holds this keeps it. Any thread.
class LibcameraSystem {
 public:
  /// Throws Error where libcamera cannot be started.
  static std::shared_ptr<LibcameraSystem> get();
  ~LibcameraSystem();
  LibcameraSystem(const LibcameraSystem&) = delete;
  LibcameraSystem& operator=(const LibcameraSystem&) = delete;

  std::vector<std::shared_ptr<libcamera::Camera>> cameras() const { return manager_.cameras(); }

 private:
  LibcameraSystem();

  /// It speaks as soon as it is made.
  struct Quiet {
    Quiet();
  };
  const Quiet quiet_;
  libcamera::CameraManager manager_;
};

/// What a maker calls it; its id where it has no name.
std::string model_of(const libcamera::Camera& camera);

/// The V4L2 device of a USB camera, as /dev/video0; empty for any other camera. `classes` is /sys/class.
std::filesystem::path usb_node(const std::string& id, const std::filesystem::path& classes = "/sys/class");

/// A video device that is there and that this user may not open; empty where there is none.
std::filesystem::path forbidden_node(const std::filesystem::path& devices = "/dev");

}  // namespace onestroke

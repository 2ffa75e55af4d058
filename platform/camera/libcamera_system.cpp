#include "camera/libcamera_system.h"

#include "core/error.h"

#include <libcamera/logging.h>
#include <libcamera/property_ids.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <mutex>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

/// The last part of what a link of sysfs leads to.
std::string target_name(const fs::path& link) {
  std::error_code unknown;
  return fs::read_symlink(link, unknown).filename().string();
}

}  // namespace

std::shared_ptr<LibcameraSystem> LibcameraSystem::get() {
  static std::mutex mutex;
  static std::weak_ptr<LibcameraSystem> running;
  const std::lock_guard lock(mutex);
  std::shared_ptr<LibcameraSystem> system = running.lock();
  if (!system) {
    system.reset(new LibcameraSystem);
    running = system;
  }
  return system;
}

// What matters of it is told in our words.
LibcameraSystem::Quiet::Quiet() {
  if (!std::getenv("LIBCAMERA_LOG_LEVELS")) libcamera::logSetTarget(libcamera::LoggingTargetNone);
}

LibcameraSystem::LibcameraSystem() {
  if (const int failed = manager_.start(); failed != 0)
    throw Error("libcamera cannot be started: " + std::generic_category().message(-failed) +
                "; LIBCAMERA_LOG_LEVELS=*:DEBUG makes it say more");
}

LibcameraSystem::~LibcameraSystem() {
  manager_.stop();
}

std::string model_of(const libcamera::Camera& camera) {
  const auto model = camera.properties().get(libcamera::properties::Model);
  return model && !model->empty() ? *model : camera.id();
}

fs::path usb_node(const std::string& id, const fs::path& classes) {
  std::error_code unknown;
  for (fs::directory_iterator at(classes / "video4linux", unknown), end; !unknown && at != end; at.increment(unknown)) {
    const fs::path device = at->path() / "device";
    if (target_name(device / "driver") != "uvcvideo") continue;
    // Bus and port, 3-2.1:1.0, whose port libcamera makes part of its id.
    const std::string place = target_name(device);
    const std::size_t port = place.find('-');
    // The others are not of pictures.
    int index = -1;
    std::ifstream(at->path() / "index") >> index;
    if (index == 0 && port != std::string::npos && id.find(place.substr(port) + "-") != std::string::npos)
      return fs::path("/dev") / at->path().filename();
  }
  return {};
}

fs::path forbidden_node(const fs::path& devices) {
  std::error_code unknown;
  for (fs::directory_iterator at(devices, unknown), end; !unknown && at != end; at.increment(unknown)) {
    const std::string name = at->path().filename().string();
    const bool node = name.starts_with("video") || name.starts_with("media");
    if (node && ::access(at->path().c_str(), R_OK | W_OK) != 0 && errno == EACCES) return at->path();
  }
  return {};
}

}  // namespace onestroke

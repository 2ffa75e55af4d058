#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace onestroke {

class Device;
class VulkanHooks;

/// What a display asks of Vulkan before it can show anything.
struct GpuNeeds {
  std::vector<std::string> instance_extensions{}, device_extensions{};
  /// Set by a headset's runtime, which must create the instance and the device itself; otherwise null.
  VulkanHooks* hooks = nullptr;
};

/// For tests: a GPU that is lost, as far as the program can tell.
struct LossRehearsal {
  /// Counts down with every submission of work; the one that brings it to 0 is refused, and so is all after it on the
  /// same Gpu. Nothing is lost from 0 on.
  std::atomic<int> submissions{0};
  /// Whether what was submitted before is lost as well; otherwise it is still done.
  std::atomic<bool> work_too{false};
};

struct GpuOptions {
  GpuNeeds needs{};
  /// Turns on Khronos validation with synchronisation validation; its words go to standard error.
  bool validation = false;
  /// Where given, counts validation's warnings and errors, to the very end; it outlives the Gpu and all made from it.
  std::atomic<int>* validation_messages = nullptr;
  /// An index into the list of devices, or part of a name, in capitals or not; empty takes a discrete GPU before an
  /// integrated one before the CPU.
  std::string gpu{};
  /// The folder that keeps compiled pipelines from run to run, so that later runs start sooner; empty for none. It need
  /// not be there, nor be writable.
  std::filesystem::path cache_folder{};
  /// Null but in tests; outlives the Gpu and all made from it.
  LossRehearsal* rehearsal = nullptr;
};

/// The GPU: instance, device, queue and memory. One thread uses it, and all that is made from it, at a time, but for
/// Renderer::prepare(). Displays and renderers share it, so it ends with the last of them.
class Gpu {
 public:
  /// Throws Error where there is no Vulkan 1.3 device, an extension or the validation layer is missing, or the named
  /// GPU is not there.
  explicit Gpu(const GpuOptions& options);
  ~Gpu();
  Gpu(Gpu&&) noexcept;
  Gpu& operator=(Gpu&&) noexcept;

  /// As the driver gives it: "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6 (LLVM 15.0.6)".
  std::string name() const;
  /// Waits until the GPU is idle.
  void wait();

  /// For the code that speaks Vulkan (render/device.h).
  const std::shared_ptr<Device>& device() { return device_; }

 private:
  std::shared_ptr<Device> device_;
};

}  // namespace onestroke

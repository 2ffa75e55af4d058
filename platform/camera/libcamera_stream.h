#pragma once

#include "camera/capture.h"
#include "camera/format_choice.h"
#include "camera/mapped_memory.h"
#include "core/spsc_queue.h"

#include <libcamera/libcamera.h>

#include <atomic>
#include <memory>
#include <vector>

namespace onestroke {

/// A libcamera camera from start to stop. libcamera's own thread only passes on the numbers of the requests that are
/// done, and wakes.
class LibcameraStream final : public CaptureStream {
 public:
  /// What is set before the first picture.
  struct Setup {
    FormatChoice choice;
    StampMoment stamped = StampMoment::exposure_start;
    libcamera::ControlList controls;
  };

  /// Takes the camera and starts it. The waker outlives the stream. Throws std::system_error with the reason where
  /// libcamera refuses, having given the camera back.
  LibcameraStream(std::shared_ptr<libcamera::Camera> camera, std::unique_ptr<libcamera::CameraConfiguration> config,
                  const Setup& setup, Waker& waker);
  ~LibcameraStream() override;

  const CaptureFormat& format() const override { return format_; }
  StampMoment stamped() const override { return stamped_; }
  std::size_t buffers() const override { return memory_.size(); }
  std::span<const std::uint8_t> plane(std::size_t buffer, std::size_t index) const override;
  std::optional<Capture> take() noexcept override;
  void give(std::size_t buffer) noexcept override;
  bool gone() const noexcept override { return gone_.load(std::memory_order_acquire); }
  void stop() noexcept override;

 private:
  void configure(libcamera::CameraConfiguration& config, const Setup& setup);
  void map_buffers();
  void start(const Setup& setup);
  // On libcamera's thread.
  void completed(libcamera::Request* request);
  void disconnected();

  std::shared_ptr<libcamera::Camera> camera_;
  Waker& waker_;
  const StampMoment stamped_;
  CaptureFormat format_;
  libcamera::Stream* stream_ = nullptr;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::vector<MappedPlanes> memory_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
  SpscQueue<std::size_t> done_{64};
  std::atomic<bool> gone_{false};
  bool running_ = false, acquired_ = false;
};

}  // namespace onestroke

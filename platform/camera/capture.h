#pragma once

#include "camera/live_options.h"
#include "camera/waker.h"
#include "core/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace onestroke {

/// How a device's bytes lie: as PixelFormat's, or rgb8's with red and blue exchanged, or JPEG.
enum class CaptureCoding { nv12, yuyv, rgb8, bgr8, mjpeg };

/// What a stream's pictures are, all of them alike.
struct CaptureFormat {
  CaptureCoding coding = CaptureCoding::yuyv;
  PictureSize size;
  std::array<std::size_t, 2> strides{};  ///< Bytes a row, per plane; unused for mjpeg.
};

/// When a driver stamps a picture.
enum class StampMoment {
  exposure_start,  ///< The first row begins to gather light.
  readout_start,   ///< The first row has gathered it and is read out.
  reception,       ///< The first bytes arrive.
};

/// One buffer that the device has filled.
struct Capture {
  std::size_t buffer = 0;
  std::uint64_t sequence = 0;        ///< The driver's; a gap is a picture that did not come.
  std::int64_t stamp_ns = 0;         ///< By the driver's own clock; 0 for none.
  std::size_t bytes = 0;             ///< Of all planes together; less than a whole picture where it is cut short.
  bool damaged = false;              ///< By the driver's own word.
  std::optional<Duration> exposure;  ///< Where the device tells each picture's.
};

/// A camera's pictures from start to stop. One thread. The memory of the buffers stays until the stream goes, also
/// after stop().
class CaptureStream {
 public:
  virtual ~CaptureStream() = default;

  virtual const CaptureFormat& format() const = 0;
  virtual StampMoment stamped() const = 0;
  virtual std::size_t buffers() const = 0;
  /// Plane 0 or 1 of a buffer; JPEG is in plane 0, which may be longer than the picture.
  virtual std::span<const std::uint8_t> plane(std::size_t buffer, std::size_t index) const = 0;

  /// The oldest buffer that has been filled and was not taken yet, if there is one. Never waits, never throws.
  virtual std::optional<Capture> take() noexcept = 0;
  /// Gives a buffer that was taken to the device again.
  virtual void give(std::size_t buffer) noexcept = 0;
  /// The device is away, for good as far as this stream goes.
  virtual bool gone() const noexcept = 0;
  virtual void stop() noexcept = 0;
};

/// Why a stream could not be started.
enum class CaptureRefusal {
  absent,  ///< No such camera is connected.
  busy,    ///< Another program has it.
  denied,  ///< This user may not open it.
  failed,  ///< Anything else, which trying again may mend.
};

/// A device that may come and go. One thread.
class CaptureSource {
 public:
  struct Refused {
    CaptureRefusal refusal = CaptureRefusal::failed;
    std::string why{};  ///< One line.
  };

  virtual ~CaptureSource() = default;

  /// How it is called in messages.
  virtual std::string name() const = 0;
  /// Starts the device, which then wakes the waker, which outlives it, whenever a buffer is filled and when it goes.
  /// Null where it cannot be had at this moment, which `refused` then explains. Throws Error where it can never do: it
  /// has no format that can be used, or is asked for what it lacks.
  virtual std::unique_ptr<CaptureStream> start(Waker& waker, Refused& refused) = 0;
};

}  // namespace onestroke

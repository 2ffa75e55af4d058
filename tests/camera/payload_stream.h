#pragma once

#include "bytes.h"
#include "camera_script.h"
#include "event_log.h"
#include "video_mode.h"

#include <optional>

namespace onestroke::usb {

/// The pictures of a mode as the payloads of UVC 1.0, chapter 2.4.3.3: pieces of a picture, each behind a header that
/// tells which picture it is of, whether it is the last, when the picture began and what the camera's clock says now.
///
/// Pictures fall due at their own pace. One that falls due while the one before is not yet taken is skipped, as a
/// sensor does not wait.
class PayloadStream {
 public:
  /// mode: as long as this lives. The first picture is due one interval from now.
  PayloadStream(const VideoMode& mode, Duration interval, const CameraScript& script, EventLog& log);

  /// When there is a payload to take, unless all is over.
  std::optional<Time> next_at() const;
  /// The next payload of at most so many bytes; empty where none is due. Logs a picture's first one.
  const Bytes& take(std::size_t most);
  /// The next picture is due one interval from now.
  void resume();

  /// True where no picture is on its way.
  bool between_pictures() const { return !sending_; }
  /// How many pictures have been sent.
  std::uint64_t sent() const { return sent_; }

 private:
  void begin(Time now);

  const VideoMode& mode_;
  const Duration interval_;
  const CameraScript& script_;
  EventLog& log_;
  Time due_;
  std::uint64_t number_ = 0, sent_ = 0;
  bool sending_ = false, over_ = false, odd_ = false;
  std::size_t size_ = 0, at_ = 0;
  u32 began_ticks_ = 0;
  Bytes payload_;
};

}  // namespace onestroke::usb

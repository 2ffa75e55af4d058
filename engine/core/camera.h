#pragma once

#include "core/picture.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onestroke {

/// Where a marker truly is; only cameras that make their own pictures know.
struct TrueMarker {
  int id = 0;
  Pose T_camera_marker;  ///< At exposure.middle().
  int cells_visible = 0;
};

/// A source of pictures. One thread calls next(); handles may be released on any thread. A camera outlives its handles.
class Camera {
 public:
  enum class Status {
    ok,    ///< picture holds the next picture
    busy,  ///< every buffer is lent out, or none is ready yet; ask again
    end,   ///< a recording is over, or the device is gone; message() says which
  };

  virtual ~Camera() = default;

  /// The next picture in order. Live cameras wait for it; files and the synthetic camera make it at once. Never throws.
  virtual Status next(PictureHandle& picture) = 0;
  /// Why next() said `end`, one line; empty where the recording simply ended.
  virtual std::string message() const = 0;
  /// True where pictures come at their own pace (a device) and the newest wins; false where each must be taken (files).
  virtual bool live() const = 0;
  /// Pictures per second; 0 where unknown (unrelated pictures).
  virtual double rate() const = 0;
  /// How many pictures there will be; 0 where there is no end.
  virtual std::size_t length() const = 0;
  /// Seconds after which a camera without an end begins again; 0 where it does not.
  virtual double period() const { return 0; }
  /// What keeps a live camera from giving pictures at this moment, with the remedy, one line; empty while all is well.
  /// The words live as long as the program. Any thread.
  virtual std::string_view trouble() const { return {}; }
  /// How many pictures a device took that never came, by its own numbers, or came damaged. Any thread.
  virtual std::uint64_t lost() const { return 0; }
  /// A recording goes on with the first picture that is no earlier than this after its start. Any thread; heeded by the
  /// next call of next(). False where the camera is no recording.
  virtual bool seek(Duration) { return false; }
  /// When a recording's first picture was taken, by its pictures' times.
  virtual Time began() const { return {}; }
  /// The truth beside a picture, where it is known; valid as long as the picture is held.
  virtual std::span<const TrueMarker> truth(const Picture&) const { return {}; }
};

}  // namespace onestroke

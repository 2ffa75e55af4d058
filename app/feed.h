#pragma once

#include "core/frame_record.h"
#include "core/picture.h"
#include "render/display.h"

#include <span>
#include <string>
#include <string_view>

namespace onestroke {

/// Which picture each frame of a show has, and which poses belong to it. One thread, the one that renders.
class Feed {
 public:
  enum class Pace {
    newest,       ///< a device: the newest picture
    at_its_time,  ///< a recording on a screen: each picture when its time has come
    each,         ///< into files, or as it was shown before: frame after frame, each waited for
  };
  enum class Next { same, picture, end };

  virtual ~Feed() = default;

  /// The next frame, to be seen at `display_time`: shows the same picture again, or another one, or there will be none
  /// any more. `stop` ends the wait of pace `each`. Never throws.
  virtual Next advance(Time display_time, bool (*stop)()) = 0;
  /// Of the last Next::picture; empty once it has been taken.
  virtual PictureHandle take_picture() = 0;
  virtual const FrameRecord& record() const = 0;
  /// The time that the frame shows, in the record's time until a recording goes on elsewhere; neither goes back nor
  /// leaps there.
  virtual Time now() const = 0;
  /// A pause: a recording goes on as if no time had passed.
  virtual void hold() = 0;
  /// A recording that is shown at its time goes on so much later, or earlier; others do not mind.
  virtual void skip(Duration) {}
  /// Keys that belong to this frame besides the display's own.
  virtual std::span<const Key> keys() const { return {}; }

  virtual Pace pace() const = 0;
  /// What keeps a camera from giving pictures at this moment; empty while all is well.
  virtual std::string_view trouble() const { return {}; }
  /// How many pictures were not shown, because others were newer or they did not come whole.
  virtual std::uint64_t left_out() const { return 0; }
  /// Why there are no more pictures; empty at the plain end, and before it.
  virtual std::string message() const = 0;
};

}  // namespace onestroke

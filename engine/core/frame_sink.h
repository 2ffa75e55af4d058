#pragma once

#include "core/frame_record.h"
#include "core/picture.h"

namespace onestroke {

/// Hears of every picture that was tracked, on the thread that tracked it.
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Neither waits for anybody nor allocates. False where there is no room at the moment: where every picture counts it
  /// is offered again. One thread at a time.
  virtual bool add(const PictureHandle& picture, const FrameRecord& record) noexcept = 0;
  /// The picture is not offered again.
  virtual void leave_out() noexcept = 0;
};

}  // namespace onestroke

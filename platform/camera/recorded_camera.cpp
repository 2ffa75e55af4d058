#include "camera/recorded_camera.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace onestroke {
namespace {

constexpr double usual_rate = 30;

}  // namespace

void RecordedCamera::play(const Playback& playback) {
  playback_ = playback;
  if (playback.from.ns <= 0 || !message_.empty()) return;
  if (!go_to(playback.from) && message_.empty()) {
    std::ostringstream words;
    words << name_ << " has no picture " << playback.from.seconds()
          << " seconds after its first; give an earlier --from";
    throw Error(words.str());
  }
  skipped_ = static_cast<std::size_t>(std::ceil(std::max(0.0, playback.from.seconds() * rate() - 1e-6)));
}

bool RecordedCamera::seek(Duration after_start) {
  wanted_.store(after_start.ns, std::memory_order_relaxed);
  return true;
}

double RecordedCamera::period() const {
  return playback_.loop && rate() > 0 ? static_cast<double>(pictures()) / rate() : 0;
}

Camera::Status RecordedCamera::next(PictureHandle& picture) {
  try {
    return take(picture);
  } catch (const std::exception& error) {
    fail(error.what());
    return Status::end;
  }
}

Camera::Status RecordedCamera::take(PictureHandle& picture) {
  if (!message_.empty()) return Status::end;
  if (const std::int64_t wanted = wanted_.exchange(nowhere, std::memory_order_relaxed); wanted != nowhere) {
    over_ = false;
    go_to(std::max(Duration{wanted} - later_, Duration{}));
  }
  if (over_) return Status::end;
  PictureHandle::Loan* loan = pool_->acquire();
  if (!loan) return Status::busy;
  PictureHandle read_one(*loan);
  over_ = !read(*loan) && !(begin_again() && read(*loan));
  if (over_) return Status::end;
  Picture& p = loan->picture;
  last_ = std::max(last_, p.exposure.start);
  last_number_ = std::max(last_number_, p.sequence);
  any_ = true;
  shift(p);
  picture = std::move(read_one);
  return Status::ok;
}

void RecordedCamera::shift(Picture& picture) const {
  picture.exposure.start = picture.exposure.start + later_;
  picture.sequence += higher_;
}

/// The first picture follows the last as any picture does the one before.
bool RecordedCamera::begin_again() {
  if (!playback_.loop || !any_ || !message_.empty()) return false;
  const double apart = 1 / (rate() > 0 ? rate() : usual_rate);
  later_ = later_ + (last_ - began_) + Duration::from_seconds(apart);
  higher_ += last_number_ + 1 - first_number_;
  return go_to({});
}

}  // namespace onestroke

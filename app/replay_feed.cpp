#include "app/replay_feed.h"

#include "core/error.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace onestroke {
namespace {

// As dark as a room without a lamp, so that models before it can be told from nothing.
constexpr std::uint8_t darkness = 24;
// One that is shown, one that is on its way, and one to spare.
constexpr std::size_t dark_buffers = 3;

}  // namespace

ReplayFeed::Next ReplayFeed::advance(Time, bool (*stop)()) {
  const SessionFrame* frame = next_frame();
  if (!frame) return Next::end;
  frame_ = frame;
  take_keys();
  if (!frame_->picture) return Next::same;
  picture_ = find_picture(stop);
  if (!picture_) picture_ = dark_picture();
  return picture_ ? Next::picture : Next::same;
}

std::optional<Pose> ReplayFeed::head_at(Time) const {
  const std::optional<Pose>& T_head_camera = session_.header().T_head_camera;
  if (!T_head_camera || !frame_) return std::nullopt;
  return frame_->record.T_world_camera * inverse(*T_head_camera);
}

const SessionFrame* ReplayFeed::next_frame() {
  try {
    return session_.next();
  } catch (const Error& error) {
    message_ = error.what();
    return nullptr;
  }
}

void ReplayFeed::take_keys() {
  keys_.clear();
  for (const Key key : frame_->keys)
    if (key != Key::space && key != Key{'q'} && key != Key::escape) keys_.push_back(key);
}

PictureHandle ReplayFeed::find_picture(bool (*stop)()) {
  const std::uint64_t wanted = frame_->record.sequence;
  while (camera_ && seen_ <= wanted) {
    ahead_.reset();
    const Camera::Status status = camera_->next(ahead_);
    if (status == Camera::Status::ok) seen_ = ahead_->sequence + 1;
    if (status == Camera::Status::end || stop()) camera_ = nullptr;
    if (status == Camera::Status::busy) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  const bool found = ahead_ && ahead_->sequence == wanted;
  if (found && session_.header().T_head_camera) {
    const Pose& T_world_first = frame_->record.T_world_camera;
    ahead_.set_T_world_camera(T_world_first);
    if (frame_->second.width > 0) ahead_.set_T_world_second(T_world_first * frame_->second.T_first_second);
  }
  return found ? std::move(ahead_) : PictureHandle();
}

PictureHandle ReplayFeed::dark_picture() {
  const PictureLens& lens = frame_->lens;
  if (lens.width == 0) return {};
  const std::size_t stride = 3 * static_cast<std::size_t>(lens.width);
  PicturePool& pool =
      dark_.try_emplace({lens.width, lens.height}, dark_buffers, stride * static_cast<std::size_t>(lens.height))
          .first->second;
  PictureHandle::Loan* loan = pool.acquire();
  if (!loan) return {};
  std::ranges::fill(pool.bytes(*loan), darkness);
  Picture& p = loan->picture;
  p.width = lens.width;
  p.height = lens.height;
  p.intrinsics = lens.intrinsics;
  p.planes[0] = pool.bytes(*loan).data();
  p.strides[0] = stride;
  p.sequence = frame_->record.sequence;
  p.exposure.start = frame_->record.time;
  p.T_world_camera = frame_->record.T_world_camera;
  ++dark_pictures_;
  return PictureHandle(*loan);
}

}  // namespace onestroke

#include "app/show.h"

#include "app/interrupt.h"
#include "core/error.h"

namespace onestroke {

Show::Show(const Parts& parts, FrameFeed::Pace pace, PictureTime mode)
    : parts_(parts), feed_(parts.tracking, pace, mode), hands_(parts.shelf), status_(pace != FrameFeed::Pace::each) {}

void Show::run(const ShowLimits& limits, const std::function<void(std::size_t pictures)>& say) {
  Display& display = parts_.display;
  FrameInfo frame;
  Time began;
  bool going = true, failed = false;
  for (std::size_t pictures = 0, frames = 0; going && !display.closed() && !interrupted(); ++frames) {
    for (const Key key : display.poll()) going = press(key) && going;
    display.begin(frame);
    if (frames == 0) began = frame.time;
    FrameFeed::Next next = FrameFeed::Next::same;
    if (!paused_) next = feed_.advance(frame.time, interrupted);
    if (next == FrameFeed::Next::end || frame.time - began >= limits.length) {
      frame.should_render = going = false;
    } else if (next == FrameFeed::Next::picture) {
      take_picture();
      say(++pictures);
      going = going && pictures < limits.pictures;
    }
    if (frame.should_render) failed = !draw(frame, next == FrameFeed::Next::picture);
    display.end(frame);
    if (failed) throw Error(parts_.renderer.failure());
  }
}

bool Show::press(Key key) {
  if (key == Key{'l'}) hands_.toggle_link();
  if (key == Key{'h'}) hands_.toggle_words();
  if (key == Key::space) {
    paused_ = !paused_;
    feed_.hold();
  }
  return key != Key{'q'} && key != Key::escape;
}

// The bytes are copied to the GPU here, so the buffer goes back to the camera at once.
void Show::take_picture() {
  const PictureHandle picture = feed_.take_picture();
  parts_.renderer.set_picture(*picture);
  lens_ = {picture->intrinsics, picture->width, picture->height, picture->T_world_camera};
}

// Without a head to follow, the eye stands where the camera stood, and sees what the camera saw.
void Show::stand_at_camera(FrameInfo& frame) const {
  if (parts_.display.tracks_head() || lens_.width == 0) return;
  for (int i = 0; i < frame.view_count; ++i) {
    View& view = frame.views[static_cast<std::size_t>(i)];
    // A pair of eyes stays apart.
    view.T_world_view = lens_.T_world_camera * view.T_world_view;
    view.fov = fov_to_fit(lens_.intrinsics, lens_.width, lens_.height, view.viewport);
  }
}

bool Show::draw(FrameInfo& frame, bool new_picture) {
  stand_at_camera(frame);
  parts_.shelf.update();
  const std::uint64_t dropped = parts_.tracking.pictures_dropped() + parts_.tracking.frames_dropped();
  const std::string_view status = status_.update(feed_.record(), new_picture, dropped, Time::now());
  return parts_.renderer.draw(hands_.update(feed_.record(), feed_.now(), frame.seen(), status), frame);
}

}  // namespace onestroke

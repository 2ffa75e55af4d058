#include "app/show.h"

#include "app/interrupt.h"
#include "core/error.h"

namespace onestroke {

Show::Show(const Parts& parts, FrameFeed::Pace pace, PictureTime mode)
    : parts_(parts),
      clocked_(pace == FrameFeed::Pace::newest),
      feed_(parts.tracking, pace, mode),
      hands_(parts.shelf),
      hud_words_(pace != FrameFeed::Pace::each),
      status_(pace != FrameFeed::Pace::each) {}

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

void Show::measure(const FrameInfo& frame, bool new_picture) {
  const FrameRecord& record = feed_.record();
  std::optional<Duration> age;
  if (clocked_ && record.time.ns != 0) age = frame.time - record.time;
  meter_.update({.record = record,
                 .new_picture = new_picture,
                 .left_out = parts_.tracking.pictures_dropped() + parts_.tracking.frames_dropped(),
                 .age = age,
                 .now = Time::now()});
}

bool Show::draw(FrameInfo& frame, bool new_picture) {
  stand_at_camera(frame);
  measure(frame, new_picture);
  const FrameRecord& record = feed_.record();
  // A panel on a desk; before the eyes a line is enough.
  const bool desktop = frame.view_count == 1 && !parts_.display.tracks_head();
  const std::string_view status = desktop ? std::string_view() : status_.update(meter_.figures());
  FrameScene scene = hands_.update(record, feed_.now(), frame.seen(), status);
  if (desktop && hands_.words()) {
    hud_words_.update(record, meter_.figures());
    scene.gui = &hud_.lay_out(hud_words_, frame.views[0].viewport);
  }
  return parts_.renderer.draw(scene, frame);
}

}  // namespace onestroke

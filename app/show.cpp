#include "app/show.h"

#include "app/interrupt.h"
#include "app/snapshot_numbers.h"
#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace onestroke {

namespace {

// How long the wearer is told where a snapshot went.
constexpr Duration noticed_for = Duration::from_seconds(3);

void stand(View& view, const Pose& T_world_camera, const PictureLens& lens) {
  view.T_world_view = T_world_camera;
  view.fov = fov_to_fit(lens.intrinsics, lens.width, lens.height, view.viewport);
}

PictureLens lens_of(const Picture& picture) {
  return {picture.width, picture.height, picture.intrinsics};
}

}  // namespace

Show::Show(const Parts& parts, const ShowOptions& options)
    : parts_(parts),
      fingers_(options.fingers),
      films_(parts.feed.pace() == Feed::Pace::each),
      shows_world_(parts.display.shows_world()),
      hands_(parts.graphics.shelf(), &parts.graphics.differences(),
             {.left_handed = options.left_handed, .worn = parts.display.tracks_head(), .wait_for_differences = films_}),
      covered_(parts.graphics.shelf()),
      hud_words_(!films_),
      snapshots_(options.snapshots) {}

void Show::run(const ShowLimits& limits, const std::function<void(std::size_t pictures)>& say) {
  Display& display = parts_.display;
  FrameInfo frame;
  Time began;
  bool going = true, again = false;
  for (std::size_t pictures = 0, frames = 0; (going || again) && !display.closed() && !interrupted(); ++frames) {
    for (const Key key : display.poll()) {
      if (parts_.log) parts_.log->press(key);
      going = press(key) && going;
    }
    display.begin(frame);
    if (frames == 0) began = frame.time;
    Feed::Next next = Feed::Next::same;
    const bool goes_on = !again && !paused_;
    if (goes_on) next = parts_.feed.advance(frame.time, interrupted);
    const bool over = !again && (next == Feed::Next::end || frame.time - began >= limits.length);
    if (over) {
      frame.should_render = going = false;
    } else if (next == Feed::Next::picture) {
      take_picture();
      say(++pictures);
      going = going && pictures < limits.pictures;
    }
    if (goes_on && !over)
      for (const Key key : parts_.feed.keys()) press(key);
    show(frame, next == Feed::Next::picture);
    going = press(std::exchange(asked_, Key::none)) && going;
    if (!again && !over) write_down(next == Feed::Next::picture);
    // A frame that went with the GPU is drawn once more.
    again = !over && lost();
    if (again) recover(frame.time);
  }
}

/// Draws where the display wants it, and shows what was drawn.
void Show::show(FrameInfo& frame, bool new_picture) {
  const bool failed = frame.should_render && !draw(frame, new_picture);
  if (failed) frame.should_render = false;
  parts_.display.end(frame);
  const Renderer& renderer = parts_.graphics.renderer();
  if (failed && !renderer.lost()) throw Error(renderer.failure());
}

bool Show::lost() const {
  return parts_.graphics.renderer().lost() || parts_.display.gpu_lost();
}

void Show::recover(Time now) {
  if (lost_at_ && now - *lost_at_ < lost_again_within)
    throw Error(std::string(parts_.display.tracks_head() ? "the headset's runtime or the GPU" : "the GPU") +
                " was lost twice within " + std::to_string(std::lround(lost_again_within.seconds())) + " seconds: " +
                (parts_.display.tracks_head() ? "restart the runtime's service, or update the GPU's driver"
                                              : "update its driver, or choose another with --gpu"));
  lost_at_ = now;
  parts_.graphics.rebuild();
  hands_.shelf_is_new();
  if (picture_) show_picture();
}

bool Show::press(Key key) {
  if (const int character = static_cast<int>(key); character < 128) hands_.press(static_cast<char>(character));
  if (key == Key{'h'}) hands_.toggle_words();
  if (key == Key{'r'}) parts_.display.recentre();
  if (key == Key::space) {
    paused_ = !paused_;
    parts_.feed.hold();
  }
  return key != Key{'q'} && key != Key::escape;
}

void Show::take_picture() {
  picture_ = parts_.feed.take_picture();
  show_picture();
  lens_ = lens_of(*picture_);
  T_world_camera_ = picture_->T_world_camera;
  second_lens_ = {};
  if (const Picture* second = picture_->second)
    second_lens_ = {lens_of(*second), inverse(T_world_camera_) * second->T_world_camera};
}

// Where the world is seen, the picture is for the light alone.
void Show::show_picture() {
  Renderer& renderer = parts_.graphics.renderer();
  const FrameRecord& record = parts_.feed.record();
  renderer.set_picture(*picture_, shows_world_ ? std::span<const CoveredCell>() : covered_.find(record, *picture_));
  if (picture_->second && !shows_world_)
    renderer.set_second_picture(*picture_->second, covered_.find_in_second(record, *picture_->second));
}

void Show::write_down(bool new_picture) {
  if (!parts_.log) return;
  for (const std::string_view word : hands_.comparison().happened()) parts_.log->happened(word);
  parts_.log->took(latency_);
  parts_.log->add(parts_.feed.record(), parts_.feed.now(), new_picture, lens_, second_lens_);
}

// Without a head to follow, the eye stands where the camera stood, and sees what the camera saw; of two eyes each where
// its own did.
void Show::stand_at_camera(FrameInfo& frame) const {
  if (parts_.display.tracks_head() || lens_.width == 0) return;
  if (frame.view_count == 2 && second_lens_.width > 0) {
    stand(frame.views[0], T_world_camera_, lens_);
    stand(frame.views[1], T_world_camera_ * second_lens_.T_first_second, second_lens_);
    return;
  }
  for (int i = 0; i < frame.view_count; ++i) {
    View& view = frame.views[static_cast<std::size_t>(i)];
    // A pair of eyes stays apart.
    view.T_world_view = T_world_camera_ * view.T_world_view;
    view.fov = fov_to_fit(lens_.intrinsics, lens_.width, lens_.height, view.viewport);
  }
}

void Show::measure(bool new_picture) {
  meter_.update({.record = parts_.feed.record(),
                 .new_picture = new_picture,
                 .left_out = parts_.feed.left_out(),
                 .latency = latency_,
                 .now = Time::now()});
}

/// Of a frame that was handed to the GPU just now.
std::optional<Latency> Show::latency_of(const FrameInfo& frame) const {
  // A device's pictures come with the time on the display's clock.
  if (parts_.feed.pace() != Feed::Pace::newest || !picture_) return std::nullopt;
  const Time taken = picture_->exposure.middle();
  if (taken.ns == 0) return std::nullopt;
  return Latency{
      .tracked = parts_.feed.record().tracked - taken, .drawn = Time::now() - taken, .seen = frame.time - taken};
}

bool Show::draw(FrameInfo& frame, bool new_picture) {
  stand_at_camera(frame);
  parts_.graphics.shelf().update();
  measure(new_picture);
  const FrameRecord& record = parts_.feed.record();
  // A panel on a desk; before the eyes a line is enough.
  const bool desktop = frame.view_count == 1 && !parts_.display.tracks_head();
  hud_words_.update(record, meter_.figures());
  const std::string_view status = desktop ? std::string_view() : hud_words_.status();
  hands_.say(notice());
  FrameScene scene = hands_.update(record, parts_.feed.now(), frame.seen(), status);
  scene.fingers = fingers_;
  scene.picture_brightness = brightness();
  if (const char asked = hands_.comparison().asked_key) asked_ = Key{asked};
  if (hands_.comparison().snapshot) take_snapshot(scene, frame.views[0]);
  if (desktop && hands_.words()) scene.gui = &hud_.lay_out(hud_words_, frame.views[0].viewport);
  if (shows_world_) {
    scene.passthrough_distance.reset();
    scene.background = {0, 0, 0, 0};
  }
  const bool drawn = parts_.graphics.renderer().draw(scene, frame, parts_.display);
  latency_ = latency_of(frame);
  return drawn;
}

/// A picture that stays since none comes any more fades.
float Show::brightness() const {
  constexpr double stays = 0.2, fades = 1, rest = 0.2;  // seconds, seconds, a share of its light
  const double age = (parts_.feed.now() - parts_.feed.record().time).seconds() - stays;
  return static_cast<float>(1 - (1 - rest) * std::clamp(age / fades, 0.0, 1.0));
}

// A frame that is late for once: the picture is drawn anew, in the size in which it is seen.
void Show::take_snapshot(const FrameScene& scene, const View& view) {
  const DifferenceDesk::Result* difference = hands_.difference();
  snapshots_.take(parts_.graphics.gpu(), parts_.graphics.renderer(), scene, view,
                  snapshot_numbers(parts_.graphics.catalog(), parts_.feed.record(), hands_.comparison(),
                                   difference ? &difference->statistics : nullptr));
  snapshot_at_ = parts_.feed.now();
  if (films_) snapshots_.wait();
}

std::string_view Show::notice() const {
  if (const std::string_view trouble = parts_.feed.trouble(); !trouble.empty()) return trouble;
  const bool recent = snapshot_at_ && parts_.feed.now() - *snapshot_at_ < noticed_for;
  return recent ? snapshots_.notice() : std::string_view();
}

}  // namespace onestroke

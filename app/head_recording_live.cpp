#include "app/graphics.h"
#include "app/head_recording.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/source.h"
#include "core/error.h"
#include "display/open_display.h"
#include "render/renderer.h"
#include "tracking/tracking_thread.h"

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

namespace onestroke {
namespace {

// Where the words stand before the eyes, mm, and how large.
constexpr Vec3 words_from_head{0, 120, 800};
constexpr double words_height_mm = 22;

/// What the wearer sees: the camera's picture, and how far it is.
class Prompter {
 public:
  explicit Prompter(Gpu& gpu) : renderer_(gpu) {}

  void set_picture(PictureHandle picture, const Pose& T_world_camera) {
    renderer_.set_picture(*picture);
    renderer_.set_picture_pose(T_world_camera);
    picture_ = std::move(picture);
  }

  void draw(const FrameInfo& frame, const Sights& sights) {
    words_ = sights.advice() + "\n" + percent(sights);
    const Pose& eye = frame.views[0].T_world_view;
    const std::array labels{
        Label{.text = words_, .position_world = eye * words_from_head, .height_mm = words_height_mm, .on_top = true}};
    FrameScene scene;
    scene.labels = labels;
    if (!renderer_.draw(scene, frame))
      throw Error(renderer_.lost() ? "the GPU was lost: calibrate again" : renderer_.failure());
  }

  static std::string percent(const Sights& sights) {
    return std::to_string(std::lround(100 * sights.progress())) + " %";
  }

 private:
  Renderer renderer_;
  PictureHandle picture_;
  std::string words_;
};

void record(Display& display, TrackingThread& tracking, Prompter& prompter, const CalibrateOptions& options,
            Sights& sights, HeadRecording& recording) {
  Progress progress;
  const Time began = Time::now();
  const auto out_of_time = [&] { return options.seconds && (Time::now() - began).seconds() >= *options.seconds; };
  FrameInfo frame;
  while (!sights.enough() && !out_of_time() && !display.closed() && !interrupted()) {
    display.poll();
    display.begin(frame);
    const bool finished = tracking.finished();
    tracking.drain([&](TrackedFrame& tracked) {
      recording.focal_px = tracked.picture->intrinsics.fx;
      const std::optional<Pose> head = display.head_at(tracked.record.time);
      if (!head) return;
      sights.add(tracked.record, *head);
      prompter.set_picture(std::move(tracked.picture), *head);
    });
    if (frame.should_render) prompter.draw(frame, sights);
    display.end(frame);
    if (display.gpu_lost()) throw Error("the headset's runtime went away: start it, and calibrate again");
    progress.say(Prompter::percent(sights) + ": " + sights.advice());
    if (!finished) continue;
    if (!tracking.message().empty()) throw Error(tracking.message());
    break;
  }
}

}  // namespace

HeadRecording record_live(const CalibrateOptions& options, Sights& sights) {
  const Catalog catalog = load_catalog(options.catalog);
  const std::unique_ptr<Display> display = open_display(options.display, {});
  if (!display->tracks_head())
    throw UsageError("--display " + options.display + " follows no head: use --display openxr");
  // Where the camera sits is not known yet: as if where the head is. The pictures do not say so, or a tracker that
  // expects the marker to stand still in the world would find the head's poses confirmed.
  const HeadMount mount{.head = display.get(), .T_head_camera = {}};
  const std::unique_ptr<Camera> camera = open_source(options.source, catalog, mount);
  if (!camera->live())
    throw UsageError("the pictures of " + options.source.camera +
                     " are not taken now, by the headset's camera: give --head-poses FILE with where the head was");
  HeadRecording recording{.headset = display->headset(), .camera = options.source.camera};
  GpuOptions wanted = gpu_options(options.gpu);
  wanted.needs = display->needs();
  Gpu gpu(wanted);
  display->attach(gpu);
  Prompter prompter(gpu);
  Tracker tracker(catalog);
  TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::newest);
  catch_interrupt();
  record(*display, tracking, prompter, options, sights, recording);
  display->finish();
  return recording;
}

}  // namespace onestroke

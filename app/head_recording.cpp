#include "app/head_recording.h"

#include "app/head_pose_file.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/session_reader.h"
#include "app/source.h"
#include "core/error.h"
#include "tracking/tracker.h"

#include <chrono>
#include <memory>
#include <thread>

namespace onestroke {

HeadRecording record_from_log(const CalibrateOptions& options, Sights& sights) {
  SessionReader session(options.replay);
  if (!session.header().T_head_camera)
    throw Error(options.replay.string() + " has no poses of a head: record a session with --display openxr");
  const Pose T_camera_head = inverse(*session.header().T_head_camera);
  HeadRecording recording{.headset = options.headset, .camera = session.header().camera};
  while (const SessionFrame* frame = session.next()) {
    if (!frame->picture) continue;
    sights.add(frame->record, frame->record.T_world_camera * T_camera_head);
    recording.focal_px = frame->lens.intrinsics.fx;
  }
  return recording;
}

HeadRecording record_from_poses(const CalibrateOptions& options, Sights& sights) {
  std::optional<HeadPoseFile> heads;
  if (!options.head_poses.empty()) heads.emplace(options.head_poses);
  const Catalog catalog = load_catalog(options.catalog);
  const std::unique_ptr<Camera> camera = open_source(options.source, catalog);
  HeadRecording recording{.headset = options.headset, .camera = options.source.camera};
  // Pictures without times have nothing to do with each other.
  Tracker tracker(catalog, {.independent = camera->rate() <= 0});
  const auto record = std::make_unique<FrameRecord>();
  Progress progress;
  catch_interrupt();
  PictureHandle picture;
  for (std::size_t taken = 0; !interrupted();) {
    const Camera::Status status = camera->next(picture);
    if (status == Camera::Status::end) break;
    if (status == Camera::Status::busy) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    progress.say(++taken, camera->length(), ", " + std::to_string(sights.seen()) + " sights");
    recording.focal_px = picture->intrinsics.fx;
    const std::optional<Pose> head = heads ? heads->head_of(*picture) : std::optional(picture->T_world_camera);
    if (!head) continue;
    // A tracker that knew would find the head's poses confirmed.
    picture.set_T_world_camera({});
    tracker.process(*picture, *record);
    sights.add(*record, *head);
  }
  if (!camera->message().empty()) throw Error(camera->message());
  return recording;
}

HeadRecording record_sights(const CalibrateOptions& options, Sights& sights) {
  if (!options.replay.empty()) return record_from_log(options, sights);
  if (!options.head_poses.empty() || options.recorded) return record_from_poses(options, sights);
  return record_live(options, sights);
}

}  // namespace onestroke

#pragma once

#include "app/command_line.h"
#include "app/session_log.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <memory>

namespace onestroke {

/// What a session's log says of how it was started. `options` with the camera and the catalogue that were opened;
/// rate: the display's, 0 for a screen. T_head_camera: where a head is tracked.
SessionHeader session_header(const RunOptions& options, double rate, const std::optional<Pose>& T_head_camera);
/// The way back: options as given for a replay, with what the log fixes.
RunOptions replay_options(const SessionHeader& header, const RunOptions& given);

/// Opens the log that --log asks for, or the usual one: in an off-screen display's folder, or for a window among the
/// newest sessions. nullptr for none; also where a window's usual place cannot be had, which is said on standard error.
/// Throws Error where any other cannot be written.
std::unique_ptr<SessionLog> open_session_log(const RunOptions& options, const std::string& display,
                                             const SessionHeader& header);

/// The camera of a replay; `mount` is whose head a synthetic one sees from. Where the log's own cannot be opened any
/// more that is said on standard error, and nullptr returned; one that was given instead throws Error.
std::unique_ptr<Camera> open_replay_camera(const RunOptions& given, const RunOptions& options, const Catalog& catalog,
                                           const HeadMount& mount);

}  // namespace onestroke

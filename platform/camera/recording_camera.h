#pragma once

#include "camera/lens_source.h"
#include "camera/recorded_camera.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace onestroke {

/// True where the folder is a recording, by its header.
bool is_recording(const std::filesystem::path& folder);

/// The pictures of a recording as they were tracked: pixels, times, numbers, lens, place of the head, and the right
/// eye's picture where there was one. A lens or a readout that is known otherwise takes the place of the recorded one.
/// Throws Error where the recording is damaged before its last line or comes from a newer version.
std::unique_ptr<RecordedCamera> open_recording(const std::filesystem::path& folder, const LensSource& lens,
                                               std::optional<Duration> readout);

}  // namespace onestroke

#pragma once

#include "camera/lens_source.h"
#include "camera/recorded_camera.h"

#include <filesystem>
#include <memory>

namespace onestroke {

/// The pictures of a video file, each at its own time from 0, turned upright where the file says how. A file that ends
/// before it says ends the camera with a message. Throws Error where the file is missing or is no video.
std::unique_ptr<RecordedCamera> open_video(const std::filesystem::path& file, const LensSource& lens, Duration readout);

}  // namespace onestroke

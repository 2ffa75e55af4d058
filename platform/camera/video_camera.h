#pragma once

#include "camera/lens_source.h"
#include "core/camera.h"

#include <filesystem>
#include <memory>

namespace onestroke {

/// The pictures of a video file, at the container's times from 0. A file that ends before its container says ends the
/// camera with a message. Throws Error where the file is missing or is no video.
std::unique_ptr<Camera> open_video(const std::filesystem::path& file, const LensSource& lens, Duration readout);

}  // namespace onestroke

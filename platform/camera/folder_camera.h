#pragma once

#include "camera/lens_source.h"
#include "camera/recorded_camera.h"

#include <filesystem>
#include <memory>

namespace onestroke {

/// The JPEG and PNG pictures of a folder, in the natural order of their names, 30 a second. All must have one size; a
/// picture that cannot be read ends the camera with a message. Throws Error where the folder is missing or has none.
std::unique_ptr<RecordedCamera> open_folder(const std::filesystem::path& folder, const LensSource& lens,
                                            Duration readout);

}  // namespace onestroke

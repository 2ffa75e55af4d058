#pragma once

#include "camera/capture.h"
#include "camera/format_choice.h"

#include <memory>
#include <string>
#include <vector>

namespace onestroke {

/// The camera of that id or model; a part of one will do where no other has it, and no name at all where there is one
/// camera, or for the first of several. Throws Error where libcamera cannot be started.
std::unique_ptr<CaptureSource> make_libcamera_source(const std::string& name, const LiveOptions& options);

/// A camera that is connected.
struct CameraListing {
  std::string id{}, model{};
  std::vector<OfferedFormat> formats{};
  std::vector<std::string> controls{};
  std::string unusable{};  ///< Why none of its formats will do; empty where one does.
  FormatChoice usual{};    ///< What it is asked for where nobody wishes for anything else.
};

/// All of them. Throws Error where libcamera cannot be started.
std::vector<CameraListing> list_cameras();
std::string libcamera_version();
/// A device of a camera that this user may not open; empty where there is none.
std::string forbidden_camera();
/// How often the bytes of a picture are written between the device and the tracker, and once more for the GPU.
std::string copies_words(CaptureCoding coding);

}  // namespace onestroke

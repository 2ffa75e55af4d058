#pragma once

#include "core/frame_record.h"
#include "core/picture.h"

#include <string>

namespace onestroke {

/// What a picture is called in files: what its camera calls it, otherwise its number.
std::string picture_name(const Picture& picture);

/// What was found in a picture, as one line of JSON without the line's end. Numbers read back exactly; what is no
/// number is null, and bytes of a name that are no UTF-8 are replaced.
std::string pose_line(const Picture& picture, const FrameRecord& record);

}  // namespace onestroke

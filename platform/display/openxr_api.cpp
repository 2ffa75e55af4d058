#include "display/openxr_api.h"

#include <openxr/openxr_reflection.h>

namespace onestroke {

std::string name_of(XrResult result) {
  switch (result) {
#define ONESTROKE_NAME(name, value) \
  case name:                        \
    return #name;
    XR_LIST_ENUM_XrResult(ONESTROKE_NAME)
#undef ONESTROKE_NAME
  }
  return "XrResult " + std::to_string(static_cast<int>(result));
}

OpenXrError::OpenXrError(XrResult result, const std::string& doing)
    : Error(doing + " (" + name_of(result) + ")"), result_(result) {}

bool OpenXrError::lost() const {
  return result_ == XR_ERROR_SESSION_LOST || result_ == XR_ERROR_INSTANCE_LOST;
}

XrResult check(XrResult result, const char* doing) {
  if (XR_FAILED(result)) throw OpenXrError(result, doing);
  return result;
}

}  // namespace onestroke

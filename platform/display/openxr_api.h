#pragma once

#include "core/error.h"

#include <vulkan/vulkan_core.h>

#include <ctime>
#include <memory>

// Every file that speaks OpenXR includes this one, so that all see it configured alike.
#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace onestroke {

/// What a call to OpenXR failed with. The message says what was being done.
class OpenXrError : public Error {
 public:
  OpenXrError(XrResult result, const std::string& doing);
  XrResult result() const { return result_; }
  /// True where the session or the whole runtime is gone, and nothing but making them anew helps.
  bool lost() const;

 private:
  XrResult result_;
};

/// "XR_ERROR_FORM_FACTOR_UNAVAILABLE", or the number where it has no name.
std::string name_of(XrResult result);

/// Throws OpenXrError where the call failed; gives the result back, since some successes differ.
XrResult check(XrResult result, const char* doing);

/// A structure of OpenXR's, empty but for its type.
template <typename Structure>
Structure typed(XrStructureType type) {
  Structure made{};
  made.type = type;
  return made;
}

/// Owns a handle, which `destroy` ends.
template <typename Handle, XrResult (*destroy)(Handle)>
class OpenXrOwned {
 public:
  OpenXrOwned() = default;
  explicit OpenXrOwned(Handle handle) : handle_(handle) {}
  OpenXrOwned(const OpenXrOwned&) = delete;
  OpenXrOwned& operator=(const OpenXrOwned&) = delete;
  ~OpenXrOwned() {
    if (handle_ != XR_NULL_HANDLE) destroy(handle_);
  }
  Handle operator*() const { return handle_; }

 private:
  Handle handle_ = XR_NULL_HANDLE;
};

}  // namespace onestroke

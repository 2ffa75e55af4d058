#pragma once

#include "display/openxr_api.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onestroke {

/// What a runtime must have.
std::span<const char* const> needed_openxr_extensions();
/// What the active runtime has. Throws OpenXrError where there is none.
std::vector<std::string> offered_openxr_extensions();
/// Throws OpenXrError where the runtime does not answer. A loader may allow one at a time.
XrInstance create_openxr_instance(std::span<const char* const> extensions);
/// Throws OpenXrError where there is none; `runtime` is for its message.
XrSystemId find_openxr_headset(XrInstance instance, const std::string& runtime);

/// The program's connection to the OpenXR runtime, and the headset that it has.
class OpenXrInstance {
 public:
  /// Throws Error where there is no runtime, no headset, or a runtime that cannot do what is needed.
  OpenXrInstance();

  XrInstance handle() const { return *instance_; }
  XrSystemId headset() const { return headset_; }
  /// "Monado(XRT) by Collabora et al '25.0.0' 25.0.0".
  const std::string& runtime_name() const { return runtime_name_; }
  std::string headset_name() const;

  /// True of an extension that is used where the runtime offers it, and does.
  bool has(std::string_view extension) const;

  /// The runtime's next word, false where it has none. Throws OpenXrError.
  bool next_event(XrEventDataBuffer& event) const;

  /// A function of an extension. Throws OpenXrError where the runtime lacks it.
  template <typename Function>
  Function function(const char* name) const {
    PFN_xrVoidFunction found = nullptr;
    check(xrGetInstanceProcAddr(*instance_, name, &found), name);
    return reinterpret_cast<Function>(found);
  }

 private:
  std::vector<const char*> extensions_;  // in use
  OpenXrOwned<XrInstance, xrDestroyInstance> instance_;
  std::string runtime_name_;
  XrSystemId headset_;
};

}  // namespace onestroke

#pragma once

#include "display/openxr_instance.h"

namespace onestroke {

/// The pictures of the headset's own cameras as the runtime lays them, under what is drawn (XR_FB_passthrough).
class OpenXrPassthrough {
 public:
  /// Throws OpenXrError.
  static bool offered(const OpenXrInstance& instance);

  /// Starts the cameras. Instance and session outlive this. Throws OpenXrError.
  OpenXrPassthrough(const OpenXrInstance& instance, XrSession session);
  OpenXrPassthrough(const OpenXrPassthrough&) = delete;
  OpenXrPassthrough& operator=(const OpenXrPassthrough&) = delete;
  ~OpenXrPassthrough();

  /// The lowest of a frame's layers.
  XrCompositionLayerPassthroughFB layer() const;

 private:
  PFN_xrDestroyPassthroughFB destroy_;
  PFN_xrDestroyPassthroughLayerFB destroy_layer_;
  XrPassthroughFB passthrough_ = XR_NULL_HANDLE;
  XrPassthroughLayerFB layer_ = XR_NULL_HANDLE;
};

}  // namespace onestroke

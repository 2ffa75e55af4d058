#include "display/openxr_passthrough.h"

namespace onestroke {

bool OpenXrPassthrough::offered(const OpenXrInstance& instance) {
  if (!instance.has(XR_FB_PASSTHROUGH_EXTENSION_NAME)) return false;
  auto passthrough = typed<XrSystemPassthroughPropertiesFB>(XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB);
  auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  properties.next = &passthrough;
  check(xrGetSystemProperties(instance.handle(), instance.headset(), &properties),
        "the headset does not say what it can do: update its runtime");
  return passthrough.supportsPassthrough == XR_TRUE;
}

OpenXrPassthrough::OpenXrPassthrough(const OpenXrInstance& instance, XrSession session)
    : destroy_(instance.function<PFN_xrDestroyPassthroughFB>("xrDestroyPassthroughFB")),
      destroy_layer_(instance.function<PFN_xrDestroyPassthroughLayerFB>("xrDestroyPassthroughLayerFB")) {
  constexpr const char* doing = "the headset's cameras do not start: use --world camera";
  auto info = typed<XrPassthroughCreateInfoFB>(XR_TYPE_PASSTHROUGH_CREATE_INFO_FB);
  info.flags = XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;
  check(instance.function<PFN_xrCreatePassthroughFB>("xrCreatePassthroughFB")(session, &info, &passthrough_), doing);
  auto layer = typed<XrPassthroughLayerCreateInfoFB>(XR_TYPE_PASSTHROUGH_LAYER_CREATE_INFO_FB);
  layer.passthrough = passthrough_;
  layer.flags = XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;
  layer.purpose = XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB;
  const XrResult made =
      instance.function<PFN_xrCreatePassthroughLayerFB>("xrCreatePassthroughLayerFB")(session, &layer, &layer_);
  if (XR_FAILED(made)) destroy_(passthrough_);
  check(made, doing);
}

OpenXrPassthrough::~OpenXrPassthrough() {
  destroy_layer_(layer_);
  destroy_(passthrough_);
}

XrCompositionLayerPassthroughFB OpenXrPassthrough::layer() const {
  auto layer = typed<XrCompositionLayerPassthroughFB>(XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB);
  layer.flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  layer.layerHandle = layer_;
  return layer;
}

}  // namespace onestroke

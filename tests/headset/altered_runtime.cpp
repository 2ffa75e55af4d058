// Monado, but for what its simulated headset cannot show: the world behind what is drawn (alpha, additive and
// XR_FB_passthrough, of which Monado itself hears nothing), a LOCAL space that is recentred, and a wish to end the
// program. Without STAGE where ALTERED_RUNTIME_LACKS is "stage".
#include "altered_runtime.h"

#include "runtime_parts.h"

#include <dlfcn.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

namespace {

using runtime_parts::find;
using runtime_parts::give;
using runtime_parts::named;
using runtime_parts::RuntimeRequest;

constexpr const char* passthrough_name = "XR_FB_passthrough";
constexpr XrDuration until_recentred = 100'000'000;

PFN_xrGetInstanceProcAddr monado = nullptr;
XrInstance instance = XR_NULL_HANDLE;
XrSession session = XR_NULL_HANDLE;
XrSpace local = XR_NULL_HANDLE;
AlteredFrame last_frame{};
int passthrough_objects = 0;
std::atomic<bool> recentring{false};
XrTime display_time = 0, recentred_at = std::numeric_limits<XrTime>::max();
// Of the new LOCAL in the one before.
const XrPosef moved{{0, std::sin(0.35F), 0, std::cos(0.35F)}, {0.3F, 0, 0.4F}};

/// Monado's own.
template <typename Function>
Function own(const char* name, XrInstance of = instance) {
  PFN_xrVoidFunction function = nullptr;
  monado(of, name, &function);
  return reinterpret_cast<Function>(function);
}

XrQuaternionf times(const XrQuaternionf& a, const XrQuaternionf& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
XrVector3f rotated(const XrQuaternionf& q, const XrVector3f& v) {
  const XrQuaternionf r = times(times(q, {v.x, v.y, v.z, 0}), {-q.x, -q.y, -q.z, q.w});
  return {r.x, r.y, r.z};
}
XrPosef times(const XrPosef& a, const XrPosef& b) {
  const XrVector3f p = rotated(a.orientation, b.position);
  return {times(a.orientation, b.orientation), {p.x + a.position.x, p.y + a.position.y, p.z + a.position.z}};
}
XrPosef inverse(const XrPosef& a) {
  const XrQuaternionf q{-a.orientation.x, -a.orientation.y, -a.orientation.z, a.orientation.w};
  return {q, rotated(q, {-a.position.x, -a.position.y, -a.position.z})};
}

XrResult enumerate_extensions(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                              XrExtensionProperties* out) {
  const auto ask = own<PFN_xrEnumerateInstanceExtensionProperties>("xrEnumerateInstanceExtensionProperties", nullptr);
  std::uint32_t n = 0;
  ask(layer, 0, &n, nullptr);
  std::vector<XrExtensionProperties> all(n, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 0});
  ask(layer, n, &n, all.data());
  all.push_back({XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 1});
  std::strcpy(all.back().extensionName, passthrough_name);
  return give(all, capacity, count, out);
}

XrResult create_instance(const XrInstanceCreateInfo* info, XrInstance* made) {
  std::vector<const char*> names;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i)
    if (std::string_view(info->enabledExtensionNames[i]) != passthrough_name)
      names.push_back(info->enabledExtensionNames[i]);
  XrInstanceCreateInfo known = *info;
  known.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
  known.enabledExtensionNames = names.data();
  const XrResult result = own<PFN_xrCreateInstance>("xrCreateInstance", nullptr)(&known, made);
  instance = *made;
  return result;
}

XrResult get_system_properties(XrInstance of, XrSystemId system, XrSystemProperties* out) {
  auto* passthrough = static_cast<XrSystemPassthroughPropertiesFB*>(out->next);
  if (passthrough && passthrough->type == XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB)
    passthrough->supportsPassthrough = XR_TRUE;
  out->next = nullptr;
  const XrResult result = own<PFN_xrGetSystemProperties>("xrGetSystemProperties")(of, system, out);
  out->next = passthrough;
  return result;
}

XrResult enumerate_blend_modes(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t capacity,
                               std::uint32_t* count, XrEnvironmentBlendMode* out) {
  return give(std::array{XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE,
                         XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND},
              capacity, count, out);
}

XrResult create_passthrough(XrSession, const XrPassthroughCreateInfoFB*, XrPassthroughFB* made) {
  ++passthrough_objects;
  *made = reinterpret_cast<XrPassthroughFB>(&passthrough_objects);
  return XR_SUCCESS;
}
XrResult destroy_passthrough(XrPassthroughFB) {
  return --passthrough_objects, XR_SUCCESS;
}
XrResult create_passthrough_layer(XrSession, const XrPassthroughLayerCreateInfoFB*, XrPassthroughLayerFB* made) {
  ++passthrough_objects;
  *made = reinterpret_cast<XrPassthroughLayerFB>(&last_frame);
  return XR_SUCCESS;
}
XrResult destroy_passthrough_layer(XrPassthroughLayerFB) {
  return --passthrough_objects, XR_SUCCESS;
}

void look_for_depth(const XrCompositionLayerProjection& layer) {
  for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
    const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(layer.views[i].next);
    if (!depth || depth->type != XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) continue;
    ++last_frame.views_with_depth;
    last_frame.near_z = depth->nearZ;
    last_frame.far_z = depth->farZ;
  }
}

XrResult end_frame(XrSession session, const XrFrameEndInfo* info) {
  XrFrameEndInfo known = *info;
  known.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (info->layerCount > 0) last_frame = {info->environmentBlendMode, info->layerCount, XR_FALSE, 0, 0, 0, 0};
  for (std::uint32_t i = 0; i < info->layerCount; ++i) {
    const XrCompositionLayerBaseHeader* layer = info->layers[i];
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB) {
      last_frame.passthrough_first = i == 0;
      continue;
    }
    last_frame.projection_flags = layer->layerFlags;
    look_for_depth(*reinterpret_cast<const XrCompositionLayerProjection*>(layer));
    layers.push_back(layer);
  }
  known.layerCount = static_cast<std::uint32_t>(layers.size());
  known.layers = layers.data();
  return own<PFN_xrEndFrame>("xrEndFrame")(session, &known);
}

XrResult wait_frame(XrSession session, const XrFrameWaitInfo* info, XrFrameState* state) {
  const XrResult result = own<PFN_xrWaitFrame>("xrWaitFrame")(session, info, state);
  display_time = state->predictedDisplayTime;
  return result;
}

XrResult poll_event(XrInstance of, XrEventDataBuffer* out) {
  if (!recentring.exchange(false)) return own<PFN_xrPollEvent>("xrPollEvent")(of, out);
  recentred_at = display_time + until_recentred;
  XrEventDataReferenceSpaceChangePending event{};
  event.type = XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING;
  event.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
  event.changeTime = recentred_at;
  event.poseValid = XR_TRUE;
  event.poseInPreviousSpace = moved;
  std::memcpy(out, &event, sizeof event);
  return XR_SUCCESS;
}

XrResult enumerate_spaces(XrSession session, std::uint32_t capacity, std::uint32_t* count, XrReferenceSpaceType* out) {
  const auto ask = own<PFN_xrEnumerateReferenceSpaces>("xrEnumerateReferenceSpaces");
  std::uint32_t n = 0;
  ask(session, 0, &n, nullptr);
  std::vector<XrReferenceSpaceType> all(n);
  ask(session, n, &n, all.data());
  const char* lacks = std::getenv("ALTERED_RUNTIME_LACKS");
  if (lacks && std::string_view(lacks) == "stage") std::erase(all, XR_REFERENCE_SPACE_TYPE_STAGE);
  return give(all, capacity, count, out);
}

XrResult create_space(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* made) {
  const XrResult result = own<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session, info, made);
  if (info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL) local = *made;
  return result;
}

XrResult locate_views(XrSession session, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t capacity,
                      std::uint32_t* count, XrView* out) {
  const XrResult result = own<PFN_xrLocateViews>("xrLocateViews")(session, info, state, capacity, count, out);
  if (info->space == local && info->displayTime >= recentred_at)
    for (std::uint32_t i = 0; i < *count; ++i) out[i].pose = times(inverse(moved), out[i].pose);
  return result;
}

XrResult create_session(XrInstance of, const XrSessionCreateInfo* info, XrSession* made) {
  const XrResult result = own<PFN_xrCreateSession>("xrCreateSession")(of, info, made);
  session = *made;
  return result;
}

XrResult locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* out) {
  const XrResult result = own<PFN_xrLocateSpace>("xrLocateSpace")(space, base, time, out);
  if (time < recentred_at) return result;
  if (base == local) out->pose = times(inverse(moved), out->pose);
  if (space == local) out->pose = times(out->pose, moved);
  return result;
}

XrResult get_function(XrInstance of, const char* name, PFN_xrVoidFunction* function) {
  static const std::array altered{named("xrGetInstanceProcAddr", get_function),
                                  named("xrEnumerateInstanceExtensionProperties", enumerate_extensions),
                                  named("xrCreateInstance", create_instance),
                                  named("xrGetSystemProperties", get_system_properties),
                                  named("xrEnumerateEnvironmentBlendModes", enumerate_blend_modes),
                                  named("xrCreatePassthroughFB", create_passthrough),
                                  named("xrDestroyPassthroughFB", destroy_passthrough),
                                  named("xrCreatePassthroughLayerFB", create_passthrough_layer),
                                  named("xrDestroyPassthroughLayerFB", destroy_passthrough_layer),
                                  named("xrCreateSession", create_session),
                                  named("xrEndFrame", end_frame),
                                  named("xrWaitFrame", wait_frame),
                                  named("xrPollEvent", poll_event),
                                  named("xrEnumerateReferenceSpaces", enumerate_spaces),
                                  named("xrCreateReferenceSpace", create_space),
                                  named("xrLocateViews", locate_views),
                                  named("xrLocateSpace", locate_space)};
  if (PFN_xrVoidFunction found = find(altered, name)) return *function = found, XR_SUCCESS;
  return monado(of, name, function);
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) AlteredFrame altered_runtime_last_frame() {
  return last_frame;
}
__attribute__((visibility("default"))) int altered_runtime_passthrough_objects() {
  return passthrough_objects;
}
__attribute__((visibility("default"))) void altered_runtime_recentre() {
  recentring = true;
}

// Monado leads the session through its last states then, as it does where the program itself asks.
__attribute__((visibility("default"))) void altered_runtime_ask_to_leave() {
  own<PFN_xrRequestExitSession>("xrRequestExitSession")(session);
}

__attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(const void* loader,
                                                                                  RuntimeRequest* request) {
  void* library = dlopen("libopenxr_monado.so", RTLD_NOW);
  if (!library) return XR_ERROR_INITIALIZATION_FAILED;
  const auto negotiate =
      reinterpret_cast<XrResult (*)(const void*, RuntimeRequest*)>(dlsym(library, "xrNegotiateLoaderRuntimeInterface"));
  const XrResult result = negotiate(loader, request);
  monado = request->get_function;
  request->get_function = get_function;
  return result;
}
}

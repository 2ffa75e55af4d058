// An OpenXR runtime that gets no further than its first answers, for what no real one can be made to say here.
// FAKE_RUNTIME_LACKS names what it does not have: "vulkan", "clock" or "headset".
#include <openxr/openxr.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

// How a loader and a runtime shake hands; from the specification of OpenXR's loader, 1.0.
constexpr std::uint32_t interface_version = 1, struct_version = 1, runtime_request = 3;
struct RuntimeRequest {
  std::uint32_t struct_type, struct_version;
  std::size_t struct_size;
  std::uint32_t interface_version;
  XrVersion api_version;
  PFN_xrGetInstanceProcAddr get_function;
};

bool lacks(std::string_view what) {
  const char* lacking = std::getenv("FAKE_RUNTIME_LACKS");
  return lacking && what == lacking;
}

XrResult enumerate_extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                              XrExtensionProperties* properties) {
  std::array<const char*, 2> names{};
  std::uint32_t found = 0;
  if (!lacks("vulkan")) names.at(found++) = "XR_KHR_vulkan_enable2";
  if (!lacks("clock")) names.at(found++) = "XR_KHR_convert_timespec_time";
  *count = found;
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < found) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::uint32_t i = 0; i < found; ++i) {
    std::strcpy(properties[i].extensionName, names.at(i));
    properties[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XrResult create_instance(const XrInstanceCreateInfo*, XrInstance* instance) {
  static int the_one = 0;
  *instance = reinterpret_cast<XrInstance>(&the_one);
  return XR_SUCCESS;
}

XrResult destroy_instance(XrInstance) {
  return XR_SUCCESS;
}

XrResult get_properties(XrInstance, XrInstanceProperties* properties) {
  properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  std::strcpy(properties->runtimeName, "a fake");
  return XR_SUCCESS;
}

XrResult get_system(XrInstance, const XrSystemGetInfo*, XrSystemId*) {
  return lacks("headset") ? XR_ERROR_FORM_FACTOR_UNAVAILABLE : XR_ERROR_RUNTIME_FAILURE;
}

XrResult get_function(XrInstance, const char* name, PFN_xrVoidFunction* function);

struct Function {
  std::string_view name;
  PFN_xrVoidFunction address;
};

template <typename F>
Function named(std::string_view name, F* function) {
  return {name, reinterpret_cast<PFN_xrVoidFunction>(function)};
}

XrResult get_function(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const std::array functions{named("xrGetInstanceProcAddr", get_function),
                                    named("xrEnumerateInstanceExtensionProperties", enumerate_extensions),
                                    named("xrCreateInstance", create_instance),
                                    named("xrDestroyInstance", destroy_instance),
                                    named("xrGetInstanceProperties", get_properties),
                                    named("xrGetSystem", get_system)};
  *function = nullptr;
  for (const Function& f : functions)
    if (f.name == name) *function = f.address;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(const void*,
                                                                                             RuntimeRequest* request) {
  if (request->struct_type != runtime_request || request->struct_version != struct_version)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->interface_version = interface_version;
  request->api_version = XR_MAKE_VERSION(1, 0, 0);
  request->get_function = get_function;
  return XR_SUCCESS;
}

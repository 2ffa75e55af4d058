#include "display/openxr_instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <vector>

namespace onestroke {

namespace {

constexpr std::array needed{XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME};
// Used where they are offered.
constexpr std::array welcome{XR_EXT_HAND_TRACKING_EXTENSION_NAME, XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                             XR_FB_PASSTHROUGH_EXTENSION_NAME, XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME};

}  // namespace

std::span<const char* const> needed_openxr_extensions() {
  return needed;
}

std::vector<std::string> offered_openxr_extensions() {
  std::uint32_t count = 0;
  const XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
  if (XR_FAILED(result))
    throw OpenXrError(result,
                      "there is no OpenXR runtime: install Monado or SteamVR and make it the active one, or name its "
                      "manifest in XR_RUNTIME_JSON; or use --display window");
  std::vector<XrExtensionProperties> properties(count, typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES));
  check(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, properties.data()),
        "the OpenXR runtime does not say what it can do: update it");
  std::vector<std::string> names;
  for (const auto& p : properties) names.emplace_back(p.extensionName);
  return names;
}

XrInstance create_openxr_instance(std::span<const char* const> extensions) {
  auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::strcpy(info.applicationInfo.applicationName, "onestroke");
  info.applicationInfo.applicationVersion = 1;
  // Loaders of 1.0 refuse any later version, and later ones know 1.0.
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.enabledExtensionNames = extensions.data();
  XrInstance instance = XR_NULL_HANDLE;
  check(xrCreateInstance(&info, &instance),
        "the OpenXR runtime does not answer: start its service (monado-service, or SteamVR), then try again");
  return instance;
}

XrSystemId find_openxr_headset(XrInstance instance, const std::string& runtime) {
  auto info = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
  info.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  const XrResult result = xrGetSystem(instance, &info, &system);
  if (XR_FAILED(result))
    throw OpenXrError(result, "the OpenXR runtime " + runtime +
                                  " finds no headset: plug it in, switch it on and start its service again");
  return system;
}

namespace {

std::vector<const char*> choose_extensions() {
  const std::vector<std::string> offered = offered_openxr_extensions();
  const auto is_offered = [&offered](const char* name) { return std::ranges::find(offered, name) != offered.end(); };
  for (const char* name : needed)
    if (!is_offered(name))
      throw Error(std::string("the OpenXR runtime lacks ") + name + ": update it, or make another one active");
  std::vector<const char*> chosen(needed.begin(), needed.end());
  std::ranges::copy_if(welcome, std::back_inserter(chosen), is_offered);
  return chosen;
}

std::string name_of_runtime(XrInstance instance) {
  auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
  check(xrGetInstanceProperties(instance, &properties), "the OpenXR runtime does not say its name: update it");
  return properties.runtimeName;
}

}  // namespace

OpenXrInstance::OpenXrInstance()
    : extensions_(choose_extensions()),
      instance_(create_openxr_instance(extensions_)),
      runtime_name_(name_of_runtime(*instance_)),
      headset_(find_openxr_headset(*instance_, runtime_name_)) {}

std::string OpenXrInstance::headset_name() const {
  auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  check(xrGetSystemProperties(*instance_, headset_, &properties), "the headset does not say its name");
  return properties.systemName;
}

bool OpenXrInstance::has(std::string_view extension) const {
  return std::ranges::find(extensions_, extension) != extensions_.end();
}

bool OpenXrInstance::next_event(XrEventDataBuffer& event) const {
  event.type = XR_TYPE_EVENT_DATA_BUFFER;
  event.next = nullptr;
  return check(xrPollEvent(*instance_, &event), "the OpenXR runtime tells nothing any more") == XR_SUCCESS;
}

}  // namespace onestroke

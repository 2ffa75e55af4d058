#include "display/headset_survey.h"

#include "display/openxr_instance.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace onestroke {

namespace {

namespace fs = std::filesystem;

struct Optional {
  const char* name;
  const char* lost;
};

constexpr std::array optional{
    Optional{XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
             "pictures that come late are moved as if all were far away"},
    Optional{XR_FB_PASSTHROUGH_EXTENSION_NAME, "the headset's own cameras cannot show the world"},
    Optional{XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME, "missed frames are counted by the shortest period seen"},
    Optional{XR_EXT_HAND_TRACKING_EXTENSION_NAME, "bare hands do nothing but hold the sticks"},
    Optional{XR_EXT_DEBUG_UTILS_EXTENSION_NAME, "the runtime's own warnings stay in its log"}};

/// The library that the loader's functions come from.
std::string find_loader() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&xrEnumerateInstanceExtensionProperties), &info) == 0 || !info.dli_fname)
    return "built in";
  std::error_code unknown;
  const fs::path file = fs::canonical(info.dli_fname, unknown);
  return unknown ? info.dli_fname : file.string();
}

std::vector<fs::path> folders_of(const char* variable, const char* otherwise) {
  const char* value = std::getenv(variable);
  std::istringstream list(value && *value ? value : otherwise);
  std::vector<fs::path> folders;
  for (std::string folder; std::getline(list, folder, ':');) folders.emplace_back(folder);
  return folders;
}

// As the loader looks for it (OpenXR loader design, "Active runtime file location").
std::string find_manifest() {
  if (const char* named = std::getenv("XR_RUNTIME_JSON"); named && *named) return named;
  const char* home = std::getenv("HOME");
  std::vector<fs::path> folders = folders_of("XDG_CONFIG_HOME", home ? (std::string(home) + "/.config").c_str() : "");
  for (const fs::path& folder : folders_of("XDG_CONFIG_DIRS", "/etc/xdg")) folders.push_back(folder);
  folders.emplace_back("/etc");
  for (const fs::path& folder : folders)
    for (const char* name : {"active_runtime.x86_64.json", "active_runtime.aarch64.json", "active_runtime.json"}) {
      const fs::path file = folder / "openxr/1" / name;
      std::error_code unknown;
      if (fs::exists(file, unknown)) return file.string();
    }
  return {};
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const char* word_of(XrEnvironmentBlendMode mode) {
  switch (mode) {
    case XR_ENVIRONMENT_BLEND_MODE_OPAQUE:
      return "opaque";
    case XR_ENVIRONMENT_BLEND_MODE_ADDITIVE:
      return "additive";
    case XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND:
      return "alpha blend";
    default:
      return "another way";
  }
}

/// Stays as it is where the headset shows no pair of views.
void look_at_views(XrInstance instance, XrSystemId system, HeadsetSurvey::Headset& headset) {
  constexpr auto pair = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  std::array<XrViewConfigurationView, 2> views;
  views.fill(typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
  std::uint32_t count = 0;
  if (XR_FAILED(xrEnumerateViewConfigurationViews(instance, system, pair, 2, &count, views.data()))) return;
  headset.width = static_cast<int>(views[0].recommendedImageRectWidth);
  headset.height = static_cast<int>(views[0].recommendedImageRectHeight);
  std::array<XrEnvironmentBlendMode, 8> modes{};
  if (XR_FAILED(xrEnumerateEnvironmentBlendModes(instance, system, pair, static_cast<std::uint32_t>(modes.size()),
                                                 &count, modes.data())))
    return;
  for (std::uint32_t i = 0; i < count; ++i) headset.blend_modes.emplace_back(word_of(modes.at(i)));
}

HeadsetSurvey::Headset look_at(XrInstance instance, XrSystemId system, bool hands_offered) {
  auto hands = typed<XrSystemHandTrackingPropertiesEXT>(XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT);
  auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  if (hands_offered) properties.next = &hands;
  check(xrGetSystemProperties(instance, system, &properties),
        "the headset does not say what it is: update its runtime");
  HeadsetSurvey::Headset found{.name = properties.systemName,
                               .orientation = properties.trackingProperties.orientationTracking == XR_TRUE,
                               .position = properties.trackingProperties.positionTracking == XR_TRUE,
                               .hands = hands_offered && hands.supportsHandTracking == XR_TRUE};
  look_at_views(instance, system, found);
  return found;
}

void survey_runtime(HeadsetSurvey& found) {
  const std::vector<std::string> offered = offered_openxr_extensions();
  std::vector<const char*> wanted;
  for (const char* name : needed_openxr_extensions()) {
    found.extensions.push_back({.name = name, .needed = true, .offered = has(offered, name)});
    if (found.extensions.back().offered) wanted.push_back(name);
  }
  for (const Optional& extra : optional)
    found.extensions.push_back({.name = extra.name, .offered = has(offered, extra.name), .lost = extra.lost});
  const bool hands_offered = has(offered, XR_EXT_HAND_TRACKING_EXTENSION_NAME);
  if (hands_offered) wanted.push_back(XR_EXT_HAND_TRACKING_EXTENSION_NAME);
  const OpenXrOwned<XrInstance, xrDestroyInstance> instance(create_openxr_instance(wanted));
  auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
  check(xrGetInstanceProperties(*instance, &properties), "the OpenXR runtime does not say its name: update it");
  const XrVersion version = properties.runtimeVersion;
  found.runtime = std::string(properties.runtimeName) + ", version " + std::to_string(XR_VERSION_MAJOR(version)) + "." +
                  std::to_string(XR_VERSION_MINOR(version)) + "." + std::to_string(XR_VERSION_PATCH(version));
  found.headset = look_at(*instance, find_openxr_headset(*instance, properties.runtimeName), hands_offered);
}

}  // namespace

HeadsetSurvey survey_headset() {
  HeadsetSurvey found{.loader = find_loader(), .manifest = find_manifest()};
  try {
    survey_runtime(found);
  } catch (const Error& error) {
    found.failure = error.what();
  }
  return found;
}

}  // namespace onestroke

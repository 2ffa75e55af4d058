// An OpenXR runtime for what no real one can be made to do here. It shows nothing, but minds that the program keeps to
// OpenXR's rules.
//
// FAKE_RUNTIME_LACKS names what it does not have: "vulkan", "clock" or "headset".
// FAKE_RUNTIME_DOES is what happens and at which frame, as in "unseen@10 exit@30":
//   exit           the runtime ends the session, and wants no other
//   put_down       the session is stopped, and may begin again a little later
//   unseen         ten frames are not to be rendered
//   late           ten frames are to be seen before they were asked for
//   session_loss   the session is about to be lost
//   instance_loss  the runtime is about to go, and is away for a while
//   lost           the runtime is gone, without a word before, and is away for a while
//   wait_error     waiting for a frame fails
// Always, as on real ones: the first period is 16 ms, and the first frame is to be seen before it was asked for.
#include "fake_runtime.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace fake_runtime {
namespace {

using runtime_parts::RuntimeRequest;

constexpr std::uint32_t interface_version = 1, struct_version = 1, runtime_request = 3;

constexpr int tries_away = 2;

struct Happening {
  std::string what;
  int frame = 0;
};

struct State {
  int violations = 0, away = 0;
  bool instance = false;
  std::optional<std::vector<Happening>> script;
  std::deque<XrEventDataBuffer> events;
};
State state;
// A program may ask for times and places on any thread.
std::atomic<bool> lost = false;

bool lacks(std::string_view what) {
  const char* lacking = std::getenv("FAKE_RUNTIME_LACKS");
  return lacking && what == lacking;
}

void read_script() {
  const char* text = std::getenv("FAKE_RUNTIME_DOES");
  std::istringstream words(text ? text : "");
  state.script.emplace();
  for (std::string word; words >> word;) {
    const std::size_t at = word.find('@');
    state.script->push_back({word.substr(0, at), std::atoi(word.c_str() + at + 1)});
  }
}

XrResult enumerate_extensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                              XrExtensionProperties* properties) {
  std::vector<XrExtensionProperties> offered;
  const auto add = [&](const char* name) {
    XrExtensionProperties& p = offered.emplace_back(XrExtensionProperties{
        .type = XR_TYPE_EXTENSION_PROPERTIES, .next = nullptr, .extensionName = {}, .extensionVersion = 1});
    std::strcpy(p.extensionName, name);
  };
  if (!lacks("vulkan")) add(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
  if (!lacks("clock")) add(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
  return give(offered, capacity, count, properties);
}

XrResult create_instance(const XrInstanceCreateInfo*, XrInstance* instance) {
  if (state.away > 0) {
    --state.away;
    return XR_ERROR_RUNTIME_FAILURE;
  }
  if (state.instance) return violation("a second instance", XR_ERROR_LIMIT_REACHED);
  static int the_one = 0;
  *instance = reinterpret_cast<XrInstance>(&the_one);
  if (!state.script) read_script();
  state.instance = true;
  lost = false;
  state.events.clear();
  return XR_SUCCESS;
}

XrResult destroy_instance(XrInstance) {
  state.instance = false;
  return XR_SUCCESS;
}

XrResult get_properties(XrInstance, XrInstanceProperties* properties) {
  properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  std::strcpy(properties->runtimeName, "a fake");
  return XR_SUCCESS;
}

XrResult get_system(XrInstance, const XrSystemGetInfo*, XrSystemId* system) {
  *system = 1;
  return lacks("headset") ? XR_ERROR_FORM_FACTOR_UNAVAILABLE : XR_SUCCESS;
}

XrResult get_system_properties(XrInstance, XrSystemId, XrSystemProperties* properties) {
  std::strcpy(properties->systemName, "a fake headset");
  return XR_SUCCESS;
}

XrResult poll_event(XrInstance, XrEventDataBuffer* event) {
  if (lost) return XR_ERROR_INSTANCE_LOST;
  poll_session();
  if (state.events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = state.events.front();
  state.events.pop_front();
  return XR_SUCCESS;
}

XrResult to_time(XrInstance, const timespec* from, XrTime* to) {
  *to = std::int64_t{from->tv_sec} * 1'000'000'000 + from->tv_nsec + clock_zero;
  return lost ? XR_ERROR_INSTANCE_LOST : XR_SUCCESS;
}

XrResult to_timespec(XrInstance, XrTime from, timespec* to) {
  to->tv_sec = (from - clock_zero) / 1'000'000'000;
  to->tv_nsec = (from - clock_zero) % 1'000'000'000;
  return lost ? XR_ERROR_INSTANCE_LOST : XR_SUCCESS;
}

XrResult get_function(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const std::array functions{named("xrGetInstanceProcAddr", get_function),
                                    named("xrEnumerateInstanceExtensionProperties", enumerate_extensions),
                                    named("xrCreateInstance", create_instance),
                                    named("xrDestroyInstance", destroy_instance),
                                    named("xrGetInstanceProperties", get_properties),
                                    named("xrGetSystem", get_system),
                                    named("xrGetSystemProperties", get_system_properties),
                                    named("xrPollEvent", poll_event),
                                    named("xrConvertTimespecTimeToTimeKHR", to_time),
                                    named("xrConvertTimeToTimespecTimeKHR", to_timespec)};
  *function = find(functions, name);
  if (!*function) *function = session_function(name);
  if (!*function) *function = graphics_function(name);
  if (!*function) *function = action_function(name);
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

XrResult violation(const char* what, XrResult answer) {
  ++state.violations;
  std::fprintf(stderr, "fake runtime: %s\n", what);
  return answer;
}

bool due(std::string_view what, int frame) {
  for (Happening& happening : *state.script) {
    if (happening.what != what || frame < happening.frame) continue;
    happening.what.clear();
    return true;
  }
  return false;
}

void push_event(const XrEventDataBuffer& event) {
  state.events.push_back(event);
}

void lose_instance() {
  lost = true;
  stay_away();
}

bool instance_lost() {
  return lost;
}

void stay_away() {
  state.away = tries_away;
}

}  // namespace fake_runtime

using namespace fake_runtime;

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(const void*,
                                                                                             RuntimeRequest* request) {
  if (request->struct_type != runtime_request || request->struct_version != struct_version)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->interface_version = interface_version;
  request->api_version = XR_MAKE_VERSION(1, 0, 0);
  request->get_function = get_function;
  return XR_SUCCESS;
}

// For a test that opens this library as well: begins its play anew, by the script as it is at the next instance.
extern "C" __attribute__((visibility("default"))) void fake_runtime_begin() {
  state = {};
  lost = false;
  reset_session();
  reset_graphics();
}
// How often the program has broken a rule since then.
extern "C" __attribute__((visibility("default"))) int fake_runtime_violations() {
  return state.violations;
}

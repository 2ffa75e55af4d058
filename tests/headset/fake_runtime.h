// What the parts of the fake OpenXR runtime have in common. It stands in for one headset, to one program at a time.
#pragma once

#include <vulkan/vulkan_core.h>

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include "runtime_parts.h"

#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <string_view>

namespace fake_runtime {

using runtime_parts::find;
using runtime_parts::give;
using runtime_parts::named;

/// XrTime is not CLOCK_MONOTONIC.
constexpr XrTime clock_zero = 1'000'000'000'000;

/// Says on standard error what no program may do to a runtime, counts it, and gives back what a runtime would answer.
XrResult violation(const char* what, XrResult answer);

/// Whether the script has this to happen by a certain frame, which is counted over all sessions; once for each time
/// that the script names it.
bool due(std::string_view what, int frame);

/// Each part as it is before any program comes.
void reset_session();
void reset_graphics();

/// The program asks for news: a headset that was put down is taken up again in the end.
void poll_session();
void push_event(const XrEventDataBuffer& event);
/// Nothing works any more until the instance is made anew.
void lose_instance();
/// On any thread.
bool instance_lost();
/// The next few tries to make an instance fail.
void stay_away();

/// Whether the program has asked what Vulkan the runtime wants.
bool requirements_asked();
/// What swapchain images are made with: the session's binding. Null once there is no session.
void use_graphics(const XrGraphicsBindingVulkan2KHR* binding);
/// Whether a layer may show this part of a swapchain: it was drawn, and is not being drawn now.
bool can_show(const XrSwapchainSubImage& part);

/// A function of that part of the runtime, null where it has none of that name.
PFN_xrVoidFunction session_function(std::string_view name);
PFN_xrVoidFunction graphics_function(std::string_view name);
PFN_xrVoidFunction action_function(std::string_view name);

}  // namespace fake_runtime

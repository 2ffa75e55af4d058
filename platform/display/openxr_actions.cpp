#include "display/openxr_actions.h"

#include <cstring>
#include <span>
#include <vector>

namespace onestroke {

namespace {

constexpr const char* doing = "the OpenXR runtime does not take the buttons that this program uses: update it";

enum Use { next, pick, menu };
constexpr std::array<Key, 3> keys{Key::tab, Key::enter, Key{'n'}};
constexpr std::array<const char*, 3> names{"next", "pick", "menu"};
constexpr std::array<const char*, 3> titles{"Go on in the menu", "Pick from the menu", "Open or close the menu"};

/// A button of a kind of controllers, and what it is for.
struct Binding {
  const char* profile;
  Use use;
  const char* path;
};

// Hands without a controller are not here: a hand that holds a stick always pinches. See PinchTap.
constexpr std::array bindings{
    Binding{"/interaction_profiles/khr/simple_controller", next, "/user/hand/left/input/select/click"},
    Binding{"/interaction_profiles/khr/simple_controller", pick, "/user/hand/right/input/select/click"},
    Binding{"/interaction_profiles/khr/simple_controller", menu, "/user/hand/left/input/menu/click"},
    Binding{"/interaction_profiles/khr/simple_controller", menu, "/user/hand/right/input/menu/click"},
    Binding{"/interaction_profiles/oculus/touch_controller", next, "/user/hand/left/input/trigger/value"},
    Binding{"/interaction_profiles/oculus/touch_controller", pick, "/user/hand/right/input/trigger/value"},
    Binding{"/interaction_profiles/oculus/touch_controller", menu, "/user/hand/left/input/menu/click"},
    Binding{"/interaction_profiles/oculus/touch_controller", menu, "/user/hand/right/input/b/click"},
    Binding{"/interaction_profiles/valve/index_controller", next, "/user/hand/left/input/trigger/click"},
    Binding{"/interaction_profiles/valve/index_controller", pick, "/user/hand/right/input/trigger/click"},
    Binding{"/interaction_profiles/valve/index_controller", menu, "/user/hand/left/input/b/click"},
    Binding{"/interaction_profiles/valve/index_controller", menu, "/user/hand/right/input/b/click"},
    Binding{"/interaction_profiles/htc/vive_controller", next, "/user/hand/left/input/trigger/click"},
    Binding{"/interaction_profiles/htc/vive_controller", pick, "/user/hand/right/input/trigger/click"},
    Binding{"/interaction_profiles/htc/vive_controller", menu, "/user/hand/left/input/menu/click"},
    Binding{"/interaction_profiles/htc/vive_controller", menu, "/user/hand/right/input/menu/click"},
    Binding{"/interaction_profiles/microsoft/motion_controller", next, "/user/hand/left/input/trigger/value"},
    Binding{"/interaction_profiles/microsoft/motion_controller", pick, "/user/hand/right/input/trigger/value"},
    Binding{"/interaction_profiles/microsoft/motion_controller", menu, "/user/hand/left/input/menu/click"},
    Binding{"/interaction_profiles/microsoft/motion_controller", menu, "/user/hand/right/input/menu/click"}};

XrActionSet make_set(XrInstance instance) {
  auto info = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  std::strcpy(info.actionSetName, "menu");
  std::strcpy(info.localizedActionSetName, "Menu");
  XrActionSet set = XR_NULL_HANDLE;
  check(xrCreateActionSet(instance, &info, &set), doing);
  return set;
}

XrAction make_action(XrActionSet set, Use use) {
  auto info = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
  std::strcpy(info.actionName, names.at(use));
  std::strcpy(info.localizedActionName, titles.at(use));
  info.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
  XrAction action = XR_NULL_HANDLE;
  check(xrCreateAction(set, &info, &action), doing);
  return action;
}

XrPath path_of(XrInstance instance, const char* words) {
  XrPath path = XR_NULL_PATH;
  check(xrStringToPath(instance, words, &path), doing);
  return path;
}

/// A kind of controllers that the runtime does not know is none that it has.
void suggest(XrInstance instance, std::span<const Binding> of_one_profile, const std::array<XrAction, 3>& actions) {
  std::vector<XrActionSuggestedBinding> suggested;
  for (const Binding& b : of_one_profile) suggested.push_back({actions.at(b.use), path_of(instance, b.path)});
  auto info = typed<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
  info.interactionProfile = path_of(instance, of_one_profile.front().profile);
  info.countSuggestedBindings = static_cast<std::uint32_t>(suggested.size());
  info.suggestedBindings = suggested.data();
  const XrResult result = xrSuggestInteractionProfileBindings(instance, &info);
  if (result != XR_ERROR_PATH_UNSUPPORTED) check(result, doing);
}

void suggest_all(XrInstance instance, const std::array<XrAction, 3>& actions) {
  for (std::size_t first = 0, end = 0; first < bindings.size(); first = end) {
    while (end < bindings.size() && std::strcmp(bindings.at(end).profile, bindings.at(first).profile) == 0) ++end;
    suggest(instance, std::span(bindings).subspan(first, end - first), actions);
  }
}

}  // namespace

OpenXrActions::OpenXrActions(const OpenXrInstance& instance, XrSession session)
    : session_(session), set_(make_set(instance.handle())) {
  const std::array actions{make_action(*set_, next), make_action(*set_, pick), make_action(*set_, menu)};
  for (std::size_t i = 0; i < buttons_.size(); ++i) buttons_.at(i) = {keys.at(i), actions.at(i)};
  suggest_all(instance.handle(), actions);
  auto info = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  const XrActionSet set = *set_;
  info.countActionSets = 1;
  info.actionSets = &set;
  check(xrAttachSessionActionSets(session, &info), doing);
}

bool OpenXrActions::sync() const {
  const XrActiveActionSet active{*set_, XR_NULL_PATH};
  auto info = typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
  info.countActiveActionSets = 1;
  info.activeActionSets = &active;
  return check(xrSyncActions(session_, &info), "the OpenXR runtime does not say which buttons are pressed") ==
         XR_SUCCESS;
}

bool OpenXrActions::pressed(const Button& button) const {
  auto info = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
  info.action = button.action;
  auto state = typed<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
  check(xrGetActionStateBoolean(session_, &info, &state),
        "the OpenXR runtime does not say whether a button is pressed");
  return state.isActive && state.changedSinceLastSync && state.currentState;
}

}  // namespace onestroke

// The fake OpenXR runtime's controllers: there are none, but a program may ask.
#include "fake_runtime.h"

#include <array>

namespace fake_runtime {

namespace {

bool attached = false;

template <typename Handle>
Handle some_handle() {
  return reinterpret_cast<Handle>(std::uintptr_t{1});
}

XrResult string_to_path(XrInstance, const char*, XrPath* path) {
  *path = 1;
  return XR_SUCCESS;
}

XrResult create_action_set(XrInstance, const XrActionSetCreateInfo*, XrActionSet* set) {
  *set = some_handle<XrActionSet>();
  return XR_SUCCESS;
}

XrResult destroy_action_set(XrActionSet) {
  attached = false;
  return XR_SUCCESS;
}

XrResult create_action(XrActionSet, const XrActionCreateInfo*, XrAction* action) {
  if (attached) return violation("an action was made for a set that is attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  *action = some_handle<XrAction>();
  return XR_SUCCESS;
}

XrResult suggest_bindings(XrInstance, const XrInteractionProfileSuggestedBinding*) {
  if (attached)
    return violation("bindings were suggested for a set that is attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  return XR_SUCCESS;
}

XrResult attach_action_sets(XrSession, const XrSessionActionSetsAttachInfo*) {
  if (attached) return violation("action sets were attached twice", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  attached = true;
  return XR_SUCCESS;
}

XrResult sync_actions(XrSession, const XrActionsSyncInfo*) {
  if (!attached) return violation("actions were asked for that are not attached", XR_ERROR_ACTIONSET_NOT_ATTACHED);
  return instance_lost() ? XR_ERROR_INSTANCE_LOST : XR_SESSION_NOT_FOCUSED;
}

XrResult boolean_state(XrSession, const XrActionStateGetInfo*, XrActionStateBoolean* state) {
  state->currentState = state->changedSinceLastSync = state->isActive = XR_FALSE;
  state->lastChangeTime = 0;
  return XR_SUCCESS;
}

}  // namespace

PFN_xrVoidFunction action_function(std::string_view name) {
  static const std::array functions{named("xrStringToPath", string_to_path),
                                    named("xrCreateActionSet", create_action_set),
                                    named("xrDestroyActionSet", destroy_action_set),
                                    named("xrCreateAction", create_action),
                                    named("xrSuggestInteractionProfileBindings", suggest_bindings),
                                    named("xrAttachSessionActionSets", attach_action_sets),
                                    named("xrSyncActions", sync_actions),
                                    named("xrGetActionStateBoolean", boolean_state)};
  return find(functions, name);
}

}  // namespace fake_runtime

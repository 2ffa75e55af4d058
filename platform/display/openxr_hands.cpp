#include "display/openxr_hands.h"

#include <cmath>

namespace onestroke {

namespace {

constexpr std::array forefinger_keys{Key::tab, Key::enter};
constexpr Key middle_finger_key{'n'};

bool tracks_hands(const OpenXrInstance& instance) {
  if (!instance.has(XR_EXT_HAND_TRACKING_EXTENSION_NAME)) return false;
  auto hands = typed<XrSystemHandTrackingPropertiesEXT>(XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT);
  auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  properties.next = &hands;
  check(xrGetSystemProperties(instance.handle(), instance.headset(), &properties),
        "the headset does not say whether it tracks hands");
  return hands.supportsHandTracking;
}

XrHandTrackerEXT make_tracker(PFN_xrCreateHandTrackerEXT create, XrSession session, XrHandEXT hand) {
  auto info = typed<XrHandTrackerCreateInfoEXT>(XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
  info.hand = hand;
  info.handJointSet = XR_HAND_JOINT_SET_DEFAULT_EXT;
  XrHandTrackerEXT tracker = XR_NULL_HANDLE;
  check(create(session, &info, &tracker), "the OpenXR runtime does not track hands, though it says that it does");
  return tracker;
}

double distance_mm(const XrVector3f& a, const XrVector3f& b) {
  return 1000 * std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
}

}  // namespace

OpenXrHands::OpenXrHands(const OpenXrInstance& instance, XrSession session) {
  if (!tracks_hands(instance)) return;
  locate_ = instance.function<PFN_xrLocateHandJointsEXT>("xrLocateHandJointsEXT");
  destroy_ = instance.function<PFN_xrDestroyHandTrackerEXT>("xrDestroyHandTrackerEXT");
  const auto create = instance.function<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT");
  trackers_[0] = make_tracker(create, session, XR_HAND_LEFT_EXT);
  trackers_[1] = make_tracker(create, session, XR_HAND_RIGHT_EXT);
}

OpenXrHands::~OpenXrHands() {
  for (const XrHandTrackerEXT tracker : trackers_)
    if (tracker != XR_NULL_HANDLE) destroy_(tracker);
}

Key OpenXrHands::tapped(std::size_t hand, XrSpace space, XrTime time, Time now) {
  if (trackers_.at(hand) == XR_NULL_HANDLE) return Key::none;
  switch (taps_.at(hand).update(look(hand, space, time), now)) {
    case HandTaps::Tap::forefinger:
      return forefinger_keys.at(hand);
    case HandTaps::Tap::middle_finger:
      return middle_finger_key;
    case HandTaps::Tap::none:
      break;
  }
  return Key::none;
}

std::optional<HandPinch> OpenXrHands::look(std::size_t hand, XrSpace space, XrTime time) const {
  std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
  auto found = typed<XrHandJointLocationsEXT>(XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
  found.jointCount = static_cast<std::uint32_t>(joints.size());
  found.jointLocations = joints.data();
  auto info = typed<XrHandJointsLocateInfoEXT>(XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
  info.baseSpace = space;
  info.time = time;
  check(locate_(trackers_.at(hand), &info, &found), "the OpenXR runtime does not say where the hands are");
  const auto& thumb = joints[XR_HAND_JOINT_THUMB_TIP_EXT];
  const auto& forefinger = joints[XR_HAND_JOINT_INDEX_TIP_EXT];
  const auto& middle_finger = joints[XR_HAND_JOINT_MIDDLE_TIP_EXT];
  const XrSpaceLocationFlags known = thumb.locationFlags & forefinger.locationFlags & middle_finger.locationFlags;
  if (!found.isActive || !(known & XR_SPACE_LOCATION_POSITION_VALID_BIT)) return std::nullopt;
  return HandPinch{distance_mm(thumb.pose.position, forefinger.pose.position),
                   distance_mm(thumb.pose.position, middle_finger.pose.position)};
}

}  // namespace onestroke

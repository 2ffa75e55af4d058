#include "camera/v4l2_controls.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

class Node {
 public:
  explicit Node(const std::filesystem::path& device)
      : descriptor_(device.empty() ? -1 : ::open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}
  ~Node() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  bool set(std::uint32_t id, int value) const {
    v4l2_control control{id, value};
    return descriptor_ >= 0 && ::ioctl(descriptor_, VIDIOC_S_CTRL, &control) == 0;
  }
  /// The nearest value that it has; false where it lacks the control.
  bool clamp(std::uint32_t id, int& value) const {
    v4l2_queryctrl about{};
    about.id = id;
    if (descriptor_ < 0 || ::ioctl(descriptor_, VIDIOC_QUERYCTRL, &about) != 0) return false;
    const int step = std::max(1, about.step);
    value = std::clamp(value, about.minimum, about.maximum);
    value = about.minimum + (value - about.minimum + step / 2) / step * step;
    return true;
  }

 private:
  int descriptor_;
};

}  // namespace

void set_v4l2_controls(const std::filesystem::path& device, const LiveOptions& wishes,
                       std::vector<std::string>& shortfalls) {
  if (!wishes.white_balance) return;
  const Node node(device);
  const int wished = static_cast<int>(std::lround(*wishes.white_balance));
  int kelvin = wished;
  const bool known = node.clamp(V4L2_CID_WHITE_BALANCE_TEMPERATURE, kelvin);
  if (!known || !node.set(V4L2_CID_AUTO_WHITE_BALANCE, 0) || !node.set(V4L2_CID_WHITE_BALANCE_TEMPERATURE, kelvin)) {
    shortfalls.emplace_back("--white-balance has no effect: this camera does not let it be set");
  } else if (kelvin != wished) {
    shortfalls.push_back("--white-balance is not among what this camera has: it is set to " + std::to_string(kelvin));
  }
}

}  // namespace onestroke

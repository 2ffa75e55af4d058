#include "scene/point_picker.h"

#include <algorithm>

namespace onestroke {

std::optional<Vec3> PointPicker::update(const std::optional<Vec3>& point, Time now) {
  progress_ = 0;
  if (!point) {
    if (now - seen_ > longest_gap) count_ = 0;
    return std::nullopt;
  }
  seen_ = now;
  if ((last_ && norm(*point - *last_) < left_mm)) {
    count_ = 0;
    return std::nullopt;
  }
  if (count_ == 0 || norm(*point - mean_) > still_mm) {
    last_.reset();
    mean_ = *point;
    count_ = 1;
    since_ = now;
    return std::nullopt;
  }
  ++count_;
  mean_ = mean_ + (*point - mean_) / count_;
  progress_ = std::clamp((now - since_).seconds() / hold.seconds(), 0.0, 1.0);
  if (now - since_ < hold) return std::nullopt;
  last_ = mean_;
  count_ = 0;
  progress_ = 0;
  return last_;
}

}  // namespace onestroke

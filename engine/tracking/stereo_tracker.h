#pragma once

#include "tracking/tracker.h"

#include <memory>

namespace onestroke {

/// A Tracker for each camera of a pair, and their poses as one: see fuse_second(). The second has a thread of its own,
/// which begins with the first pair, sleeps between pictures and ends with this. A picture that comes alone is the
/// first tracker's, whichever camera it is of. Nothing is allocated once warm.
class StereoTracker final : public PictureTracker {
 public:
  explicit StereoTracker(Catalog catalog, const TrackerOptions& options = {});
  ~StereoTracker() override;

  /// The record is of the first picture's camera and time; its cost is the time until both were done.
  void process(const Picture& picture, FrameRecord& record) override;

 private:
  class Second;

  Catalog catalog_;
  TrackerOptions options_;
  Tracker first_;
  std::unique_ptr<Second> second_;
};

}  // namespace onestroke

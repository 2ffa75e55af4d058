#pragma once

#include "bench_pictures.h"

#include <memory>
#include <string>

namespace onestroke::bench {

/// A detector of black and white tags, on one thread.
class Yardstick {
 public:
  virtual ~Yardstick() = default;
  /// How many tags the first picture, in grey, holds.
  virtual int tags(const BenchPictures& pictures) = 0;
};

/// OpenCV's ArUco with its default parameters, or with the faster detection of ArUco 3.
std::unique_ptr<Yardstick> aruco_yardstick(bool aruco3);
/// The AprilTag library, at half the resolution.
std::unique_ptr<Yardstick> april_yardstick();

}  // namespace onestroke::bench

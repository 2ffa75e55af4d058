#pragma once

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace onestroke::accuracy {

/// A photograph, or a picture made of some, that an installed package brings.
struct Photograph {
  std::string package, file;
};

/// Those of the packages named in the source, each picture once, however many sizes of it there are.
std::vector<Photograph> photographs();

/// What a camera would see of a picture of this size, pixels: the whole, and of one that is much larger than a camera's
/// picture also parts that do not overlap. Nothing of one that is too small to be a photograph.
std::vector<cv::Rect> views_of(cv::Size size);

/// RGB, as wide as a camera's picture: the whole is scaled, parts are as they were taken.
cv::Mat3b read_view(const cv::Mat3b& bgr, const cv::Rect& view);

}  // namespace onestroke::accuracy

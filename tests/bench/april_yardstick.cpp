#include "yardsticks.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

namespace onestroke::bench {
namespace {

class April : public Yardstick {
 public:
  April() {
    apriltag_detector_add_family(detector_, family_);
    detector_->quad_decimate = 2;
    detector_->nthreads = 1;
  }
  ~April() override {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  April(const April&) = delete;
  April& operator=(const April&) = delete;

  int tags(const BenchPictures& pictures) override {
    image_u8_t gray{pictures.width(), pictures.height(), pictures.width(),
                    const_cast<std::uint8_t*>(pictures.gray().data())};
    zarray_t* found = apriltag_detector_detect(detector_, &gray);
    const int count = zarray_size(found);
    apriltag_detections_destroy(found);
    return count;
  }

 private:
  apriltag_family_t* family_ = tag36h11_create();
  apriltag_detector_t* detector_ = apriltag_detector_create();
};

}  // namespace

std::unique_ptr<Yardstick> april_yardstick() {
  return std::make_unique<April>();
}

}  // namespace onestroke::bench

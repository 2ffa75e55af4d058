// The synthetic camera allocates nothing once it is warm.

#include "allocation/allocation_counter.h"
#include "camera/open_camera.h"
#include "scene_fixture.h"

namespace onestroke::test {
namespace {

TEST(Allocation, AWarmCameraMakesPicturesWithout) {
  const Catalog catalog = two_markers();
  CameraOptions options;
  options.spec = "synthetic:width=160,height=120,fps=5,fingers=2,threads=2,exposure_ms=20,readout_ms=20,blur=1";
  options.catalog = &catalog;
  const auto camera = open_camera(options);
  for (int i = 0; i < 8; ++i) take(*camera).reset();
  const long before = allocations_of_all_threads();
  int good = 0;
  for (int i = 0; i < 110; ++i) {
    PictureHandle picture;
    good += camera->next(picture) == Camera::Status::ok;
  }
  EXPECT_EQ(allocations_of_all_threads(), before);
  EXPECT_EQ(good, 110);
}

}  // namespace
}  // namespace onestroke::test

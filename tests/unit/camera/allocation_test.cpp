// The synthetic camera allocates nothing once it is warm.

#include "camera/open_camera.h"
#include "scene_fixture.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
}

// Kept out of line: a compiler that sees through them takes malloc and free for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

namespace onestroke::test {
namespace {

TEST(Allocation, AWarmCameraMakesPicturesWithout) {
  const Catalog catalog = two_markers();
  CameraOptions options;
  options.spec = "synthetic:width=160,height=120,fps=5,fingers=2,threads=2,exposure_ms=20,readout_ms=20,blur=1";
  options.catalog = &catalog;
  const auto camera = open_camera(options);
  for (int i = 0; i < 8; ++i) take(*camera).reset();
  const long before = allocations.load();
  int good = 0;
  for (int i = 0; i < 110; ++i) {
    PictureHandle picture;
    good += camera->next(picture) == Camera::Status::ok;
  }
  EXPECT_EQ(allocations.load(), before);
  EXPECT_EQ(good, 110);
}

}  // namespace
}  // namespace onestroke::test

// The renderer's promises that no picture shows.
#include "render/renderer.h"

#include "core/error.h"
#include "golden/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onestroke {
namespace {

TEST(Renderer, RefusesPicturesThatAreNotSound) {
  Gpu gpu(GpuOptions{});
  Renderer renderer(gpu);
  golden::Chart chart(64, 48, PixelFormat::rgb8, 0.9);
  Picture broken = chart.picture;
  broken.planes[0] = nullptr;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.strides[0] = 100;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.intrinsics = {};
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.width = 0;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  EXPECT_NO_THROW(renderer.set_picture(chart.picture));
}

TEST(Gpu, IsChosenByNumberOrByName) {
  const std::string name = Gpu(GpuOptions{.gpu = "0"}).name();
  EXPECT_EQ(Gpu(GpuOptions{.gpu = name.substr(0, 4)}).name(), name);
}

TEST(Gpu, SaysWhichThereAreWhereTheNamedOneIsMissing) {
  try {
    Gpu gpu(GpuOptions{.gpu = "no such thing"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no GPU is called \"no such thing\": there are 0 "));
  }
}

TEST(Gpu, NamesTheExtensionThatIsMissing) {
  try {
    Gpu gpu(GpuOptions{.needs = {.instance_extensions = {"VK_ONESTROKE_nothing"}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("VK_ONESTROKE_nothing"));
  }
  try {
    Gpu gpu(GpuOptions{.needs = {.device_extensions = {"VK_ONESTROKE_device"}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("VK_ONESTROKE_device"));
  }
}

}  // namespace
}  // namespace onestroke

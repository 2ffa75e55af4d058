// The renderer's promises that no picture shows.
#include "render/renderer.h"

#include "core/error.h"
#include "golden/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

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
  EXPECT_EQ(Gpu(GpuOptions{.gpu = name.substr(2, 4)}).name(), name);
  std::string shouted = name.substr(0, 4);
  for (char& c : shouted) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(Gpu(GpuOptions{.gpu = shouted}).name(), name);
}

TEST(Gpu, SaysWhichThereAreWhereTheNamedOneIsMissing) {
  for (const std::string wanted : {"no such thing", "99", "0x", "-1"}) {
    try {
      Gpu gpu(GpuOptions{.gpu = wanted});
      ADD_FAILURE() << wanted;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("no GPU is called \"" + wanted + "\""),
                                               testing::HasSubstr("--gpu"), testing::HasSubstr("of 0 ")));
    }
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

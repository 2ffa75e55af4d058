// How far away what is shown is, as a display is told that projects it once more.
#include "golden/solids.h"
#include "golden/stage.h"
#include "render/resources.h"
#include "render/target.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace onestroke::golden {
namespace {

/// mm, at the pixels of a view's layer; infinite where nothing is.
struct Distances {
  int width = 0;
  std::vector<float> reverse;  // near plane over distance

  double at(int x, int y) const { return near_plane / double{reverse.at(static_cast<std::size_t>(y * width + x))}; }
};

template <typename StageOfViews>
class DepthTargets : public StageOfViews {
 protected:
  using StageOfViews::height;
  using StageOfViews::width;

  /// Three frames, the last one's depth read back layer by layer.
  std::vector<Distances> draw_depth(const FrameScene& scene) {
    const auto device = this->gpu->device();
    const auto layers = static_cast<std::uint32_t>(this->views_);
    const Image image(
        *device, {.format = vk::Format::eD32Sfloat,
                  .width = width,
                  .height = height,
                  .layers = layers,
                  .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc});
    std::vector<vk::raii::ImageView> each;
    for (std::uint32_t i = 0; i < layers; ++i) each.push_back(make_layer_view(*device, image, i));
    for (int i = 0; i < 3; ++i) {
      FrameInfo frame;
      this->display_->begin(frame);
      for (auto& view : frame.views) view.fov = fov_of(Intrinsics::from_fov(width, height, this->fov), width, height);
      RenderTarget target = *frame.target;
      target.depth = {.image = image.handle(), .view = image.view(), .format = VK_FORMAT_D32_SFLOAT};
      for (std::uint32_t eye = 0; eye < layers; ++eye) target.depth.layer_views.at(eye) = *each[eye];
      const RenderTarget* shown = std::exchange(frame.target, &target);
      EXPECT_TRUE(this->renderer->draw(scene, frame)) << this->renderer->failure();
      frame.target = shown;
      this->display_->end(frame);
    }
    return read(*device, image);
  }

 private:
  static std::vector<Distances> read(Device& device, const Image& image) {
    using Layout = vk::ImageLayout;
    const std::size_t texels = static_cast<std::size_t>(width) * height;
    const Buffer buffer(device, texels * image.info().layers * sizeof(float), vk::BufferUsageFlagBits::eTransferDst,
                        MemoryPool::Use::readback);
    device.run_now([&](const vk::raii::CommandBuffer& commands) {
      image_barrier(commands, image.handle(), {Layout::eDepthStencilAttachmentOptimal, Layout::eTransferSrcOptimal},
                    {vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eDepthStencilAttachmentWrite},
                    {vk::PipelineStageFlagBits2::eAllTransfer, vk::AccessFlagBits2::eTransferRead},
                    vk::ImageAspectFlagBits::eDepth);
      const vk::BufferImageCopy all{
          .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eDepth, .layerCount = image.info().layers},
          .imageExtent = {image.info().width, image.info().height, 1}};
      commands.copyImageToBuffer(image.handle(), Layout::eTransferSrcOptimal, buffer.handle(), all);
    });
    std::vector<Distances> layers;
    for (std::uint32_t i = 0; i < image.info().layers; ++i) {
      Distances& layer = layers.emplace_back(Distances{width, std::vector<float>(texels)});
      std::memcpy(layer.reverse.data(), buffer.mapped() + i * texels * sizeof(float), texels * sizeof(float));
    }
    return layers;
  }
};

using DepthTarget1 = DepthTargets<Stage>;
using DepthTarget2 = DepthTargets<StereoStage>;

TEST_F(DepthTarget1, TellsThePicturesAndTheModelsDistance) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  // Its front is 380 mm away, and it hides the picture, which is farther.
  const std::array instances{ModelInstance{.model = renderer->load(box({0.03F, 0.03F, 0.02F}, {})),
                                           .world_graphics_from_model = placed(0, 0, -0.4F, 0, 0)}};
  const Distances seen = draw_depth({.passthrough_distance = 500, .instances = instances}).front();
  EXPECT_NEAR(seen.at(width / 2, height / 2), 380, 0.1);
  EXPECT_NEAR(seen.at(20, 20), 500, 0.1);
}

TEST_F(DepthTarget1, NothingIsInfinitelyFar) {
  const std::array instances{ModelInstance{.model = renderer->load(box({0.03F, 0.03F, 0.02F}, {})),
                                           .world_graphics_from_model = placed(0, 0, -0.4F, 0, 0)}};
  const Distances seen = draw_depth({.instances = instances}).front();
  EXPECT_NEAR(seen.at(width / 2, height / 2), 380, 0.1);
  EXPECT_TRUE(std::isinf(seen.at(20, 20)));
}

TEST_F(DepthTarget2, HasALayerForEachEye) {
  // Before the left eye's axis alone.
  const std::array instances{ModelInstance{.model = renderer->load(box({0.02F, 0.03F, 0.02F}, {})),
                                           .world_graphics_from_model = placed(-0.06F, 0, -0.4F, 0, 0)}};
  const auto layers = draw_depth({.instances = instances});
  ASSERT_EQ(layers.size(), 2U);
  const auto nearest = [](const Distances& d) {
    return std::max_element(d.reverse.begin(), d.reverse.end()) - d.reverse.begin();
  };
  for (const Distances& d : layers)
    EXPECT_NEAR(near_plane / double{*std::max_element(d.reverse.begin(), d.reverse.end())}, 380, 0.1);
  // The same thing lies farther to the right for the left eye.
  const auto left = nearest(layers[0]) % width, right = nearest(layers[1]) % width;
  EXPECT_GT(left, right);
}

}  // namespace
}  // namespace onestroke::golden

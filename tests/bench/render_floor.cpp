#include "render_floor.h"

#include "render/graphics_pipeline.h"
#include "render/upload.h"

namespace onestroke::bench {

namespace {

#include "full_screen_frag.spv.h"
#include "full_screen_vert.spv.h"

using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;

Image make_picture(Device& device, const RenderTarget& target) {
  const std::vector<std::byte> grey(std::size_t{4} * static_cast<std::size_t>(target.width * target.height),
                                    std::byte{0x80});
  return upload_image(device,
                      {.format = vk::Format::eR8G8B8A8Srgb,
                       .width = static_cast<std::uint32_t>(target.width),
                       .height = static_cast<std::uint32_t>(target.height)},
                      grey);
}

vk::raii::DescriptorSetLayout make_set_layout(Device& device) {
  const vk::DescriptorSetLayoutBinding binding{0, vk::DescriptorType::eCombinedImageSampler, 1,
                                               vk::ShaderStageFlagBits::eFragment};
  return device.vk().createDescriptorSetLayout({.bindingCount = 1, .pBindings = &binding});
}

vk::raii::DescriptorPool make_descriptors(Device& device) {
  const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
  return device.vk().createDescriptorPool({.maxSets = 1, .poolSizeCount = 1, .pPoolSizes = &size});
}

vk::DescriptorSet make_set(Device& device, vk::DescriptorPool pool, vk::DescriptorSetLayout layout, vk::Sampler sampler,
                           const Image& picture) {
  const vk::DescriptorSet set =
      device.vk()
          .allocateDescriptorSets({.descriptorPool = pool, .descriptorSetCount = 1, .pSetLayouts = &layout})
          .front()
          .release();
  const vk::DescriptorImageInfo image{
      .sampler = sampler, .imageView = picture.view(), .imageLayout = Layout::eShaderReadOnlyOptimal};
  device.vk().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set,
                                                          .dstBinding = 0,
                                                          .descriptorCount = 1,
                                                          .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                          .pImageInfo = &image},
                                   {});
  return set;
}

}  // namespace

RenderFloor::RenderFloor(Device& device, const RenderTarget& target)
    : device_(device),
      target_(target),
      picture_(make_picture(device, target)),
      sampler_(device.vk().createSampler({.magFilter = vk::Filter::eLinear,
                                          .minFilter = vk::Filter::eLinear,
                                          .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                          .addressModeV = vk::SamplerAddressMode::eClampToEdge})),
      set_layout_(make_set_layout(device)),
      descriptors_(make_descriptors(device)),
      set_(make_set(device, *descriptors_, *set_layout_, *sampler_, picture_)),
      layout_(device.vk().createPipelineLayout({.setLayoutCount = 1, .pSetLayouts = &*set_layout_})),
      pipeline_(make_graphics_pipeline(device, {.vertex = full_screen_vert_words,
                                                .fragment = full_screen_frag_words,
                                                .layout = *layout_,
                                                .color = static_cast<vk::Format>(target.format)})),
      pool_(device.vk().createCommandPool(
          {.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = device.queue_family()})),
      commands_(
          std::move(device.vk().allocateCommandBuffers({.commandPool = *pool_, .commandBufferCount = 1}).front())),
      fence_(device.vk().createFence({})) {}

void RenderFloor::clear() {
  run(false);
}

void RenderFloor::draw_texture() {
  run(true);
}

void RenderFloor::run(bool textured) {
  pool_.reset();
  commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  const Access draw{Stage::eColorAttachmentOutput, Reach::eColorAttachmentWrite};
  image_barrier(commands_, target_.image, {Layout::eUndefined, Layout::eColorAttachmentOptimal}, draw, draw);
  for (int layer = 0; layer < target_.layers; ++layer)
    fill(textured, target_.layer_views[static_cast<std::size_t>(layer)]);
  commands_.end();
  device_.vk().resetFences(*fence_);
  const vk::CommandBufferSubmitInfo buffer{.commandBuffer = *commands_};
  device_.queue().submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer}, *fence_);
  vk::resultCheck(device_.vk().waitForFences(*fence_, true, UINT64_MAX), "waiting for the floor");
}

void RenderFloor::fill(bool textured, vk::ImageView layer) {
  const vk::Extent2D extent{static_cast<std::uint32_t>(target_.width), static_cast<std::uint32_t>(target_.height)};
  const vk::RenderingAttachmentInfo attachment{
      .imageView = layer,
      .imageLayout = Layout::eColorAttachmentOptimal,
      .loadOp = textured ? vk::AttachmentLoadOp::eDontCare : vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eStore,
      .clearValue = {.color = {.float32 = std::array{0.1F, 0.2F, 0.3F, 1.0F}}}};
  commands_.beginRendering(
      {.renderArea = {.extent = extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &attachment});
  if (textured) {
    set_viewport(commands_, {{}, extent});
    commands_.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    commands_.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, set_, {});
    commands_.draw(3, 1, 0, 0);
  }
  commands_.endRendering();
}

}  // namespace onestroke::bench

#include "render/multiview_probe.h"

#include "render/graphics_pipeline.h"
#include "render/resources.h"
#include "shaders/spirv.h"

#include <algorithm>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

constexpr auto format = vk::Format::eR8Unorm;
constexpr std::uint32_t size = 4, views = 2, view_mask = 0b11;

void draw(const vk::raii::CommandBuffer& commands, vk::Pipeline pipeline, const Image& image, const Buffer& bytes) {
  const Access written{Stage::eColorAttachmentOutput, Reach::eColorAttachmentWrite};
  image_barrier(commands, image.handle(), {Layout::eUndefined, Layout::eColorAttachmentOptimal}, {}, written);
  const vk::RenderingAttachmentInfo color{.imageView = image.view(),
                                          .imageLayout = Layout::eColorAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eStore};
  commands.beginRendering({.renderArea = {.extent = {size, size}},
                           .layerCount = views,
                           .viewMask = view_mask,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &color});
  set_viewport(commands, {{}, {size, size}});
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
  commands.draw(3, 1, 0, 0);
  commands.endRendering();
  image_barrier(commands, image.handle(), {Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal}, written,
                {Stage::eAllTransfer, Reach::eTransferRead});
  commands.copyImageToBuffer(
      image.handle(), Layout::eTransferSrcOptimal, bytes.handle(),
      vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = views},
                          .imageExtent = {size, size, 1}});
  const vk::MemoryBarrier2 barrier{.srcStageMask = Stage::eAllTransfer,
                                   .srcAccessMask = Reach::eTransferWrite,
                                   .dstStageMask = Stage::eHost,
                                   .dstAccessMask = Reach::eHostRead};
  commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

}  // namespace

bool multiview_works(Device& device) {
  const Image image(device, {.format = format,
                             .width = size,
                             .height = size,
                             .layers = views,
                             .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
  const Buffer bytes(device, size * size * views, vk::BufferUsageFlagBits::eTransferDst, MemoryPool::Use::readback);
  const auto layout = device.vk().createPipelineLayout({});
  const auto pipeline = make_graphics_pipeline(device, {.vertex = spirv::full_screen_vert(),
                                                        .fragment = spirv::probe_frag(),
                                                        .layout = *layout,
                                                        .color = format,
                                                        .view_mask = view_mask});
  device.run_now([&](const vk::raii::CommandBuffer& commands) { draw(commands, *pipeline, image, bytes); });
  const std::span seen(bytes.mapped(), bytes.size());
  const auto shows = [](std::span<const std::byte> layer, int view) {
    return std::all_of(layer.begin(), layer.end(), [view](std::byte b) { return b == std::byte(view + 1); });
  };
  return shows(seen.first(size * size), 0) && shows(seen.last(size * size), 1);
}

}  // namespace onestroke

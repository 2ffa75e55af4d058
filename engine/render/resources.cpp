#include "render/resources.h"

#include <algorithm>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

vk::ImageAspectFlags aspect_of(vk::Format format) {
  return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::raii::ImageView make_view(Device& device, vk::Image image, const ImageInfo& info, vk::Format format,
                              vk::ImageUsageFlags usage) {
  using Type = vk::ImageViewType;
  const vk::ImageViewUsageCreateInfo limit{.usage = usage};
  return device.vk().createImageView(
      {.pNext = &limit,
       .image = image,
       .viewType = info.cube         ? Type::eCube
                   : info.layers > 1 ? Type::e2DArray
                                     : Type::e2D,
       .format = format,
       .subresourceRange = {
           .aspectMask = aspect_of(format), .levelCount = VK_REMAINING_MIP_LEVELS, .layerCount = info.layers}});
}

Buffer staging_of(Device& device, std::span<const std::byte> bytes) {
  Buffer staging(device, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, MemoryPool::Use::upload);
  std::memcpy(staging.mapped(), bytes.data(), bytes.size());
  return staging;
}

/// Halves level after level; each ends up ready for sampling.
void make_mipmaps(const vk::raii::CommandBuffer& commands, const Image& image) {
  const Access copy_write{Stage::eAllTransfer, Reach::eTransferWrite};
  const Access copy_read{Stage::eAllTransfer, Reach::eTransferRead};
  const Access sample{Stage::eFragmentShader, Reach::eShaderSampledRead};
  const auto color = vk::ImageAspectFlagBits::eColor;
  auto width = static_cast<std::int32_t>(image.info().width), height = static_cast<std::int32_t>(image.info().height);
  for (std::uint32_t level = 1; level < image.info().mip_levels; ++level) {
    image_barrier(commands, image.handle(), {Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal}, copy_write,
                  copy_read, color, level - 1, 1);
    const std::int32_t half_width = std::max(width / 2, 1), half_height = std::max(height / 2, 1);
    const vk::ImageBlit2 blit{
        .srcSubresource = {.aspectMask = color, .mipLevel = level - 1, .layerCount = 1},
        .srcOffsets = std::array{vk::Offset3D{0, 0, 0}, vk::Offset3D{width, height, 1}},
        .dstSubresource = {.aspectMask = color, .mipLevel = level, .layerCount = 1},
        .dstOffsets = std::array{vk::Offset3D{0, 0, 0}, vk::Offset3D{half_width, half_height, 1}}};
    commands.blitImage2({.srcImage = image.handle(),
                         .srcImageLayout = Layout::eTransferSrcOptimal,
                         .dstImage = image.handle(),
                         .dstImageLayout = Layout::eTransferDstOptimal,
                         .regionCount = 1,
                         .pRegions = &blit,
                         .filter = vk::Filter::eLinear});
    image_barrier(commands, image.handle(), {Layout::eTransferSrcOptimal, Layout::eShaderReadOnlyOptimal}, copy_read,
                  sample, color, level - 1, 1);
    width = half_width;
    height = half_height;
  }
  image_barrier(commands, image.handle(), {Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal}, copy_write,
                sample, color, image.info().mip_levels - 1, 1);
}

}  // namespace

Buffer::Buffer(Device& device, std::uint64_t size, vk::BufferUsageFlags usage, MemoryPool::Use use)
    : buffer_(device.vk().createBuffer({.size = size, .usage = usage})), size_(size) {
  allocation_ = device.memory().allocate(buffer_.getMemoryRequirements(), use);
  buffer_.bindMemory(allocation_.memory(), allocation_.offset());
}

Image::Image(Device& device, const ImageInfo& info) : info_(info) {
  const bool two = info.second_format != vk::Format::eUndefined;
  vk::ImageCreateFlags flags;
  // The second format need not support every use of the first.
  if (two) flags = vk::ImageCreateFlagBits::eMutableFormat | vk::ImageCreateFlagBits::eExtendedUsage;
  if (info.cube) flags |= vk::ImageCreateFlagBits::eCubeCompatible;
  image_ = device.vk().createImage({.flags = flags,
                                    .imageType = vk::ImageType::e2D,
                                    .format = info.format,
                                    .extent = {info.width, info.height, 1},
                                    .mipLevels = info.mip_levels,
                                    .arrayLayers = info.layers,
                                    .samples = info.samples,
                                    .usage = info.usage});
  allocation_ = device.memory().allocate(image_.getMemoryRequirements(), MemoryPool::Use::device);
  image_.bindMemory(allocation_.memory(), allocation_.offset());
  view_ = make_view(device, *image_, info, info.format, info.usage);
  if (two) second_view_ = make_view(device, *image_, info, info.second_format, vk::ImageUsageFlagBits::eSampled);
}

void image_barrier(const vk::raii::CommandBuffer& commands, vk::Image image, LayoutChange layout, Access before,
                   Access after, vk::ImageAspectFlags aspect, std::uint32_t first_mip, std::uint32_t mips) {
  const vk::ImageMemoryBarrier2 barrier{.srcStageMask = before.stage,
                                        .srcAccessMask = before.access,
                                        .dstStageMask = after.stage,
                                        .dstAccessMask = after.access,
                                        .oldLayout = layout.from,
                                        .newLayout = layout.to,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = image,
                                        .subresourceRange = {.aspectMask = aspect,
                                                             .baseMipLevel = first_mip,
                                                             .levelCount = mips,
                                                             .layerCount = VK_REMAINING_ARRAY_LAYERS}};
  commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

Buffer upload_buffer(Device& device, std::span<const std::byte> bytes, vk::BufferUsageFlags usage) {
  const Buffer staging = staging_of(device, bytes);
  Buffer buffer(device, bytes.size(), usage | vk::BufferUsageFlagBits::eTransferDst, MemoryPool::Use::device);
  device.run_now([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(staging.handle(), buffer.handle(), vk::BufferCopy{0, 0, bytes.size()});
    const vk::MemoryBarrier2 barrier{.srcStageMask = Stage::eAllTransfer,
                                     .srcAccessMask = Reach::eTransferWrite,
                                     .dstStageMask = Stage::eAllGraphics,
                                     .dstAccessMask = Reach::eMemoryRead};
    commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
  });
  return buffer;
}

Image upload_image(Device& device, ImageInfo info, std::span<const std::byte> bytes) {
  info.usage |= vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
  if (info.mip_levels > 1) info.usage |= vk::ImageUsageFlagBits::eTransferSrc;
  const Buffer staging = staging_of(device, bytes);
  Image image(device, info);
  device.run_now([&](const vk::raii::CommandBuffer& commands) {
    image_barrier(commands, image.handle(), {Layout::eUndefined, Layout::eTransferDstOptimal}, {},
                  {Stage::eAllTransfer, Reach::eTransferWrite});
    commands.copyBufferToImage(
        staging.handle(), image.handle(), Layout::eTransferDstOptimal,
        vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                            .imageExtent = {info.width, info.height, 1}});
    make_mipmaps(commands, image);
  });
  return image;
}

}  // namespace onestroke

#include "render/upload.h"

#include <algorithm>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

Buffer staging_of(Device& device, std::span<const std::byte> bytes) {
  Buffer staging(device, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, MemoryPool::Use::upload);
  std::memcpy(staging.mapped(), bytes.data(), bytes.size());
  return staging;
}

/// Halves level after level; each ends up ready for sampling.
void make_mipmaps(const vk::raii::CommandBuffer& commands, vk::Image image, const ImageInfo& info) {
  const Access copy_write{Stage::eAllTransfer, Reach::eTransferWrite};
  const Access copy_read{Stage::eAllTransfer, Reach::eTransferRead};
  const auto color = vk::ImageAspectFlagBits::eColor;
  auto width = static_cast<std::int32_t>(info.width), height = static_cast<std::int32_t>(info.height);
  for (std::uint32_t level = 1; level < info.mip_levels; ++level) {
    image_barrier(commands, image, {Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal}, copy_write, copy_read,
                  color, level - 1, 1);
    const std::int32_t half_width = std::max(width / 2, 1), half_height = std::max(height / 2, 1);
    const vk::ImageBlit2 blit{
        .srcSubresource = {.aspectMask = color, .mipLevel = level - 1, .layerCount = 1},
        .srcOffsets = std::array{vk::Offset3D{0, 0, 0}, vk::Offset3D{width, height, 1}},
        .dstSubresource = {.aspectMask = color, .mipLevel = level, .layerCount = 1},
        .dstOffsets = std::array{vk::Offset3D{0, 0, 0}, vk::Offset3D{half_width, half_height, 1}}};
    commands.blitImage2({.srcImage = image,
                         .srcImageLayout = Layout::eTransferSrcOptimal,
                         .dstImage = image,
                         .dstImageLayout = Layout::eTransferDstOptimal,
                         .regionCount = 1,
                         .pRegions = &blit,
                         .filter = vk::Filter::eLinear});
    image_barrier(commands, image, {Layout::eTransferSrcOptimal, Layout::eShaderReadOnlyOptimal}, copy_read,
                  sampled_by_fragments, color, level - 1, 1);
    width = half_width;
    height = half_height;
  }
  image_barrier(commands, image, {Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal}, copy_write,
                sampled_by_fragments, color, info.mip_levels - 1, 1);
}

}  // namespace

Buffer Upload::buffer(std::span<const std::byte> bytes, vk::BufferUsageFlags usage) {
  Buffer staging = staging_of(*device_, bytes);
  Buffer target(*device_, bytes.size(), usage | vk::BufferUsageFlagBits::eTransferDst, MemoryPool::Use::device);
  buffers_.push_back({std::move(staging), target.handle()});
  return target;
}

Image Upload::image(ImageInfo info, std::span<const std::byte> bytes) {
  info.usage |= vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst;
  if (info.mip_levels > 1) info.usage |= vk::ImageUsageFlagBits::eTransferSrc;
  Buffer staging = staging_of(*device_, bytes);
  Image target(*device_, info);
  images_.push_back({std::move(staging), target.handle(), info});
  return target;
}

void Upload::record(const vk::raii::CommandBuffer& commands) const {
  for (const BufferCopy& copy : buffers_)
    commands.copyBuffer(copy.staging.handle(), copy.target, vk::BufferCopy{0, 0, copy.staging.size()});
  for (const ImageCopy& copy : images_) {
    image_barrier(commands, copy.target, {Layout::eUndefined, Layout::eTransferDstOptimal}, {},
                  {Stage::eAllTransfer, Reach::eTransferWrite});
    commands.copyBufferToImage(
        copy.staging.handle(), copy.target, Layout::eTransferDstOptimal,
        vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                            .imageExtent = {copy.info.width, copy.info.height, 1}});
    make_mipmaps(commands, copy.target, copy.info);
  }
  const vk::MemoryBarrier2 barrier{.srcStageMask = Stage::eAllTransfer,
                                   .srcAccessMask = Reach::eTransferWrite,
                                   .dstStageMask = Stage::eAllGraphics,
                                   .dstAccessMask = Reach::eMemoryRead};
  if (!buffers_.empty()) commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

Image upload_image(Device& device, const ImageInfo& info, std::span<const std::byte> bytes) {
  Upload upload(device);
  Image image = upload.image(info, bytes);
  device.run_now([&](const vk::raii::CommandBuffer& commands) { upload.record(commands); });
  return image;
}

}  // namespace onestroke

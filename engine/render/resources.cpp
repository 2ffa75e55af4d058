#include "render/resources.h"

namespace onestroke {

namespace {

vk::ImageAspectFlags aspect_of(vk::Format format) {
  using Aspect = vk::ImageAspectFlagBits;
  if (has_stencil(format)) return Aspect::eDepth | Aspect::eStencil;
  return format == vk::Format::eD32Sfloat || format == vk::Format::eD16Unorm ? Aspect::eDepth : Aspect::eColor;
}

vk::raii::ImageView make_view(Device& device, vk::Image image, const ImageInfo& info, vk::Format format,
                              vk::ImageUsageFlags usage) {
  using Type = vk::ImageViewType;
  const vk::ImageViewUsageCreateInfo limit{.usage = usage};
  return device.vk().createImageView(
      {.pNext = &limit,
       .image = image,
       .viewType = info.cube                       ? Type::eCube
                   : info.layers > 1 || info.array ? Type::e2DArray
                                                   : Type::e2D,
       .format = format,
       .subresourceRange = {
           .aspectMask = aspect_of(format), .levelCount = VK_REMAINING_MIP_LEVELS, .layerCount = info.layers}});
}

}  // namespace

bool has_stencil(vk::Format format) {
  return format == vk::Format::eD32SfloatS8Uint || format == vk::Format::eD24UnormS8Uint;
}

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

vk::raii::ImageView make_depth_view(Device& device, const Image& image) {
  return device.vk().createImageView(
      {.image = image.handle(),
       .viewType = vk::ImageViewType::e2DArray,
       .format = image.info().format,
       .subresourceRange = {
           .aspectMask = vk::ImageAspectFlagBits::eDepth, .levelCount = 1, .layerCount = image.info().layers}});
}

vk::raii::ImageView make_layer_view(Device& device, const Image& image, std::uint32_t layer) {
  return device.vk().createImageView(
      {.image = image.handle(),
       .viewType = vk::ImageViewType::e2D,
       .format = image.info().format,
       .subresourceRange = {
           .aspectMask = aspect_of(image.info().format), .levelCount = 1, .baseArrayLayer = layer, .layerCount = 1}});
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

void fill_image(const vk::raii::CommandBuffer& commands, const Buffer& from, const Image& to,
                std::span<const vk::BufferImageCopy> regions) {
  using Layout = vk::ImageLayout;
  constexpr Access write{vk::PipelineStageFlagBits2::eAllTransfer, vk::AccessFlagBits2::eTransferWrite};
  image_barrier(commands, to.handle(), {Layout::eUndefined, Layout::eTransferDstOptimal}, sampled_by_fragments, write);
  commands.copyBufferToImage(
      from.handle(), to.handle(), Layout::eTransferDstOptimal,
      vk::ArrayProxy<const vk::BufferImageCopy>(static_cast<std::uint32_t>(regions.size()), regions.data()));
  image_barrier(commands, to.handle(), {Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal}, write,
                sampled_by_fragments);
}

void fill_image(const vk::raii::CommandBuffer& commands, const Buffer& from, const Image& to) {
  const vk::BufferImageCopy all{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                                .imageExtent = {to.info().width, to.info().height, 1}};
  fill_image(commands, from, to, {&all, 1});
}

}  // namespace onestroke

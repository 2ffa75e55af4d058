#include "render/picture_store.h"

#include "core/error.h"
#include "core/picture_planes.h"
#include "render/graphics_pipeline.h"
#include "render/upload.h"
#include "shaders/shared.h"
#include "shaders/spirv.h"

#include <glm/packing.hpp>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

/// How the planes are packed: each row from one word to a whole number of them.
struct Packing {
  std::uint32_t format = 0, row_words = 0;
  std::array<PlaneShape, 2> planes;

  std::uint32_t rows() const { return static_cast<std::uint32_t>(planes[0].rows + planes[1].rows); }
};

std::uint32_t unpacker_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::rgb8:
      return UNPACK_RGB8;
    case PixelFormat::gray8:
      return UNPACK_GRAY8;
    case PixelFormat::nv12:
      return UNPACK_NV12;
    case PixelFormat::yuyv:
      return UNPACK_YUYV;
  }
  throw Error("a picture has an unknown pixel format");
}

Packing packing_of(const Picture& p) {
  const auto shape = [&p](std::size_t plane) { return plane_shape(p.format, p.width, p.height, plane); };
  const std::array planes{shape(0), shape(1)};
  const std::size_t longest = std::max(planes[0].row_bytes, planes[1].row_bytes);
  return {unpacker_of(p.format), static_cast<std::uint32_t>((longest + 3) / 4), planes};
}

[[noreturn]] void refuse(const Picture& p, const std::string& what) {
  throw Error((*p.source ? std::string("picture ") + p.source : "a camera picture") + what);
}

void check(const Picture& p, const Packing& packing, std::uint32_t largest) {
  if (p.width <= 0 || p.height <= 0) refuse(p, " is empty");
  if (std::max(static_cast<std::uint32_t>(p.width), packing.rows()) > largest)
    refuse(p, " is larger than the GPU's " + std::to_string(largest) + " pixels: choose a smaller camera mode");
  if (!(p.intrinsics.fx > 0 && p.intrinsics.fy > 0)) refuse(p, " has no focal length: give --fov or --calibration");
  for (std::size_t i = 0; i < packing.planes.size(); ++i)
    if (packing.planes[i].rows && (!p.planes[i] || p.strides[i] < packing.planes[i].row_bytes))
      refuse(p, " lacks the bytes of plane " + std::to_string(i));
}

void copy_rows(std::byte* to, std::size_t step, const std::uint8_t* from, std::size_t stride, const PlaneShape& shape) {
  if (stride == step && shape.row_bytes == step) {
    std::memcpy(to, from, step * shape.rows);
    return;
  }
  for (std::size_t row = 0; row < shape.rows; ++row) std::memcpy(to + row * step, from + row * stride, shape.row_bytes);
}

vk::raii::DescriptorSetLayout make_set_layout(Device& device) {
  const vk::DescriptorSetLayoutBinding words{0, vk::DescriptorType::eSampledImage, 1,
                                             vk::ShaderStageFlagBits::eFragment};
  return device.vk().createDescriptorSetLayout({.bindingCount = 1, .pBindings = &words});
}

vk::raii::PipelineLayout make_layout(Device& device, vk::DescriptorSetLayout set) {
  const vk::PushConstantRange push{vk::ShaderStageFlagBits::eFragment, 0, sizeof(gpu::UnpackData)};
  return device.vk().createPipelineLayout(
      {.setLayoutCount = 1, .pSetLayouts = &set, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

constexpr auto stored = vk::Format::eR8G8B8A8Unorm;

vk::raii::Pipeline make_pipeline(Device& device, vk::PipelineLayout layout, std::uint32_t format) {
  return make_graphics_pipeline(device, {.vertex = spirv::full_screen_vert(),
                                         .fragment = spirv::unpack_frag(),
                                         .layout = layout,
                                         .color = stored,
                                         .constants = {format}});
}

/// Exact shifts where the GPU can look them up between texels; not every mobile one can.
vk::Format lens_format_for(const Device& device) {
  const auto exact = vk::Format::eR32G32Sfloat;
  const auto wanted = vk::FormatFeatureFlagBits::eSampledImage | vk::FormatFeatureFlagBits::eSampledImageFilterLinear;
  const auto features = device.physical().getFormatProperties(exact).optimalTilingFeatures;
  return (features & wanted) == wanted ? exact : vk::Format::eR16G16Sfloat;
}

vk::raii::DescriptorPool make_descriptors(Device& device, std::uint32_t count) {
  const vk::DescriptorPoolSize size{vk::DescriptorType::eSampledImage, count};
  return device.vk().createDescriptorPool({.maxSets = count, .poolSizeCount = 1, .pPoolSizes = &size});
}

}  // namespace

PictureStore::PictureStore(Device& device)
    : device_(device),
      set_layout_(make_set_layout(device)),
      layout_(make_layout(device, *set_layout_)),
      pipelines_{make_pipeline(device, *layout_, UNPACK_RGB8), make_pipeline(device, *layout_, UNPACK_GRAY8),
                 make_pipeline(device, *layout_, UNPACK_NV12), make_pipeline(device, *layout_, UNPACK_YUYV)},
      descriptors_(make_descriptors(device, slots)),
      lens_format_(lens_format_for(device)) {
  for (auto& set : sets_)
    set = device.vk()
              .allocateDescriptorSets(
                  {.descriptorPool = *descriptors_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_})
              .front()
              .release();
  constexpr std::array black{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{255}};
  blank_ = upload_image(device, {.format = vk::Format::eR8G8B8A8Srgb, .width = 1, .height = 1}, black);
}

void PictureStore::set(const Picture& p) {
  const Packing packing = packing_of(p);
  check(p, packing, device_.properties().limits.maxImageDimension2D);
  const auto& [first, second] = packing.planes;
  const std::size_t step = std::size_t{4} * packing.row_words;
  Buffer& staging = staging_[next_];
  if (const std::uint64_t bytes = step * packing.rows(); staging.size() < bytes)
    staging = Buffer(device_, bytes, vk::BufferUsageFlagBits::eTransferSrc, MemoryPool::Use::upload);
  copy_rows(staging.mapped(), step, p.planes[0], p.strides[0], first);
  if (second.rows) copy_rows(staging.mapped() + step * first.rows, step, p.planes[1], p.strides[1], second);
  follow_lens(p);
  width_ = p.width;
  height_ = p.height;
  sequence_ = p.sequence;
  format_ = packing.format;
  words_size_ = vk::Extent2D{packing.row_words, packing.rows()};
  intrinsics_ = p.intrinsics;
  T_world_camera_ = p.T_world_camera;
  pending_ = shown_ = true;
}

void PictureStore::follow_lens(const Picture& p) {
  // In picture heights; see passthrough.frag.
  constexpr double glow = 0.1;
  const Intrinsics& is = p.intrinsics;
  if (width_ == p.width && height_ == p.height && intrinsics_ == is) return;
  bounds_ = picture_bounds(is, p.width, p.height, glow);
  inside_ = inner_bounds(is, p.width, p.height);
  lens_placement_ = {};
  lens_pending_ = is.distorted();
  if (!lens_pending_) return;
  lens_map_ = make_lens_map(is, p.width, p.height, bounds_);
  lens_placement_ = lens_map_.placement();
}

void PictureStore::record_lens(FrameSlot& slot) {
  if (!lens_pending_) return;
  lens_pending_ = false;
  std::vector<std::uint32_t> halves;
  auto bytes = std::as_bytes(std::span(lens_map_.shifts));
  if (lens_format_ == vk::Format::eR16G16Sfloat) {
    for (std::size_t i = 0; i < lens_map_.shifts.size(); i += 2)
      halves.push_back(glm::packHalf2x16({lens_map_.shifts[i], lens_map_.shifts[i + 1]}));
    bytes = std::as_bytes(std::span(halves));
  }
  slot.graveyard.bury(std::move(lens_));
  const auto upload = std::make_shared<Upload>(device_);
  lens_ = upload->image({.format = lens_format_, .width = LensMap::width, .height = LensMap::height}, bytes);
  upload->record(slot.commands);
  slot.graveyard.bury(upload);
}

void PictureStore::fit(Graveyard& graveyard) {
  using Usage = vk::ImageUsageFlagBits;
  const auto fits = [](const Image& image, vk::Extent2D size) {
    return image && image.info().width == size.width && image.info().height == size.height;
  };
  if (!fits(words_, words_size_)) {
    graveyard.bury(std::move(words_));
    words_ = Image(device_, {.format = stored,
                             .width = words_size_.width,
                             .height = words_size_.height,
                             .usage = Usage::eTransferDst | Usage::eSampled});
  }
  const vk::Extent2D size{static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_)};
  if (fits(image_, size)) return;
  graveyard.bury(std::move(image_));
  // Drawn to byte for byte, sampled as the sRGB values that cameras give.
  image_ = Image(device_, {.format = stored,
                           .width = size.width,
                           .height = size.height,
                           .usage = Usage::eColorAttachment | Usage::eSampled,
                           .second_format = vk::Format::eR8G8B8A8Srgb});
}

void PictureStore::record_words(const vk::raii::CommandBuffer& commands) {
  const vk::DescriptorImageInfo image{.imageView = words_.view(), .imageLayout = Layout::eShaderReadOnlyOptimal};
  device_.vk().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = sets_[next_],
                                                           .descriptorCount = 1,
                                                           .descriptorType = vk::DescriptorType::eSampledImage,
                                                           .pImageInfo = &image},
                                    {});
  fill_image(commands, staging_[next_], words_);
}

void PictureStore::record_unpacking(const vk::raii::CommandBuffer& commands) const {
  const vk::Extent2D size{image_.info().width, image_.info().height};
  const Access draw{Stage::eColorAttachmentOutput, Reach::eColorAttachmentWrite};
  image_barrier(commands, image_.handle(), {Layout::eUndefined, Layout::eColorAttachmentOptimal}, sampled_by_fragments,
                draw);
  const vk::RenderingAttachmentInfo color{.imageView = image_.view(),
                                          .imageLayout = Layout::eColorAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eDontCare,
                                          .storeOp = vk::AttachmentStoreOp::eStore};
  commands.beginRendering(
      {.renderArea = {.extent = size}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color});
  set_viewport(commands, {{}, size});
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.at(format_));
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, sets_[next_], {});
  commands.pushConstants<gpu::UnpackData>(*layout_, vk::ShaderStageFlagBits::eFragment, 0,
                                          gpu::UnpackData{{height_, 0, 0, 0}});
  commands.draw(3, 1, 0, 0);
  commands.endRendering();
  image_barrier(commands, image_.handle(), {Layout::eColorAttachmentOptimal, Layout::eShaderReadOnlyOptimal}, draw,
                sampled_by_fragments);
}

void PictureStore::record(FrameSlot& slot) {
  record_lens(slot);
  if (!pending_) return;
  fit(slot.graveyard);
  record_words(slot.commands);
  record_unpacking(slot.commands);
  next_ = (next_ + 1) % slots;
  pending_ = false;
}

}  // namespace onestroke

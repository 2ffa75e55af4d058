#include "render/picture_store.h"

#include "core/error.h"
#include "render/upload.h"
#include "shaders/shared.h"
#include "shaders/spirv.h"

#include <glm/packing.hpp>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

/// How the bytes of one plane lie, and how they are packed: rows from one word to a whole number of them.
struct PlaneShape {
  std::uint32_t row_bytes = 0, rows = 0, row_words = 0;
};

struct Packing {
  std::uint32_t format = 0;
  std::array<PlaneShape, 2> planes;
};

Packing packing_of(const Picture& p) {
  const auto w = static_cast<std::uint32_t>(p.width), h = static_cast<std::uint32_t>(p.height);
  // The shader takes four pixels at a time.
  const std::uint32_t fours = (w + 3) / 4;
  switch (p.format) {
    case PixelFormat::rgb8:
      return {UNPACK_RGB8, {{{3 * w, h, 3 * fours}, {}}}};
    case PixelFormat::gray8:
      return {UNPACK_GRAY8, {{{w, h, fours}, {}}}};
    case PixelFormat::nv12:
      return {UNPACK_NV12, {{{w, h, fours}, {(w + 1) / 2 * 2, (h + 1) / 2, fours}}}};
    case PixelFormat::yuyv:
      return {UNPACK_YUYV, {{{(w + 1) / 2 * 4, h, 2 * fours}, {}}}};
  }
  throw Error("a picture has an unknown pixel format");
}

[[noreturn]] void refuse(const Picture& p, const std::string& what) {
  throw Error((*p.source ? std::string("picture ") + p.source : "a camera picture") + what);
}

void check(const Picture& p, const Packing& packing, std::uint32_t largest) {
  if (p.width <= 0 || p.height <= 0) refuse(p, " is empty");
  if (static_cast<std::uint32_t>(std::max(p.width, p.height)) > largest)
    refuse(p, " is larger than the GPU's " + std::to_string(largest) + " pixels: choose a smaller camera mode");
  if (!(p.intrinsics.fx > 0 && p.intrinsics.fy > 0)) refuse(p, " has no focal length: give --fov or --calibration");
  for (std::size_t i = 0; i < packing.planes.size(); ++i)
    if (packing.planes[i].rows && (!p.planes[i] || p.strides[i] < packing.planes[i].row_bytes))
      refuse(p, " lacks the bytes of plane " + std::to_string(i));
}

void copy_rows(std::byte* to, const std::uint8_t* from, std::size_t stride, const PlaneShape& shape) {
  const std::size_t step = std::size_t{shape.row_words} * 4;
  if (stride == step && shape.row_bytes == step) {
    std::memcpy(to, from, step * shape.rows);
    return;
  }
  for (std::size_t row = 0; row < shape.rows; ++row) std::memcpy(to + row * step, from + row * stride, shape.row_bytes);
}

vk::raii::DescriptorSetLayout make_set_layout(Device& device) {
  const std::array bindings{
      vk::DescriptorSetLayoutBinding{0, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute},
      vk::DescriptorSetLayoutBinding{1, vk::DescriptorType::eStorageImage, 1, vk::ShaderStageFlagBits::eCompute}};
  return device.vk().createDescriptorSetLayout({.bindingCount = 2, .pBindings = bindings.data()});
}

vk::raii::PipelineLayout make_layout(Device& device, vk::DescriptorSetLayout set) {
  const vk::PushConstantRange push{vk::ShaderStageFlagBits::eCompute, 0, sizeof(gpu::UnpackData)};
  return device.vk().createPipelineLayout(
      {.setLayoutCount = 1, .pSetLayouts = &set, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

vk::raii::Pipeline make_pipeline(Device& device, vk::PipelineLayout layout) {
  const auto words = spirv::unpack_comp();
  const auto module = device.vk().createShaderModule({.codeSize = words.size_bytes(), .pCode = words.data()});
  return device.vk().createComputePipeline(
      device.pipeline_cache(),
      {.stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"}, .layout = layout});
}

/// Exact shifts where the GPU can look them up between texels; not every mobile one can.
vk::Format lens_format_for(const Device& device) {
  const auto exact = vk::Format::eR32G32Sfloat;
  const auto wanted = vk::FormatFeatureFlagBits::eSampledImage | vk::FormatFeatureFlagBits::eSampledImageFilterLinear;
  const auto features = device.physical().getFormatProperties(exact).optimalTilingFeatures;
  return (features & wanted) == wanted ? exact : vk::Format::eR16G16Sfloat;
}

vk::raii::DescriptorPool make_descriptors(Device& device, std::uint32_t count) {
  const std::array sizes{vk::DescriptorPoolSize{vk::DescriptorType::eStorageBuffer, count},
                         vk::DescriptorPoolSize{vk::DescriptorType::eStorageImage, count}};
  return device.vk().createDescriptorPool({.maxSets = count, .poolSizeCount = 2, .pPoolSizes = sizes.data()});
}

}  // namespace

PictureStore::PictureStore(Device& device)
    : device_(device),
      set_layout_(make_set_layout(device)),
      layout_(make_layout(device, *set_layout_)),
      pipeline_(make_pipeline(device, *layout_)),
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
  const std::uint32_t second_at = first.row_words * first.rows;
  const std::uint64_t bytes = 4 * (std::uint64_t{second_at} + std::uint64_t{second.row_words} * second.rows);
  Buffer& staging = staging_[next_];
  if (staging.size() < bytes)
    staging = Buffer(device_, bytes, vk::BufferUsageFlagBits::eStorageBuffer, MemoryPool::Use::upload);
  copy_rows(staging.mapped(), p.planes[0], p.strides[0], first);
  if (second.rows) copy_rows(staging.mapped() + std::size_t{4} * second_at, p.planes[1], p.strides[1], second);
  follow_lens(p);
  width_ = p.width;
  height_ = p.height;
  sequence_ = p.sequence;
  push_ = {static_cast<std::uint32_t>(width_),
           static_cast<std::uint32_t>(height_),
           packing.format,
           0,
           first.row_words,
           second_at,
           second.row_words,
           0};
  intrinsics_ = p.intrinsics;
  T_world_camera_ = p.T_world_camera;
  pending_ = shown_ = true;
}

void PictureStore::follow_lens(const Picture& p) {
  // In picture heights; see passthrough.frag.
  constexpr double glow = 0.1;
  const Intrinsics &was = intrinsics_, &is = p.intrinsics;
  const bool same = width_ == p.width && height_ == p.height && was.fx == is.fx && was.fy == is.fy && was.cx == is.cx &&
                    was.cy == is.cy && was.distortion == is.distortion;
  if (same) return;
  bounds_ = picture_bounds(is, p.width, p.height, glow);
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

void PictureStore::write_set(vk::DescriptorSet set, vk::Buffer bytes) {
  const vk::DescriptorBufferInfo buffer{.buffer = bytes, .range = VK_WHOLE_SIZE};
  const vk::DescriptorImageInfo image{.imageView = image_.view(), .imageLayout = Layout::eGeneral};
  const std::array writes{vk::WriteDescriptorSet{.dstSet = set,
                                                 .dstBinding = 0,
                                                 .descriptorCount = 1,
                                                 .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                 .pBufferInfo = &buffer},
                          vk::WriteDescriptorSet{.dstSet = set,
                                                 .dstBinding = 1,
                                                 .descriptorCount = 1,
                                                 .descriptorType = vk::DescriptorType::eStorageImage,
                                                 .pImageInfo = &image}};
  device_.vk().updateDescriptorSets(writes, {});
}

void PictureStore::record(FrameSlot& slot) {
  record_lens(slot);
  if (!pending_) return;
  const std::uint32_t width = push_[0], height = push_[1];
  if (!image_ || image_.info().width != width || image_.info().height != height) {
    slot.graveyard.bury(std::move(image_));
    // Stored to byte for byte, sampled as the sRGB values that cameras give.
    image_ = Image(device_, {.format = vk::Format::eR8G8B8A8Unorm,
                             .width = width,
                             .height = height,
                             .usage = vk::ImageUsageFlagBits::eStorage | vk::ImageUsageFlagBits::eSampled,
                             .second_format = vk::Format::eR8G8B8A8Srgb});
  }
  write_set(sets_[next_], staging_[next_].handle());
  const auto& commands = slot.commands;
  const Access sample{Stage::eFragmentShader, Reach::eShaderSampledRead};
  const Access store{Stage::eComputeShader, Reach::eShaderStorageWrite};
  image_barrier(commands, image_.handle(), {Layout::eUndefined, Layout::eGeneral}, sample, store);
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets_[next_], {});
  commands.pushConstants<std::uint32_t>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, push_);
  commands.dispatch((width + 63) / 64, (height + 7) / 8, 1);
  image_barrier(commands, image_.handle(), {Layout::eGeneral, Layout::eShaderReadOnlyOptimal}, store, sample);
  next_ = (next_ + 1) % slots;
  pending_ = false;
}

}  // namespace onestroke

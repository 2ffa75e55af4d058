#pragma once

#include "render/device.h"

#include <cstring>
#include <memory>
#include <span>

namespace onestroke {

/// A buffer with its memory. Move-only; frees itself, so it must outlast the GPU's use of it (see Graveyard).
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, std::uint64_t size, vk::BufferUsageFlags usage, MemoryPool::Use use);

  vk::Buffer handle() const { return *buffer_; }
  std::uint64_t size() const { return size_; }
  std::byte* mapped() const { return allocation_.mapped(); }
  explicit operator bool() const { return size_ > 0; }

 private:
  Allocation allocation_;  // outlives the handle below
  vk::raii::Buffer buffer_{nullptr};
  std::uint64_t size_ = 0;
};

/// Of the formats of depth that are in use here.
bool has_stencil(vk::Format format);

struct ImageInfo {
  vk::Format format = vk::Format::eUndefined;
  std::uint32_t width = 0, height = 0, mip_levels = 1, layers = 1;
  bool cube = false;   ///< Six layers are the faces of a cube of directions.
  bool array = false;  ///< Seen as an array even where there is one layer.
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::ImageUsageFlags usage{};
  /// Also seen through a second format (an image that is stored to as UNORM and sampled as sRGB).
  vk::Format second_format = vk::Format::eUndefined;
};

/// A 2D image with its memory and a view of all of it, an array where it has several layers. As Buffer.
class Image {
 public:
  Image() = default;
  Image(Device& device, const ImageInfo& info);

  vk::Image handle() const { return *image_; }
  vk::ImageView view() const { return *view_; }
  /// The view in second_format, for sampling.
  vk::ImageView second_view() const { return *second_view_; }
  const ImageInfo& info() const { return info_; }
  explicit operator bool() const { return info_.width > 0; }

 private:
  Allocation allocation_;  // outlives the handles below
  vk::raii::Image image_{nullptr};
  vk::raii::ImageView view_{nullptr}, second_view_{nullptr};
  ImageInfo info_;
};

/// All of an image's depth without its stencil, an array; for sampling.
vk::raii::ImageView make_depth_view(Device& device, const Image& image);

/// One layer of an image, 2D.
vk::raii::ImageView make_layer_view(Device& device, const Image& image, std::uint32_t layer);

/// Resources that the GPU may still use; emptied when its frame is known to be done.
class Graveyard {
 public:
  void bury(Buffer&& buffer) {
    if (buffer) buffers_.push_back(std::move(buffer));
  }
  void bury(Image&& image) {
    if (image) images_.push_back(std::move(image));
  }
  void bury(std::shared_ptr<void> anything) { others_.push_back(std::move(anything)); }
  void clear() {
    buffers_.clear();
    images_.clear();
    others_.clear();
  }

 private:
  std::vector<std::shared_ptr<void>> others_;
  std::vector<Buffer> buffers_;
  std::vector<Image> images_;
};

/// One side of a barrier.
struct Access {
  vk::PipelineStageFlags2 stage;
  vk::AccessFlags2 access;
};

inline constexpr Access sampled_by_fragments{vk::PipelineStageFlagBits2::eFragmentShader,
                                             vk::AccessFlagBits2::eShaderSampledRead};

struct LayoutChange {
  vk::ImageLayout from, to;
};

void image_barrier(const vk::raii::CommandBuffer& commands, vk::Image image, LayoutChange layout, Access before,
                   Access after, vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor,
                   std::uint32_t first_mip = 0, std::uint32_t mips = VK_REMAINING_MIP_LEVELS);

/// Copies a buffer to an image that fragment shaders sample, before and after: the regions, or its only level.
void fill_image(const vk::raii::CommandBuffer& commands, const Buffer& from, const Image& to,
                std::span<const vk::BufferImageCopy> regions);
void fill_image(const vk::raii::CommandBuffer& commands, const Buffer& from, const Image& to);

}  // namespace onestroke

#pragma once

#include "render/resources.h"

#include <vector>

namespace onestroke {

/// What is on its way to memory of the device alone: staging memory, filled, and where it is to go. Resources may be
/// made on any thread; the commands are recorded later, on the thread that renders.
class Upload {
 public:
  explicit Upload(Device& device) : device_(&device) {}

  /// A buffer of the device alone; holds the bytes once what record() wrote has run.
  Buffer buffer(std::span<const std::byte> bytes, vk::BufferUsageFlags usage);
  /// A texture, ready for sampling then, with mipmaps where info.mip_levels > 1. Bytes are rows without padding.
  Image image(ImageInfo info, std::span<const std::byte> bytes);

  /// Writes the copies. The resources, and this, must live until they have run.
  void record(const vk::raii::CommandBuffer& commands) const;

 private:
  struct BufferCopy {
    Buffer staging;
    vk::Buffer target;
  };
  struct ImageCopy {
    Buffer staging;
    vk::Image target;
    ImageInfo info;
  };

  Device* device_;
  std::vector<BufferCopy> buffers_;
  std::vector<ImageCopy> images_;
};

/// A texture filled now, as Upload::image(). Blocks; for start-up.
Image upload_image(Device& device, const ImageInfo& info, std::span<const std::byte> bytes);

}  // namespace onestroke

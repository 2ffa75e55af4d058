#pragma once

#include "render/pipeline_cache_file.h"
#include "render/vulkan.h"

namespace onestroke {

/// The pipelines that the driver has compiled, kept from one run of the program to the next. Without a folder, or where
/// the folder does not serve, they are kept for this run only; nothing here fails because of a file.
class PipelineCache {
 public:
  /// Takes what the folder holds for this driver. The device outlives this.
  PipelineCache(const vk::raii::Device& device, const vk::PhysicalDeviceProperties& properties,
                const std::filesystem::path& folder);
  PipelineCache(const PipelineCache&) = delete;
  /// Writes what there is now, if it is not what was there before.
  ~PipelineCache();

  const vk::raii::PipelineCache& vk() const { return cache_; }

 private:
  PipelineCacheKey key_;
  std::filesystem::path file_;  // empty: none
  std::vector<std::byte> kept_;
  vk::raii::PipelineCache cache_;
};

}  // namespace onestroke

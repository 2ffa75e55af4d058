#include "render/pipeline_cache.h"

#include <algorithm>

namespace onestroke {

namespace {

PipelineCacheKey key_of(const vk::PhysicalDeviceProperties& properties) {
  PipelineCacheKey key{
      .vendor = properties.vendorID, .device = properties.deviceID, .driver = properties.driverVersion, .uuid = {}};
  std::ranges::copy(properties.pipelineCacheUUID, key.uuid.begin());
  return key;
}

vk::raii::PipelineCache make_cache(const vk::raii::Device& device, std::span<const std::byte> kept) {
  return device.createPipelineCache({.initialDataSize = kept.size(), .pInitialData = kept.data()});
}

}  // namespace

PipelineCache::PipelineCache(const vk::raii::Device& device, const vk::PhysicalDeviceProperties& properties,
                             const std::filesystem::path& folder)
    : key_(key_of(properties)),
      file_(folder.empty() ? folder : folder / pipeline_cache_name(key_)),
      kept_(file_.empty() ? std::vector<std::byte>() : read_pipeline_cache(file_, key_)),
      cache_(make_cache(device, kept_)) {}

PipelineCache::~PipelineCache() {
  if (file_.empty()) return;
  try {
    const auto now = cache_.getData();
    const auto bytes = std::as_bytes(std::span(now));
    if (!std::ranges::equal(bytes, kept_)) write_pipeline_cache(file_, key_, bytes);
  } catch (const std::exception&) {
    // A lost GPU has nothing to tell; the next run compiles anew.
  }
}

}  // namespace onestroke

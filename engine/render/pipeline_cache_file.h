#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace onestroke {

/// What must be the same for one driver to make use of another's compiled pipelines.
struct PipelineCacheKey {
  std::uint32_t vendor = 0, device = 0, driver = 0;
  std::array<std::uint8_t, 16> uuid{};
};

/// "pipelines-00010005-00000000-00000001-766d...33.bin".
std::string pipeline_cache_name(const PipelineCacheKey& key);

/// What was kept in the file for this driver. Empty where the file is missing, cannot be read, was cut short or
/// changed, or belongs to another driver. Throws nothing.
std::vector<std::byte> read_pipeline_cache(const std::filesystem::path& file, const PipelineCacheKey& key) noexcept;

/// Replaces the file in one step, so that no reader ever finds half of it; makes its folder where that is missing.
/// False where that cannot be done, and then the old file stands as it was. Throws nothing.
bool write_pipeline_cache(const std::filesystem::path& file, const PipelineCacheKey& key,
                          std::span<const std::byte> data) noexcept;

}  // namespace onestroke

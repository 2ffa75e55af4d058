#include "render/pipeline_cache_file.h"

#include "core/kept_file.h"

#include <vulkan/vulkan_core.h>

#include <cstdio>
#include <cstring>

namespace onestroke {

namespace {

namespace fs = std::filesystem;

/// Stands before the driver's own bytes: drivers check whose they are, but not whether they are whole.
struct Header {
  std::array<char, 8> magic{'o', 'n', 'e', 's', 'P', 'C', '0', '1'};
  std::uint32_t driver = 0, reserved = 0;
  std::uint64_t size = 0, sum = 0;  // of what follows

  bool operator==(const Header&) const = default;
};
static_assert(sizeof(Header) == 32);

// More than any driver keeps for a dozen pipelines.
constexpr std::uint64_t most_bytes = 64U << 20U;

Header header_of(std::span<const std::byte> data, const PipelineCacheKey& key) {
  Header header;
  header.driver = key.driver;
  header.size = data.size();
  header.sum = sum_of(data);
  return header;
}

/// True where the driver's bytes begin as Vulkan says they do for this driver.
bool belongs_to(std::span<const std::byte> data, const PipelineCacheKey& key) {
  VkPipelineCacheHeaderVersionOne head;
  if (data.size() < sizeof head) return false;
  std::memcpy(&head, data.data(), sizeof head);
  return head.headerSize == sizeof head && head.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         head.vendorID == key.vendor && head.deviceID == key.device &&
         std::memcmp(head.pipelineCacheUUID, key.uuid.data(), key.uuid.size()) == 0;
}

}  // namespace

std::string pipeline_cache_name(const PipelineCacheKey& key) {
  std::array<char, 48> ids{};
  std::snprintf(ids.data(), ids.size(), "pipelines-%08x-%08x-%08x-", key.vendor, key.device, key.driver);
  std::string name = ids.data();
  for (const std::uint8_t byte : key.uuid) {
    std::array<char, 4> hex{};
    std::snprintf(hex.data(), hex.size(), "%02x", byte);
    name += hex.data();
  }
  return name + ".bin";
}

std::vector<std::byte> read_pipeline_cache(const fs::path& file, const PipelineCacheKey& key) noexcept {
  std::vector<std::byte> data = read_kept(file, most_bytes);
  Header header;
  if (data.size() <= sizeof header) return {};
  std::memcpy(&header, data.data(), sizeof header);
  data.erase(data.begin(), data.begin() + sizeof header);
  if (header != header_of(data, key) || !belongs_to(data, key)) return {};
  return data;
}

bool write_pipeline_cache(const fs::path& file, const PipelineCacheKey& key, std::span<const std::byte> data) noexcept {
  const Header header = header_of(data, key);
  if (data.size() + sizeof header > most_bytes) return false;
  return keep_file(file, std::as_bytes(std::span(&header, 1)), data);
}

}  // namespace onestroke

#include "render/pipeline_cache_file.h"

#include <vulkan/vulkan_core.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>

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

/// FNV-1a.
std::uint64_t sum_of(std::span<const std::byte> data) {
  std::uint64_t sum = 0xCBF29CE484222325;
  for (const std::byte b : data) sum = (sum ^ static_cast<std::uint64_t>(b)) * 0x100000001B3;
  return sum;
}

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

std::vector<std::byte> read(const fs::path& file, const PipelineCacheKey& key) {
  // Opening a pipe would wait for somebody to write to it.
  if (!fs::is_regular_file(file)) return {};
  const std::uint64_t size = fs::file_size(file);
  if (size <= sizeof(Header) || size > most_bytes) return {};
  std::ifstream in(file, std::ios::binary);
  Header header;
  std::vector<std::byte> data(size - sizeof header);
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  in.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
  if (!in || header != header_of(data, key) || !belongs_to(data, key)) return {};
  return data;
}

bool write_whole(const fs::path& file, const Header& header, std::span<const std::byte> data) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(&header), sizeof header);
  out.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
  out.close();
  return out.good();
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
  try {
    return read(file, key);
  } catch (const std::exception&) {
    return {};
  }
}

bool write_pipeline_cache(const fs::path& file, const PipelineCacheKey& key, std::span<const std::byte> data) noexcept {
  try {
    if (data.size() + sizeof(Header) > most_bytes) return false;
    fs::create_directories(file.parent_path());
    // Another program may be writing its own at this moment.
    fs::path whole = file;
    whole += "." + std::to_string(std::random_device()()) + ".new";
    std::error_code error;
    if (write_whole(whole, header_of(data, key), data))
      fs::rename(whole, file, error);
    else
      error = std::make_error_code(std::errc::io_error);
    if (!error) return true;
    fs::remove(whole, error);
  } catch (const std::exception&) {
    // The program works as well without.
  }
  return false;
}

}  // namespace onestroke

#include "app/difference_cache.h"

#include "app/cache_folder.h"
#include "core/kept_file.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cstdio>
#include <cstring>
#include <span>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

/// The number in `magic` goes up with every change of what is kept or of how it is found out.
struct Header {
  std::array<char, 8> magic{'o', 'n', 'e', 's', 'D', 'F', '0', '1'};
  std::uint64_t laid_sum = 0, base_sum = 0, laid_count = 0, base_count = 0, alignment = 0;
  std::uint64_t sum = 0;  // of what follows

  bool operator==(const Header&) const = default;
};
static_assert(sizeof(Header) == 64 - 8);

/// Behind the header: these numbers, then the laid model's distances, then the base's.
using Numbers = std::array<double, 16 + 5 + 6 + 3>;
constexpr std::uint64_t head_bytes = sizeof(Header) + sizeof(Numbers);

Header header_of(const DifferenceCache::Key& key, std::span<const std::byte> rest) {
  Header header;
  header.laid_sum = key.laid_sum;
  header.base_sum = key.base_sum;
  header.laid_count = key.laid_count;
  header.base_count = key.base_count;
  header.alignment = static_cast<std::uint64_t>(key.alignment);
  header.sum = sum_of(rest);
  return header;
}

template <typename Take>
void each_number(ModelDifference& d, Take&& take) {
  for (glm::length_t i = 0; i < 16; ++i) take(d.base_from_laid[i / 4][i % 4]);
  DifferenceStatistics& s = d.statistics;
  for (double* number : {&s.mean, &s.rms, &s.p95, &s.most, &s.reach, &s.fit_rms, &s.moved, &s.turned_deg})
    take(*number);
  for (SurfaceMeasures* measures : {&s.laid, &s.base}) {
    take(measures->area);
    take(measures->volume);
    double closed = measures->closed ? 1 : 0;
    take(closed);
    measures->closed = closed != 0;
  }
}

std::vector<std::byte> bytes_of(ModelDifference difference) {
  Numbers numbers{};
  std::size_t next = 0;
  each_number(difference, [&](double number) { numbers[next++] = number; });
  std::vector<std::byte> bytes;
  const auto add = [&bytes](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); };
  add(std::as_bytes(std::span(numbers)));
  add(std::as_bytes(std::span(difference.laid)));
  add(std::as_bytes(std::span(difference.base)));
  return bytes;
}

/// The bytes are as many as they must be.
ModelDifference difference_in(std::span<const std::byte> bytes, const DifferenceCache::Key& key) {
  ModelDifference difference;
  const auto take = [&bytes](void* to, std::size_t size) {
    std::memcpy(to, bytes.data(), size);
    bytes = bytes.subspan(size);
  };
  Numbers numbers;
  take(numbers.data(), sizeof numbers);
  std::size_t next = 0;
  each_number(difference, [&](double& number) { number = numbers[next++]; });
  difference.laid.resize(key.laid_count);
  difference.base.resize(key.base_count);
  take(difference.laid.data(), sizeof(float) * key.laid_count);
  take(difference.base.data(), sizeof(float) * key.base_count);
  return difference;
}

std::optional<ModelDifference> read(const fs::path& file, const DifferenceCache::Key& key) {
  const std::uint64_t size = head_bytes + sizeof(float) * (key.laid_count + key.base_count);
  const std::vector<std::byte> bytes = read_kept(file, size);
  if (bytes.size() != size) return std::nullopt;
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  const auto rest = std::span(bytes).subspan(sizeof header);
  if (header != header_of(key, rest)) return std::nullopt;
  return difference_in(rest, key);
}

std::string name_of(const DifferenceCache::Key& key) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "%016llx-on-%016llx-%s.bin", static_cast<unsigned long long>(key.laid_sum),
                static_cast<unsigned long long>(key.base_sum), key.alignment == Alignment::best_fit ? "fit" : "own");
  return name.data();
}

}  // namespace

DifferenceCache::Key DifferenceCache::key_of(const ComparedModel& laid, const ComparedModel& base,
                                             Alignment alignment) {
  return {.laid_sum = laid.sum,
          .base_sum = base.sum,
          .laid_count = laid.refined.vertices.size(),
          .base_count = base.refined.vertices.size(),
          .alignment = alignment};
}

std::optional<ModelDifference> DifferenceCache::find(const Key& key) const noexcept {
  try {
    for (const fs::path& folder : folders_)
      if (auto found = read(folder / name_of(key), key)) return found;
  } catch (const std::exception&) {
    // The program works as well without.
  }
  return std::nullopt;
}

bool DifferenceCache::keep(const Key& key, const ModelDifference& difference) const noexcept {
  try {
    const std::vector<std::byte> rest = bytes_of(difference);
    const Header header = header_of(key, rest);
    for (const fs::path& folder : folders_)
      if (keep_file(folder / name_of(key), std::as_bytes(std::span(&header, 1)), rest)) return true;
  } catch (const std::exception&) {
    // The program works as well without.
  }
  return false;
}

std::vector<fs::path> difference_folders(const fs::path& catalog_file) {
  std::vector<fs::path> folders{catalog_file};
  folders.back() += ".differences";
  if (const fs::path cache = cache_folder(); !cache.empty()) folders.push_back(cache / "differences");
  return folders;
}

}  // namespace onestroke

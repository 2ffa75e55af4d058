#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace onestroke {

/// A plane of a picture within a file of memory (a dma-buf, as drivers give them).
struct MemoryPlane {
  int descriptor = -1;
  std::size_t offset = 0, length = 0;
};

/// Up to two planes of one buffer, mapped to be read. The mapping keeps the memory, also when the device has gone.
class MappedPlanes {
 public:
  /// Throws std::system_error where a plane cannot be mapped.
  explicit MappedPlanes(std::span<const MemoryPlane> planes);
  ~MappedPlanes();
  MappedPlanes(MappedPlanes&& other) noexcept;
  MappedPlanes& operator=(MappedPlanes&&) = delete;

  std::span<const std::uint8_t> plane(std::size_t index) const { return planes_.at(index); }
  /// What the device wrote is seen by this processor between these two.
  void begin_reading() const noexcept;
  void end_reading() const noexcept;

 private:
  struct Mapping {
    int descriptor = -1;
    std::uint8_t* start = nullptr;
    std::size_t length = 0;
  };

  void synchronise(std::uint64_t flags) const noexcept;
  void unmap() noexcept;

  std::array<Mapping, 2> mappings_{};
  std::array<std::span<const std::uint8_t>, 2> planes_{};
};

}  // namespace onestroke

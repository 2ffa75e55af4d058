#include "camera/mapped_memory.h"

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace onestroke {

MappedPlanes::MappedPlanes(std::span<const MemoryPlane> planes) {
  try {
    for (std::size_t i = 0; i < std::min(planes.size(), planes_.size()); ++i) {
      const MemoryPlane& plane = planes[i];
      const std::size_t length = plane.offset + plane.length;
      Mapping& mapping = mappings_.at(i);
      void* const start = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, plane.descriptor, 0);
      if (start == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mapping a camera's buffer");
      mapping = {.descriptor = ::dup(plane.descriptor), .start = static_cast<std::uint8_t*>(start), .length = length};
      planes_.at(i) = {mapping.start + plane.offset, plane.length};
    }
  } catch (...) {
    unmap();
    throw;
  }
}

MappedPlanes::MappedPlanes(MappedPlanes&& other) noexcept
    : mappings_(std::exchange(other.mappings_, {})), planes_(std::exchange(other.planes_, {})) {}

MappedPlanes::~MappedPlanes() {
  unmap();
}

void MappedPlanes::begin_reading() const noexcept {
  synchronise(DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ);
}

void MappedPlanes::end_reading() const noexcept {
  synchronise(DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ);
}

// Memory that is no dma-buf needs none, and says so.
void MappedPlanes::synchronise(std::uint64_t flags) const noexcept {
  dma_buf_sync sync{flags};
  for (const Mapping& mapping : mappings_)
    if (mapping.start) ::ioctl(mapping.descriptor, DMA_BUF_IOCTL_SYNC, &sync);
}

void MappedPlanes::unmap() noexcept {
  for (const Mapping& mapping : mappings_) {
    if (!mapping.start) continue;
    ::munmap(mapping.start, mapping.length);
    ::close(mapping.descriptor);
  }
}

}  // namespace onestroke

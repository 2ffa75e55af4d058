#include "camera/jpeg_memory.h"

#include <jpeglib.h>

#include <new>
#include <utility>

namespace onestroke {
namespace {

// Of rows and blocks; more than libjpeg-turbo's vector code asks for.
constexpr std::size_t alignment = 64;

constexpr std::size_t aligned(std::size_t size) {
  return (size + alignment - 1) / alignment * alignment;
}

struct Free {
  void operator()(std::byte* block) const { ::operator delete (block, std::align_val_t{alignment}); }
};

/// A table of rows, and the rows behind it.
constexpr std::size_t table_bytes(JDIMENSION rows, std::size_t row_bytes) {
  return aligned(rows * sizeof(void*)) + rows * row_bytes;
}

template <typename Element>
Element** lay_rows(void* memory, JDIMENSION rows, std::size_t row_bytes) {
  auto** const table = static_cast<Element**>(memory);
  std::byte* const first = static_cast<std::byte*>(memory) + aligned(rows * sizeof(void*));
  for (JDIMENSION row = 0; row < rows; ++row) table[row] = reinterpret_cast<Element*>(first + row * row_bytes);
  return table;
}

}  // namespace

struct JpegMemory::Impl {
  jpeg_memory_mgr own{};  // libjpeg's
  std::unique_ptr<std::byte, Free> block;
  std::size_t size = 0, used = 0, wanted = 0;

  static Impl& of(j_common_ptr info) { return *static_cast<Impl*>(info->client_data); }

  /// Null where it is not for the picture, or the block is full.
  void* take(int pool, std::size_t bytes) {
    if (pool != JPOOL_IMAGE) return nullptr;
    const std::size_t whole = aligned(bytes);
    wanted += whole;
    if (!block || size - used < whole) return nullptr;
    return block.get() + std::exchange(used, used + whole);
  }

  void begin_again() {
    used = 0;
    const std::size_t needed = std::exchange(wanted, 0);
    if (needed <= size) return;
    block.reset(static_cast<std::byte*>(::operator new (needed, std::align_val_t{alignment}, std::nothrow)));
    size = block ? needed : 0;
  }

  static void* small(j_common_ptr info, int pool, std::size_t bytes) {
    void* const at = of(info).take(pool, bytes);
    return at ? at : of(info).own.alloc_small(info, pool, bytes);
  }

  static void* large(j_common_ptr info, int pool, std::size_t bytes) {
    void* const at = of(info).take(pool, bytes);
    return at ? at : of(info).own.alloc_large(info, pool, bytes);
  }

  static JSAMPARRAY samples(j_common_ptr info, int pool, JDIMENSION width, JDIMENSION rows) {
    // Vector code may go on to the end of a group behind the last sample.
    const std::size_t row = aligned(width * sizeof(JSAMPLE) + alignment);
    void* const at = of(info).take(pool, table_bytes(rows, row));
    return at ? lay_rows<JSAMPLE>(at, rows, row) : of(info).own.alloc_sarray(info, pool, width, rows);
  }

  static JBLOCKARRAY blocks(j_common_ptr info, int pool, JDIMENSION width, JDIMENSION rows) {
    const std::size_t row = aligned(width * sizeof(JBLOCK));
    void* const at = of(info).take(pool, table_bytes(rows, row));
    return at ? lay_rows<JBLOCK>(at, rows, row) : of(info).own.alloc_barray(info, pool, width, rows);
  }

  static void free_pool(j_common_ptr info, int pool) {
    of(info).own.free_pool(info, pool);
    if (pool == JPOOL_IMAGE) of(info).begin_again();
  }
};

JpegMemory::JpegMemory() : impl_(std::make_unique<Impl>()) {}
JpegMemory::~JpegMemory() = default;

void JpegMemory::attach(jpeg_decompress_struct& decoder) {
  decoder.client_data = impl_.get();
  jpeg_memory_mgr& manager = *decoder.mem;
  impl_->own = manager;
  manager.alloc_small = Impl::small;
  manager.alloc_large = Impl::large;
  manager.alloc_sarray = Impl::samples;
  manager.alloc_barray = Impl::blocks;
  manager.free_pool = Impl::free_pool;
}

}  // namespace onestroke

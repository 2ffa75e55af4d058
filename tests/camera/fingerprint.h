#pragma once

#include <cstdint>
#include <cstring>
#include <span>

namespace onestroke {

/// Tells pictures apart: FNV-1a of 64 bits, over words of 8 bytes so that it is quick where it is emulated. A part of a
/// word at the end counts as filled up with zeros.
inline std::uint64_t fingerprint(std::span<const std::uint8_t> bytes, std::uint64_t so_far = 0xcbf29ce484222325U) {
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = bytes.size() < sizeof word ? bytes.size() : sizeof word;
    std::memcpy(&word, bytes.data(), count);
    so_far = (so_far ^ word) * 0x100000001b3U;
    bytes = bytes.subspan(count);
  }
  return so_far;
}

}  // namespace onestroke

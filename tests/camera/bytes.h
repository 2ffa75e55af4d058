#pragma once

#include <cstdint>
#include <vector>

namespace onestroke::usb {

using u8 = std::uint8_t;
using u16 = std::uint16_t;
using u32 = std::uint32_t;
using Bytes = std::vector<u8>;

/// Appends numbers, of one size each, as USB has them: the lowest byte first.
template <typename... Numbers>
void append(Bytes& out, Numbers... numbers) {
  const auto one = [&out](auto number) {
    for (std::size_t i = 0; i < sizeof number; ++i) out.push_back(static_cast<u8>(number >> (8 * i)));
  };
  (one(numbers), ...);
}

/// Writes a number over bytes that are there.
template <typename Number>
void put(Bytes& out, std::size_t at, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) out.at(at + i) = static_cast<u8>(number >> (8 * i));
}

/// A number of so many bytes; what is not there is zero.
inline u32 number_in(const u8* bytes, std::size_t count) {
  u32 number = 0;
  for (std::size_t i = 0; i < count && i < sizeof number; ++i) number |= static_cast<u32>(bytes[i]) << (8 * i);
  return number;
}

/// Appends a descriptor: its own length and these numbers.
template <typename... Numbers>
void append_descriptor(Bytes& out, Numbers... numbers) {
  out.push_back(static_cast<u8>(1 + (sizeof numbers + ...)));
  append(out, numbers...);
}

}  // namespace onestroke::usb

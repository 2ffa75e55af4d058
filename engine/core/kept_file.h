#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace onestroke {

inline constexpr std::uint64_t no_bytes_sum = 0xCBF29CE484222325;

/// Tells bytes that were damaged or changed from those that were not, not from those that were forged: FNV-1a of 64
/// bits. Goes on from the sum of what stands before.
std::uint64_t sum_of(std::span<const std::byte> data, std::uint64_t before = no_bytes_sum);

/// A regular file's bytes. Empty where there is no such file, it cannot be read or it is larger than `most`. Throws
/// nothing.
std::vector<std::byte> read_kept(const std::filesystem::path& file, std::uint64_t most) noexcept;

/// Puts head and body into the file, in one step, so that no reader ever finds half of it; makes its folder where that
/// is missing. False where that cannot be done, and then the old file stands as it was. Throws nothing.
bool keep_file(const std::filesystem::path& file, std::span<const std::byte> head,
               std::span<const std::byte> body) noexcept;

}  // namespace onestroke

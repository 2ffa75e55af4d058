#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace onestroke {

/// A decoded picture: rgb8, rows of 3 * width bytes.
struct DecodedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Reads a JPEG or PNG file; storage in `out` is used again. Empty where all went well, otherwise what is wrong with
/// the file, for a message. A file that ends early is wrong even where a decoder would fill in the rest. Never throws.
std::string read_picture_file(const std::filesystem::path& file, DecodedPicture& out);

/// The whole file, into storage that is used again; false where it cannot be read.
bool read_whole_file(const std::filesystem::path& file, std::vector<std::uint8_t>& bytes);

/// Names as a person sorts them: runs of digits by their value.
bool natural_less(const std::string& a, const std::string& b);

}  // namespace onestroke

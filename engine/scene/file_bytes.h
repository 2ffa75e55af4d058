#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace onestroke {

using Bytes = std::vector<unsigned char>;

/// False where there is no such regular file, or it cannot be read.
bool read_bytes(const std::filesystem::path& file, Bytes& bytes);

/// A file that a model refers to, where it is in the model's folder or below; nothing where it is not there or where
/// the path leads out of the folder, by links too. Backslashes are taken for slashes, and where the path leads nowhere
/// the bare file name is tried: exporters write the paths of their own machine.
std::optional<std::filesystem::path> file_beside(const std::filesystem::path& folder, std::string path);

}  // namespace onestroke

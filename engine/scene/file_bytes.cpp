#include "scene/file_bytes.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace onestroke {

namespace fs = std::filesystem;

namespace {

bool is_inside(const fs::path& folder, const fs::path& file) {
  std::error_code failed;
  const fs::path home = fs::canonical(folder, failed);
  if (failed) return false;
  const fs::path real = fs::canonical(file, failed);
  if (failed || !fs::is_regular_file(real, failed)) return false;
  return std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first == home.end();
}

}  // namespace

bool read_bytes(const fs::path& file, Bytes& bytes) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream in(file, std::ios::binary);
  const auto size = fs::file_size(file, ignored);
  if (!in || ignored) return false;
  bytes.resize(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes.size() == size;
}

std::optional<fs::path> file_beside(const fs::path& folder, std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.empty() || path.find('\0') != std::string::npos) return std::nullopt;
  const fs::path given(path);
  if (given.is_relative() && is_inside(folder, folder / given)) return folder / given;
  const fs::path bare = folder / given.filename();
  if (given.has_filename() && is_inside(folder, bare)) return bare;
  return std::nullopt;
}

}  // namespace onestroke

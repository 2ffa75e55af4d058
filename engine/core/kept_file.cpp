#include "core/kept_file.h"

#include <fstream>
#include <random>
#include <string>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

void write(std::ofstream& out, std::span<const std::byte> data) {
  out.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
}

bool write_whole(const fs::path& file, std::span<const std::byte> head, std::span<const std::byte> body) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  write(out, head);
  write(out, body);
  out.close();
  return out.good();
}

}  // namespace

std::uint64_t sum_of(std::span<const std::byte> data, std::uint64_t before) {
  std::uint64_t sum = before;
  for (const std::byte b : data) sum = (sum ^ static_cast<std::uint64_t>(b)) * 0x100000001B3;
  return sum;
}

std::vector<std::byte> read_kept(const fs::path& file, std::uint64_t most) noexcept {
  try {
    // Opening a pipe would wait for somebody to write to it.
    if (!fs::is_regular_file(file)) return {};
    const std::uint64_t size = fs::file_size(file);
    if (size > most) return {};
    std::ifstream in(file, std::ios::binary);
    std::vector<std::byte> data(size);
    in.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(size));
    if (in) return data;
  } catch (const std::exception&) {
    // The program works as well without.
  }
  return {};
}

bool keep_file(const fs::path& file, std::span<const std::byte> head, std::span<const std::byte> body) noexcept {
  try {
    fs::create_directories(file.parent_path());
    // Another program may be writing its own at this moment.
    fs::path whole = file;
    whole += "." + std::to_string(std::random_device()()) + ".new";
    std::error_code error;
    if (write_whole(whole, head, body))
      fs::rename(whole, file, error);
    else
      error = std::make_error_code(std::errc::io_error);
    if (!error) return true;
    fs::remove(whole, error);
  } catch (const std::exception&) {
    // The program works as well without.
  }
  return false;
}

}  // namespace onestroke

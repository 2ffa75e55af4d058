#include "scene/stl_layout.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string_view>

namespace onestroke {

namespace {

constexpr std::size_t header_size = 80, head_size = header_size + sizeof(std::uint32_t), triangle_size = 50;

std::uint64_t binary_size(const Bytes& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_size, sizeof count);
  return head_size + std::uint64_t{triangle_size} * count;
}

std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Lower case, without a byte order mark, with plain letters in names.
void make_plain(Bytes& bytes) {
  if (text_of(bytes).starts_with("\xEF\xBB\xBF")) bytes.erase(bytes.begin(), bytes.begin() + 3);
  bytes.erase(bytes.begin(), std::find_if_not(bytes.begin(), bytes.end(), [](int c) { return std::isspace(c) != 0; }));
  std::transform(bytes.begin(), bytes.end(), bytes.begin(),
                 [](int c) { return static_cast<unsigned char>(c < 0x80 ? std::tolower(c) : '_'); });
}

bool starts_as_text(const Bytes& bytes) {
  Bytes start(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 200)));
  make_plain(start);
  return text_of(start).starts_with("solid");
}

void check_text(const std::string& file, const Bytes& bytes) {
  if (std::find(bytes.begin(), bytes.end(), 0) != bytes.end())
    throw Error(file + ": not a whole STL file; export the model again");
  const std::string_view text = text_of(bytes);
  const std::size_t last = text.rfind("endsolid");
  if (last == std::string_view::npos || last < text.rfind("vertex") + 1)
    throw Error(file + ": it is cut short, \"endsolid\" is missing; export the model again");
}

}  // namespace

void prepare_stl(const std::string& file, Bytes& bytes) {
  // "solid" at the start proves nothing: some exporters begin the header of a binary file with it.
  const bool has_head = bytes.size() >= head_size;
  if (!(has_head && binary_size(bytes) == bytes.size()) && starts_as_text(bytes)) {
    make_plain(bytes);
    check_text(file, bytes);
    return;
  }
  if (!has_head) throw Error(file + ": not an STL file; export the model again");
  const std::uint64_t size = binary_size(bytes);
  if (size == head_size) throw Error(file + ": it has no triangles; export the model again");
  if (size > bytes.size()) throw Error(file + ": not a whole STL file, it is cut short; export the model again");
  bytes.resize(size);
}

}  // namespace onestroke

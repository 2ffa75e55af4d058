#include "camera/picture_file.h"

#include "camera/picture_bytes.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>

namespace onestroke {
namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string_view digits_at(const std::string& s, std::size_t from) {
  std::size_t to = from;
  while (to < s.size() && is_digit(s[to])) ++to;
  return std::string_view(s).substr(from, to - from);
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

}  // namespace

bool read_whole_file(const std::filesystem::path& file, std::vector<std::uint8_t>& bytes) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return false;
  const std::streamoff size = in.tellg();
  if (size < 0) return false;
  bytes.resize(static_cast<std::size_t>(size));
  in.seekg(0);
  return static_cast<bool>(in.read(reinterpret_cast<char*>(bytes.data()), size));
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view m = digits_at(a, i), n = digits_at(b, j);
      const std::string_view x = without_zeros(m), y = without_zeros(n);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      i += m.size();
      j += n.size();
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // equal but for leading zeros
}

std::string read_picture_file(const std::filesystem::path& file, DecodedPicture& out) {
  try {
    std::vector<std::uint8_t> bytes;
    if (!read_whole_file(file, bytes)) return "cannot be opened";
    const bool jpeg = bytes.size() > 3 && bytes[0] == 0xFF && bytes[1] == 0xD8;
    if (jpeg && !jpeg_is_complete(bytes)) return "ends in the middle of the picture";
    const cv::Mat bgr = bytes.empty() ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_COLOR);
    if (bgr.empty()) return "is damaged or no picture";
    out.width = bgr.cols;
    out.height = bgr.rows;
    out.rgb.resize(3 * bgr.total());
    swap_to_rgb(bgr.data, bgr.step, bgr.cols, bgr.rows, out.rgb.data());
    return {};
  } catch (const std::exception& e) {
    return std::string("cannot be decoded: ") + e.what();
  }
}

}  // namespace onestroke

#include "scene/text.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace onestroke {

void Text::print(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int wanted = std::vsnprintf(characters_.data(), characters_.size(), format, arguments);
  va_end(arguments);
  length_ = std::min(static_cast<std::size_t>(std::max(wanted, 0)), capacity);
  if (wanted <= static_cast<int>(capacity)) return;
  // Back to the first byte of the character that the cut went through.
  std::size_t start = length_ - 1;
  while (start > 0 && (static_cast<unsigned char>(characters_[start]) & 0xC0U) == 0x80U) --start;
  const auto lead = static_cast<unsigned char>(characters_[start]);
  const std::size_t size = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : lead >= 0xC0U ? 2 : 1;
  if (start + size > length_) length_ = start;
}

}  // namespace onestroke

#include "render/font.h"

#include <algorithm>
#include <array>

namespace onestroke {

namespace {

#include "font_atlas_data.h"

constexpr char32_t replacement = 0xFFFD;

/// How many bytes a character takes, by its first one; 0 where none starts so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

}  // namespace

const FontAtlas& font_atlas() {
  static const FontAtlas atlas{atlas_width,
                               atlas_height,
                               atlas_ascent,
                               atlas_descent,
                               atlas_line,
                               atlas_glyphs,
                               std::as_bytes(std::span(atlas_texels))};
  return atlas;
}

const Glyph& find_glyph(char32_t code) {
  const auto& glyphs = font_atlas().glyphs;
  const auto at = std::lower_bound(glyphs.begin(), glyphs.end(), code,
                                   [](const Glyph& glyph, char32_t wanted) { return glyph.code < wanted; });
  if (at != glyphs.end() && at->code == code) return *at;
  return code == replacement ? glyphs.front() : find_glyph(replacement);
}

char32_t take_character(std::string_view& text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = length_of(byte(0));
  constexpr std::array<unsigned, 5> first_bits{0, 0x7F, 0x1F, 0x0F, 0x07};
  constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  bool sound = length > 0 && length <= text.size();
  char32_t code = sound ? byte(0) & first_bits[length] : 0;
  for (std::size_t i = 1; sound && i < length; ++i) {
    sound = (byte(i) & 0xC0) == 0x80;
    code = code << 6U | (byte(i) & 0x3FU);
  }
  sound = sound && code >= smallest[length] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  text.remove_prefix(sound ? length : 1);
  return sound ? code : replacement;
}

TextSize measure(std::string_view text) {
  TextSize size{0, font_atlas().ascent + font_atlas().descent};
  float x = 0;
  while (!text.empty()) {
    const char32_t code = take_character(text);
    if (code == U'\n') {
      x = 0;
      size.height += font_atlas().line;
    } else {
      x += find_glyph(code).advance;
      size.width = std::max(size.width, x);
    }
  }
  return size;
}

}  // namespace onestroke

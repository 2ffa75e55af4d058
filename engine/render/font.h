#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace onestroke {

/// One character. Lengths in ems, y down from the baseline; texture coordinates of the atlas.
struct Glyph {
  char32_t code;
  float advance;
  float left, top, right, bottom;
  float u0, v0, u1, v1;
};

/// The font, made at build time: an atlas of signed distances (128 on the outline, brighter inside).
struct FontAtlas {
  int width, height;
  float ascent, descent, line;  ///< Ems, all positive; `line` from baseline to baseline.
  std::span<const Glyph> glyphs;
  std::span<const std::byte> texels;  ///< One byte each, rows from the top.
};

const FontAtlas& font_atlas();

/// The glyph for a character; a box where the font has none.
const Glyph& find_glyph(char32_t code);

/// Takes one character off the front of UTF-8 text; U+FFFD for each byte that is not sound. The text is not empty.
char32_t take_character(std::string_view& text);

struct TextSize {
  float width = 0, height = 0;  ///< Ems.
};

TextSize measure(std::string_view text);

/// Calls place(glyph, x, y) for every visible character: the pen's position in ems, y down, from the top left corner
/// of the text to the baseline.
template <typename Place>
void lay_out(std::string_view text, Place&& place) {
  float x = 0, y = font_atlas().ascent;
  while (!text.empty()) {
    const char32_t code = take_character(text);
    if (code == U'\n') {
      x = 0;
      y += font_atlas().line;
      continue;
    }
    const Glyph& glyph = find_glyph(code);
    if (glyph.right > glyph.left) place(glyph, x, y);
    x += glyph.advance;
  }
}

}  // namespace onestroke

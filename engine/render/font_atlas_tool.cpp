// Runs at build time: font_atlas_tool FONT.ttf OUT.h writes the glyph atlas as C++ for font.cpp.
#include "core/error.h"
#include "shaders/shared.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr float em_texels = 44;
constexpr int spread = static_cast<int>(ATLAS_SPREAD);
constexpr unsigned char outline = 128;
constexpr int width = 1024;

/// What labels may say: Latin, Greek, and the signs that measurements need. Each range with its last character.
constexpr struct {
  char32_t first, last;
} ranges[]{{0x20, 0x7E},     {0xA0, 0x17F},    {0x391, 0x3C9},   {0x2010, 0x2015}, {0x2018, 0x201E}, {0x2022, 0x2022},
           {0x2026, 0x2026}, {0x2030, 0x2033}, {0x20AC, 0x20AC}, {0x2190, 0x2195}, {0x21BA, 0x21BB}, {0x2206, 0x2206},
           {0x2212, 0x2212}, {0x221E, 0x221E}, {0x2248, 0x2248}, {0x2260, 0x2265}, {0x2300, 0x2300}, {0x25A0, 0x25A1},
           {0x25B2, 0x25B2}, {0x25B6, 0x25B6}, {0x25BC, 0x25BC}, {0x25C0, 0x25C0}, {0x25CB, 0x25CF}, {0x2713, 0x2713},
           {0x2717, 0x2717}, {0xFFFD, 0xFFFD}};

struct Free {
  void operator()(unsigned char* bitmap) const { stbtt_FreeSDF(bitmap, nullptr); }
};

struct Drawn {
  char32_t code = 0;
  float advance = 0;
  int w = 0, h = 0, dx = 0, dy = 0;  // bitmap and its place from the pen, texels
  int x = 0, y = 0;                  // place in the atlas
  std::unique_ptr<unsigned char, Free> bitmap;
};

std::vector<unsigned char> read_file(const char* path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw onestroke::Error(std::string("cannot read ") + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<Drawn> draw_glyphs(const stbtt_fontinfo& font, float scale) {
  std::vector<Drawn> glyphs;
  for (const auto& range : ranges)
    for (char32_t code = range.first; code <= range.last; ++code) {
      const int index = stbtt_FindGlyphIndex(&font, static_cast<int>(code));
      if (index == 0) continue;
      Drawn g;
      g.code = code;
      int advance = 0, bearing = 0;
      stbtt_GetGlyphHMetrics(&font, index, &advance, &bearing);
      g.advance = static_cast<float>(advance) * scale / em_texels;
      g.bitmap.reset(stbtt_GetGlyphSDF(&font, scale, index, spread, outline, static_cast<float>(outline) / spread, &g.w,
                                       &g.h, &g.dx, &g.dy));
      glyphs.push_back(std::move(g));
    }
  return glyphs;
}

/// Shelves: tallest first, left to right. Returns the height that they take.
int place(std::vector<Drawn>& glyphs) {
  std::vector<Drawn*> order;
  for (auto& g : glyphs)
    if (g.bitmap) order.push_back(&g);
  std::stable_sort(order.begin(), order.end(), [](const Drawn* a, const Drawn* b) { return a->h > b->h; });
  int x = 0, y = 0, shelf = 0;
  for (Drawn* g : order) {
    if (x + g->w > width) {
      y += shelf;
      x = shelf = 0;
    }
    g->x = x;
    g->y = y;
    x += g->w + 1;
    shelf = std::max(shelf, g->h + 1);
  }
  return (y + shelf + 3) / 4 * 4;
}

void write_texels(std::ostream& out, const std::vector<Drawn>& glyphs, int height) {
  std::vector<unsigned char> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const auto& g : glyphs)
    for (int row = 0; g.bitmap && row < g.h; ++row)
      std::copy_n(g.bitmap.get() + row * g.w, g.w, texels.data() + (g.y + row) * width + g.x);
  out << "const unsigned char atlas_texels[] = {\n";
  for (std::size_t i = 0; i < texels.size(); ++i) out << static_cast<int>(texels[i]) << (i % 64 == 63 ? ",\n" : ",");
  out << "};\n";
}

void write(std::ostream& out, const stbtt_fontinfo& font, float scale, const std::vector<Drawn>& glyphs, int height) {
  int ascent = 0, descent = 0, gap = 0;
  stbtt_GetFontVMetrics(&font, &ascent, &descent, &gap);
  const float em = scale / em_texels;
  out << std::showpoint << "constexpr int atlas_width = " << width << ", atlas_height = " << height << ";\n"
      << "constexpr float atlas_ascent = " << static_cast<float>(ascent) * em
      << "F, atlas_descent = " << static_cast<float>(-descent) * em
      << "F, atlas_line = " << static_cast<float>(ascent - descent + gap) * em << "F;\n"
      << "const Glyph atlas_glyphs[] = {\n";
  for (const auto& g : glyphs) {
    out << "{" << static_cast<unsigned>(g.code) << "," << g.advance << "F";
    for (const int at : {g.dx, g.dy, g.dx + g.w, g.dy + g.h}) out << "," << static_cast<float>(at) / em_texels << "F";
    out << "," << static_cast<float>(g.x) / width << "F," << static_cast<float>(g.y) / static_cast<float>(height)
        << "F," << static_cast<float>(g.x + g.w) / width << "F,"
        << static_cast<float>(g.y + g.h) / static_cast<float>(height) << "F},\n";
  }
  out << "};\n";
  write_texels(out, glyphs, height);
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) throw onestroke::Error("usage: font_atlas_tool FONT.ttf OUT.h");
  const auto bytes = read_file(arguments[1]);
  stbtt_fontinfo font;
  if (!stbtt_InitFont(&font, bytes.data(), 0)) throw onestroke::Error(std::string(arguments[1]) + " is not a font");
  const float scale = stbtt_ScaleForMappingEmToPixels(&font, em_texels);
  auto glyphs = draw_glyphs(font, scale);
  const int height = place(glyphs);
  std::ofstream out(arguments[2]);
  write(out, font, scale, glyphs, height);
  out.close();
  if (!out) throw onestroke::Error(std::string("cannot write ") + arguments[2]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "font_atlas_tool: %s\n", error.what());
  return 1;
}

#include "render/gui.h"

#include "render/font.h"

#include <imgui.h>

#include <new>

namespace onestroke {

namespace {

// Of the font as Dear ImGui knows it; every size is made from this one.
constexpr float em_px = 32;

/// The middle of a patch of the atlas that lies so deep inside a glyph that all of it is covered.
ImVec2 find_solid(const FontAtlas& atlas) {
  const auto solid = [&](int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (atlas.texels[static_cast<std::size_t>((y + dy) * atlas.width + x + dx)] != std::byte{255}) return false;
    return true;
  };
  for (int y = 1; y + 1 < atlas.height; ++y)
    for (int x = 1; x + 1 < atlas.width; ++x)
      if (solid(x, y))
        return {(static_cast<float>(x) + 0.5F) / static_cast<float>(atlas.width),
                (static_cast<float>(y) + 0.5F) / static_cast<float>(atlas.height)};
  return {};
}

/// The labels' font: Dear ImGui builds none of its own.
std::unique_ptr<ImFontAtlas> make_atlas() {
  const FontAtlas& font = font_atlas();
  auto atlas = std::make_unique<ImFontAtlas>();
  atlas->TexWidth = font.width;
  atlas->TexHeight = font.height;
  atlas->TexUvScale = {1 / static_cast<float>(font.width), 1 / static_cast<float>(font.height)};
  atlas->TexUvWhitePixel = find_solid(font);
  // The atlas ends its fonts with its own delete.
  ImFont* made = IM_NEW(ImFont)();
  made->ContainerAtlas = atlas.get();
  made->FontSize = (font.ascent + font.descent) * em_px;
  made->Ascent = font.ascent * em_px;
  made->Descent = -font.descent * em_px;
  for (const Glyph& g : font.glyphs)
    made->AddGlyph(nullptr, static_cast<ImWchar>(g.code), g.left * em_px, (font.ascent + g.top) * em_px,
                   g.right * em_px, (font.ascent + g.bottom) * em_px, g.u0, g.v0, g.u1, g.v1, g.advance * em_px);
  made->BuildLookupTable();
  atlas->Fonts.push_back(made);
  atlas->TexReady = true;
  return atlas;
}

void set_style(ImGuiStyle& style, float em) {
  style.AntiAliasedLinesUseTex = false;
  style.WindowBorderSize = 0;
  style.WindowRounding = 0.36F * em;
  style.WindowMinSize = {1, 1};
}

}  // namespace

Gui::Gui() {
  // As the program's own, so that who counts allocations counts these.
  ImGui::SetAllocatorFunctions([](std::size_t bytes, void*) { return ::operator new(bytes); },
                               [](void* memory, void*) { ::operator delete(memory); });
  atlas_ = make_atlas();
  context_ = ImGui::CreateContext(atlas_.get());
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = io.LogFilename = nullptr;
  // Memory is kept for ever; what the manual says of -1 is the other way round.
  io.ConfigMemoryCompactTimer = 1e30F;
  // Nothing moves by itself, so any step will do.
  io.DeltaTime = 1.0F / 60;
}

Gui::~Gui() {
  ImGui::DestroyContext(context_);
  atlas_->Locked = false;
}

void Gui::begin(int width, int height, double text_px) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.FontGlobalScale = static_cast<float>(text_px) / em_px;
  set_style(ImGui::GetStyle(), static_cast<float>(text_px));
  ImGui::NewFrame();
}

const ImDrawData& Gui::end() {
  ImGui::SetCurrentContext(context_);
  ImGui::Render();
  return *ImGui::GetDrawData();
}

}  // namespace onestroke

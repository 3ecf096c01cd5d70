#include "workbench/gui/theme/theme.h"

#include <imgui_freetype.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace tangent {

namespace {

ImU32 hex(std::uint32_t rrggbb, float alpha = 1.0f) { return packed(rgb_hex(rrggbb, alpha)); }

ThemeColours make_colours(Theme theme) {
  const Palette& p = palette(theme);
  ThemeColours c{};
  const bool dark = is_dark(theme);
  c.window = dark ? hex(0x121417) : hex(0xDDE1E6);
  c.panel = packed(p.panel);
  c.panel_header = dark ? hex(0x23272D) : hex(0xE6E9ED);
  c.field = dark ? hex(0x111316) : hex(0xFFFFFF);
  c.plot = dark ? hex(0x15181C) : hex(0xFCFCFD);
  c.grid = dark ? hex(0xFFFFFF, 0.105f) : hex(0x000000, 0.115f);
  c.grid_minor = dark ? hex(0xFFFFFF, 0.04f) : hex(0x000000, 0.045f);
  c.border = dark ? hex(0x32373E) : hex(0xC3C9D0);
  c.text = packed(p.text);
  c.text_dim = packed(p.text_dim);
  c.text_faint = dark ? hex(0x8A939E) : hex(0x5B646D);
  c.accent = packed(p.accent);
  c.accent_soft = packed(with_alpha(p.accent, dark ? 0.26f : 0.20f));
  c.accent_fill = packed(mix(p.panel, p.accent, dark ? 0.36f : 0.26f));
  c.good = packed(p.good);
  c.warning = packed(p.warning);
  c.bad = packed(p.bad);
  c.on_bad = dark ? packed(p.panel) : hex(0xFFFFFF);
  c.stop = hex(0xC23B00);
  c.stop_hovered = hex(0xAA3300);
  return c;
}

ImVec4 unpack(ImU32 c) { return ImGui::ColorConvertU32ToFloat4(c); }

ImVec4 lighter(ImU32 c, float by) {
  ImVec4 v = unpack(c);
  v.x = std::clamp(v.x + by, 0.0f, 1.0f);
  v.y = std::clamp(v.y + by, 0.0f, 1.0f);
  v.z = std::clamp(v.z + by, 0.0f, 1.0f);
  return v;
}

void set_lengths(ImGuiStyle& style) {
  style.WindowPadding = {10, 8};
  style.FramePadding = {7, 3};
  style.ItemSpacing = {7, 5};
  style.ItemInnerSpacing = {5, 4};
  style.CellPadding = {6, 2};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowRounding = 0;
  style.ChildRounding = 0;
  style.FrameRounding = 3;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 3;
  style.TabRounding = 3;
  style.AntiAliasedLinesUseTex = false;  // the atlas is read by nearest pixel, which its lines are not made for
}

void set_colours(ImGuiStyle& style, Theme theme) {
  const ThemeColours& c = theme_colours(theme);
  const float step = is_dark(theme) ? 0.05f : -0.05f;
  ImVec4 accent_half = unpack(c.accent);
  accent_half.w = 0.45f;
  ImVec4* to = style.Colors;
  if (is_dark(theme))
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  to[ImGuiCol_Text] = unpack(c.text);
  to[ImGuiCol_TextDisabled] = unpack(c.text_dim);
  to[ImGuiCol_WindowBg] = unpack(c.panel);
  to[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  to[ImGuiCol_PopupBg] = lighter(c.panel, is_dark(theme) ? 0.03f : 0.02f);
  to[ImGuiCol_Border] = unpack(c.border);
  to[ImGuiCol_FrameBg] = unpack(c.field);
  to[ImGuiCol_FrameBgHovered] = lighter(c.field, step);
  to[ImGuiCol_FrameBgActive] = lighter(c.field, 1.5f * step);
  to[ImGuiCol_MenuBarBg] = unpack(c.panel);
  to[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  to[ImGuiCol_ScrollbarGrab] = unpack(c.border);
  to[ImGuiCol_CheckMark] = unpack(c.accent);
  to[ImGuiCol_SliderGrab] = unpack(c.accent);
  to[ImGuiCol_SliderGrabActive] = unpack(c.accent);
  to[ImGuiCol_Button] = lighter(c.panel_header, 0.6f * step);
  to[ImGuiCol_ButtonHovered] = lighter(c.panel_header, 1.6f * step);
  to[ImGuiCol_ButtonActive] = accent_half;
  to[ImGuiCol_Header] = unpack(c.accent_soft);
  to[ImGuiCol_HeaderHovered] = unpack(c.accent_soft);
  to[ImGuiCol_HeaderActive] = accent_half;
  to[ImGuiCol_Separator] = unpack(c.border);
  to[ImGuiCol_TextSelectedBg] = accent_half;
  to[ImGuiCol_NavHighlight] = unpack(c.accent);
  to[ImGuiCol_TableHeaderBg] = unpack(c.panel_header);
  to[ImGuiCol_TableBorderStrong] = unpack(c.border);
  to[ImGuiCol_TableBorderLight] = unpack(c.grid);
  to[ImGuiCol_TableRowBg] = {0, 0, 0, 0};
  to[ImGuiCol_TableRowBgAlt] = unpack(c.grid_minor);
}

struct FontChoice {
  const char* path;
  const char* package;
};
constexpr FontChoice kInter{"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "fonts-inter"};
constexpr FontChoice kInterStrong{"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf", "fonts-inter"};
constexpr FontChoice kMono{"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf",
                           "fonts-jetbrains-mono"};

/// Latin, Greek (mu), the few arrows and signs the labels use.
const ImWchar* glyph_ranges() {
  static const ImWchar ranges[] = {0x0020, 0x00FF, 0x0391, 0x03C9, 0x2010, 0x2026, 0x2070, 0x209C, 0x2190,
                                   0x2193, 0x2202, 0x2207, 0x2212, 0x2212, 0x2248, 0x2265, 0};
  return ranges;
}

/// FreeType reads Inter's CFF outlines and hints small sizes; light hinting keeps the letters' shapes.
ImFontAtlas& cleared_atlas() {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  return atlas;
}

ImFont* add_font(const FontChoice& choice, float pixels, std::vector<std::string>& missing) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = config.OversampleV = 1;
  config.PixelSnapH = true;
  std::error_code ignored;
  if (std::filesystem::exists(choice.path, ignored)) {
    if (ImFont* font = atlas.AddFontFromFileTTF(choice.path, std::round(pixels), &config, glyph_ranges())) return font;
  }
  const std::string line = std::string("font ") + choice.path + " can't be read; install the package " + choice.package;
  if (std::find(missing.begin(), missing.end(), line) == missing.end()) missing.push_back(line);
  ImFontConfig fallback;
  fallback.SizePixels = std::round(pixels);
  return atlas.AddFontDefault(&fallback);
}

}  // namespace

const ThemeColours& theme_colours(Theme theme) {
  static const std::array<ThemeColours, kThemeCount> all = [] {
    std::array<ThemeColours, kThemeCount> out{};
    for (std::size_t i = 0; i < kThemeCount; ++i) out[i] = make_colours(static_cast<Theme>(i));
    return out;
  }();
  return all[static_cast<std::size_t>(theme)];
}

void apply_theme(Theme theme, float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_lengths(style);
  set_colours(style, theme);
  style.ScaleAllSizes(scale);
}

ThemeFonts load_fonts(float scale, std::vector<std::string>& missing) {
  ImFontAtlas& atlas = cleared_atlas();
  ThemeFonts fonts;
  fonts.text = add_font(kInter, 14.0f * scale, missing);
  fonts.strong = add_font(kInterStrong, 14.0f * scale, missing);
  fonts.small = add_font(kInter, 12.0f * scale, missing);
  fonts.number = add_font(kMono, 13.0f * scale, missing);
  fonts.small_number = add_font(kMono, 11.5f * scale, missing);
  atlas.Build();
  ImGui::GetIO().FontDefault = fonts.text;
  return fonts;
}

LargeFonts load_large_fonts(float width_px, float height_px, std::vector<std::string>& missing) {
  ImFontAtlas& atlas = cleared_atlas();
  const float unit = std::clamp(std::min(height_px, 0.6f * width_px), 240.0f, 4320.0f);
  LargeFonts fonts;
  fonts.prompt = add_font(kInterStrong, 0.068f * unit, missing);
  fonts.key = add_font(kInterStrong, 0.05f * unit, missing);
  fonts.caption = add_font(kInter, 0.033f * unit, missing);
  atlas.Build();
  ImGui::GetIO().FontDefault = fonts.caption;
  return fonts;
}

}  // namespace tangent

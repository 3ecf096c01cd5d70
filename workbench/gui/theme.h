// Look of the window: colours, spacing and fonts. One accent colour; text in Inter, numbers in JetBrains
// Mono, both from Debian's packages (fonts-inter, fonts-jetbrains-mono).
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tangent {

enum class Theme : std::uint8_t { dark, light };

/// Colours that ImGui's own table has no room for. Packed as ImGui does (ABGR).
struct ThemeColours {
  ImU32 window, panel, panel_header, view, plot, grid, grid_strong, border;
  ImU32 text, text_dim, text_faint, accent, accent_soft, good, warning, bad;
};

/// Fonts of the present atlas. All non-null once `load_fonts` ran.
struct ThemeFonts {
  ImFont* text = nullptr;     ///< Inter
  ImFont* strong = nullptr;   ///< Inter SemiBold, section titles
  ImFont* small = nullptr;    ///< Inter, captions
  ImFont* number = nullptr;   ///< JetBrains Mono
  ImFont* small_number = nullptr;  ///< JetBrains Mono, axis labels
};

const ThemeColours& theme_colours(Theme theme);

/// Style and colours of the present ImGui context, lengths times `scale`.
void apply_theme(Theme theme, float scale);

/// Replaces the atlas of the present context by our fonts at `scale`. A font file that isn't there is
/// replaced by ImGui's own font; `missing` then gets one line naming the package.
ThemeFonts load_fonts(float scale, std::vector<std::string>& missing);

}  // namespace tangent

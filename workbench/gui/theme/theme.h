// Look of the window: colours, spacing and fonts. One accent colour; text in Inter, numbers in JetBrains
// Mono, both from Debian's packages (fonts-inter, fonts-jetbrains-mono). Colours of quantities: palette.h.
#pragma once

#include "workbench/gui/theme/palette.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace tangent {

/// Colours of the interface, other than those of quantities. Packed as ImU32.
struct ThemeColours {
  ImU32 window;        ///< between the panels
  ImU32 panel;         ///< behind widgets
  ImU32 panel_header;  ///< section titles
  ImU32 field;         ///< type-in boxes, slider grooves
  ImU32 plot;          ///< behind curves
  ImU32 grid, grid_minor;
  ImU32 border;
  ImU32 text, text_dim, text_faint;
  ImU32 accent, accent_soft;  ///< soft: translucent, fills behind text
  ImU32 accent_fill;          ///< opaque equivalent on a panel: buttons that are on
  ImU32 good, warning, bad;
  ImU32 on_bad;              ///< text on `bad`
  ImU32 stop, stop_hovered;  ///< behind white text
};

/// Fonts of the current atlas. All non-null after `load_fonts`.
struct ThemeFonts {
  ImFont* text = nullptr;          ///< Inter
  ImFont* strong = nullptr;        ///< Inter SemiBold: section titles
  ImFont* small = nullptr;         ///< Inter: captions
  ImFont* number = nullptr;        ///< JetBrains Mono
  ImFont* small_number = nullptr;  ///< JetBrains Mono: axis labels
};

const ThemeColours& theme_colours(Theme theme);

/// Sets style and colours of the current ImGui context, lengths times `scale`.
void apply_theme(Theme theme, float scale);

/// Replaces the atlas of the current context by our fonts at `scale`. A missing font file is replaced by ImGui's
/// default font, and `missing` gets a line naming the package.
ThemeFonts load_fonts(float scale, std::vector<std::string>& missing);

/// Fonts of a screen that is read from afar, in place of those above.
struct LargeFonts {
  ImFont* prompt = nullptr;   ///< Inter SemiBold
  ImFont* key = nullptr;      ///< Inter SemiBold
  ImFont* caption = nullptr;  ///< Inter
};
/// Replaces the atlas of the current context, for a screen of this size. As load_fonts otherwise.
LargeFonts load_large_fonts(float width_px, float height_px, std::vector<std::string>& missing);

inline ImU32 colour(const Rgba& c) { return packed(c); }
inline ImU32 colour(const Rgba& c, float alpha) { return packed(with_alpha(c, alpha)); }

}  // namespace tangent

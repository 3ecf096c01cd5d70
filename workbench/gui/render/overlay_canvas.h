// Drawing helpers of the overlay: text legible on any background, and sizes relative to the font.
#pragma once

#include "workbench/gui/theme/palette.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tangent {

struct OverlayCanvas {
  ImDrawList& list;
  ImVec2 top_left, size;  ///< of the picture
  const Palette& colours;
  ImFont* text_font;  ///< fonts at their native size: scaled text blurs
  ImFont* number_font;
  float em;  ///< unit of lengths: the height of the window's text, points

  ImU32 ink(Rgba c, float alpha = 1.0f) const { return packed(with_alpha(c, alpha * c.a)); }

  static ImVec2 text_size(const ImFont* font, const std::string& text) {
    return font->CalcTextSizeA(font->FontSize, 1e6f, 0.0f, text.c_str());
  }
  void text(const ImFont* font, ImVec2 at, Rgba colour, const std::string& words) const {
    list.AddText(font, font->FontSize, {std::round(at.x), std::round(at.y)}, ink(colour), words.c_str());
  }
  /// With a soft halo in the background's colour.
  void haloed(const ImFont* font, ImVec2 at, Rgba colour, const std::string& words) const {
    const Rgba halo = with_alpha(colours.background_bottom, 0.5f);
    const float reach = std::max(1.0f, std::round(0.09f * font->FontSize));
    for (const ImVec2 d : {ImVec2(-1, -1), ImVec2(1, -1), ImVec2(-1, 1), ImVec2(1, 1), ImVec2(-1, 0), ImVec2(1, 0),
                           ImVec2(0, -1), ImVec2(0, 1)}) {
      text(font, {at.x + d.x * reach, at.y + d.y * reach}, halo, words);
    }
    text(font, at, colour, words);
  }
  void card(ImVec2 min, ImVec2 max) const {
    list.AddRectFilled(min, max, ink(colours.panel, 0.78f), 0.35f * em);
    list.AddRect(min, max, ink(colours.text_dim, 0.25f), 0.35f * em);
  }
};

inline constexpr float kInsetWidth = 14.0f, kInsetHeight = 8.9f;  ///< em

/// Fingerpad seen from the side with the roller where it is; its card's lower right corner at `corner`.
void draw_cld_inset(const OverlayCanvas& canvas, ImVec2 corner, double travel_m, const double* commanded_m,
                    const double* measured_m);

}  // namespace tangent

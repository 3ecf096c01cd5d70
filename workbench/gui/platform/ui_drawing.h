// Draws the window that ImGui has built into the bound framebuffer, or finds that it is the one already there.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace tangent {

/// Nearest pixel for text and fills: a software GL reads one texel instead of four. All of them lie on whole pixels.
void use_nearest_pixels(unsigned font_texture);
/// GL's name of the atlas of the current ImGui context.
unsigned font_texture();

class UiDrawing {
 public:
  /// Whether the draw data differs from that of the last call: then it has to be drawn. `picture_version`: of the
  /// textures in it besides the font's.
  bool changed(const ImDrawData& data, std::uint64_t picture_version);
  /// The next one is to be drawn whatever it is: the window was uncovered, or what was drawn is lost.
  void forget() { known_ = false; }
  /// Clears to `ground` and draws.
  static void draw(ImDrawData& data, const ImVec4& ground);

 private:
  std::uint64_t seen_ = 0;
  bool known_ = false;
};

}  // namespace tangent

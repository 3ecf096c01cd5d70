// Colours that can be read and told apart: contrast of text after WCAG 2.1, and what eyes without one kind of cones
// see, after Machado, Oliveira & Fernandes, "A Physiologically-based Model for Simulation of Color Vision Deficiency",
// IEEE TVCG 15(6), 2009: their matrices of severity 1.0, which apply to linear RGB.
#include "workbench/gui/theme/theme.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace tangent;

namespace {

using Linear = std::array<double, 3>;
using Matrix = std::array<Linear, 3>;

constexpr Matrix kProtan{
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix kDeutan{
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
constexpr Matrix kTritan{
    {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

Linear linear(const Rgba& c) {
  const auto one = [](float v) {
    const double x = static_cast<double>(v);
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  return {one(c.r), one(c.g), one(c.b)};
}

Linear seen_through(const Matrix& m, const Linear& v) {
  Linear out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::clamp(m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2], 0.0, 1.0);
  return out;
}

Linear seen(const Rgba& c, Vision vision) {
  const Linear l = linear(c);
  switch (vision) {
    case Vision::protan:
      return seen_through(kProtan, l);
    case Vision::deutan:
      return seen_through(kDeutan, l);
    case Vision::tritan:
      return seen_through(kTritan, l);
    default:
      return l;
  }
}

/// CIE 1976 L*a*b*, D65.
Linear lab(const Linear& l) {
  const double x = 0.4124564 * l[0] + 0.3575761 * l[1] + 0.1804375 * l[2],
               y = 0.2126729 * l[0] + 0.7151522 * l[1] + 0.0721750 * l[2],
               z = 0.0193339 * l[0] + 0.1191920 * l[1] + 0.9503041 * l[2];
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : t * 24389.0 / 27.0 / 116.0 + 16.0 / 116.0;
  };
  const double fx = f(x / 0.95047), fy = f(y), fz = f(z / 1.08883);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

double difference(const Rgba& a, const Rgba& b, Vision vision) {
  const Linear p = lab(seen(a, vision)), q = lab(seen(b, vision));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

double luminance(const Rgba& c) {
  const Linear l = linear(c);
  return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2];
}
double contrast(const Rgba& a, const Rgba& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

Rgba colour_of(ImU32 c) {
  const ImVec4 v = ImGui::ColorConvertU32ToFloat4(c);
  return {v.x, v.y, v.z, v.w};
}

struct Named {
  const char* name;
  Rgba colour;
};

/// Colours that stand beside one another, told apart by nothing else, or read fastest so.
std::vector<std::vector<Named>> groups(const Palette& p) {
  return {
      {{"force x", p.force_x}, {"force y", p.force_y}, {"force z", p.force_z}, {"force", p.force_magnitude}},
      {{"display commanded", p.cld_commanded}, {"display measured", p.cld_measured}},
      {{"good", p.good}, {"warning", p.warning}, {"bad", p.bad}},
      {{"crease", p.crease}, {"boundary", p.boundary}},
      {{"contact", p.contact}, {"normal", p.normal}, {"penetration", p.penetration}, {"control net", p.control_net}}};
}

double least_difference(Theme theme, Vision vision) {
  double least = 1e9;
  for (const auto& group : groups(palette(theme)))
    for (const Named& a : group)
      for (const Named& b : group)
        if (&a < &b) least = std::min(least, difference(a.colour, b.colour, vision));
  return least;
}

}  // namespace

TEST_CASE("the matrices keep grey grey, and confuse what such an eye confuses") {
  for (const Vision vision : {Vision::protan, Vision::deutan, Vision::tritan}) {
    const Linear grey = seen(rgb_hex(0x808080), vision);
    CHECK(std::max({grey[0], grey[1], grey[2]}) - std::min({grey[0], grey[1], grey[2]}) < 1e-3);
  }
  // Red and green of equal lightness, blue and green.
  CHECK(difference(rgb_hex(0xC07000), rgb_hex(0x7F8F00), Vision::deutan) <
        0.5 * difference(rgb_hex(0xC07000), rgb_hex(0x7F8F00), Vision::common));
  CHECK(difference(rgb_hex(0x0080C0), rgb_hex(0x008C80), Vision::tritan) <
        0.5 * difference(rgb_hex(0x0080C0), rgb_hex(0x008C80), Vision::common));
}

TEST_CASE("every theme's colours are told apart by the eye that it is for, as well as common ones at their worst") {
  for (std::size_t i = 0; i < kThemeCount; ++i) {
    const auto theme = static_cast<Theme>(i);
    const Vision vision = vision_of(theme);
    for (const auto& group : groups(palette(theme))) {
      for (const Named& a : group) {
        for (const Named& b : group) {
          if (&a >= &b) continue;
          INFO("theme ", i, ": ", a.name, " and ", b.name);
          CHECK(difference(a.colour, b.colour, vision) >= 25.0);
        }
      }
    }
  }
  // What they are for: the common colours are not enough.
  for (const bool dark : {true, false})
    for (const Vision vision : {Vision::protan, Vision::deutan, Vision::tritan})
      CHECK(least_difference(theme_of(dark, Vision::common), vision) < 25.0);
}

TEST_CASE("text has a contrast of at least 4.5 to 1 on every ground that it is written on, in all themes") {
  for (std::size_t i = 0; i < kThemeCount; ++i) {
    const ThemeColours& c = theme_colours(static_cast<Theme>(i));
    const std::array<std::pair<const char*, ImU32>, 7> inks{{{"text", c.text},
                                                             {"dim", c.text_dim},
                                                             {"faint", c.text_faint},
                                                             {"accent", c.accent},
                                                             {"good", c.good},
                                                             {"warning", c.warning},
                                                             {"bad", c.bad}}};
    const std::array<std::pair<const char*, ImU32>, 5> grounds{
        {{"window", c.window}, {"panel", c.panel}, {"header", c.panel_header}, {"field", c.field}, {"plot", c.plot}}};
    for (const auto& [ink_name, ink] : inks) {
      for (const auto& [ground_name, ground] : grounds) {
        INFO("theme ", i, ": ", ink_name, " on ", ground_name);
        CHECK(contrast(colour_of(ink), colour_of(ground)) >= 4.5);
      }
    }
    ImGui::CreateContext();
    apply_theme(static_cast<Theme>(i), 1.0f);
    const ImVec4* colours = ImGui::GetStyle().Colors;
    for (const ImGuiCol ground : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_PopupBg, ImGuiCol_FrameBg}) {
      const ImVec4 g = colours[ground];
      INFO("theme ", i, ": text on ", ImGui::GetStyleColorName(ground));
      CHECK(contrast(colour_of(c.text), {g.x, g.y, g.z, 1.0f}) >= 4.5);
    }
    ImGui::DestroyContext();
    CHECK(contrast(colour_of(c.text), colour_of(c.accent_fill)) >= 4.5);
    CHECK(contrast(colour_of(c.on_bad), colour_of(c.bad)) >= 4.5);
    for (const ImU32 stop : {c.stop, c.stop_hovered}) CHECK(contrast(rgb_hex(0xFFFFFF), colour_of(stop)) >= 4.5);
  }
}

TEST_CASE("curves and what is drawn on the mesh have a contrast of at least 3 to 1 on plots, in the dark themes") {
  for (std::size_t i = 0; i < kThemeCount; i += 2) {
    const auto theme = static_cast<Theme>(i);
    for (const auto& group : groups(palette(theme)))
      for (const Named& one : group) {
        INFO("theme ", i, ": ", one.name);
        CHECK(contrast(one.colour, colour_of(theme_colours(theme).plot)) >= 3.0);
      }
  }
}

TEST_CASE("words in a quantity's colour can be read on panels and behind the scene, and text stays as it is") {
  for (std::size_t i = 0; i < kThemeCount; ++i) {
    const Palette& p = palette(static_cast<Theme>(i));
    CHECK(readable(p, p.text) == p.text);
    for (const auto& group : groups(p))
      for (const Named& one : group) {
        INFO("theme ", i, ": ", one.name);
        for (const Rgba& ground : {p.panel, p.background_top, p.background_bottom})
          CHECK(contrast(readable(p, one.colour), ground) >= 4.5);
      }
  }
}

TEST_CASE("a theme is a ground and a vision") {
  for (std::size_t i = 0; i < kThemeCount; ++i) {
    const auto theme = static_cast<Theme>(i);
    CHECK(theme_of(is_dark(theme), vision_of(theme)) == theme);
  }
  CHECK(is_dark(Theme::dark));
  CHECK_FALSE(is_dark(Theme::light_tritan));
}

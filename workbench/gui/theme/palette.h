// The colour of every quantity, defined once: 3D view, plots, tables and insets all use it, so that a force is the same
// orange everywhere. Hues are Okabe & Ito's (colour-blind safe), lightened or darkened per theme to keep contrast;
// quantities that never share a plot may share a hue.
//
// For each kind of colour blindness there is a set in which the colours of what is told apart by colour (forces, the
// display's two curves, verdicts, what is drawn on the mesh) differ by at least 25 in CIE 1976 L*a*b* as such an eye
// sees them, by the matrices of Machado, Oliveira & Fernandes, "A Physiologically-based Model for Simulation of Color
// Vision Deficiency", IEEE TVCG 15(6), 2009, severity 1.0. tests/workbench/gui/theme/palette_test.cpp holds matrices
// and pairs.
#pragma once

#include <array>

#include <cstddef>
#include <cstdint>

namespace tangent {

/// Which eye the colours are for: all three cones, or one without those for long, middle or short waves.
enum class Vision : std::uint8_t { common, protan, deutan, tritan };
inline constexpr std::array<const char*, 4> kVisionNames{"common", "protan", "deutan", "tritan"};

/// Ground and vision: the even ones are dark.
enum class Theme : std::uint8_t {
  dark,
  light,
  dark_protan,
  light_protan,
  dark_deutan,
  light_deutan,
  dark_tritan,
  light_tritan,
};
inline constexpr std::size_t kThemeCount = 8;
constexpr bool is_dark(Theme theme) { return static_cast<unsigned>(theme) % 2 == 0; }
constexpr Vision vision_of(Theme theme) { return static_cast<Vision>(static_cast<unsigned>(theme) / 2); }
constexpr Theme theme_of(bool dark, Vision vision) {
  return static_cast<Theme>(2 * static_cast<unsigned>(vision) + (dark ? 0u : 1u));
}

/// sRGB, straight alpha, 0..1, as ImGui and the shaders take it.
struct Rgba {
  float r = 0.0f, g = 0.0f, b = 0.0f, a = 1.0f;
  bool operator==(const Rgba&) const = default;
};

constexpr Rgba rgb_hex(std::uint32_t rrggbb, float alpha = 1.0f) {
  return {static_cast<float>((rrggbb >> 16) & 255u) / 255.0f, static_cast<float>((rrggbb >> 8) & 255u) / 255.0f,
          static_cast<float>(rrggbb & 255u) / 255.0f, alpha};
}
constexpr Rgba with_alpha(Rgba colour, float alpha) { return {colour.r, colour.g, colour.b, alpha}; }
constexpr Rgba mix(Rgba a, Rgba b, float t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.a + (b.a - a.a) * t};
}
/// Bytes R, G, B, A from the lowest: ImGui's ImU32 (IM_COL32) and GL_UNSIGNED_BYTE x 4.
constexpr std::uint32_t packed(Rgba c) {
  const auto byte = [](float x) {
    return static_cast<std::uint32_t>((x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x) * 255.0f + 0.5f);
  };
  return byte(c.r) | (byte(c.g) << 8) | (byte(c.b) << 16) | (byte(c.a) << 24);
}

struct Palette {
  Rgba force_x, force_y, force_z;
  Rgba force_computed;   ///< by the solver, before the safety gate: arrow, curve and number
  Rgba force_magnitude;  ///< felt: what the safety gate lets through
  Rgba cld_commanded, cld_measured;
  Rgba error, iterations, tick_time, energy;
  Rgba contact, normal, finger, penetration, control_net, crease, boundary, selection;
  Rgba mesh, mesh_wire, smooth_surface;  ///< facets, their edges, the PN surface
  Rgba accent;                           ///< the one colour of the interface itself
  Rgba good, warning, bad;
  Rgba text, text_dim, panel, background_top, background_bottom;
};

// clang-format off
constexpr Palette kDarkPalette{
    .force_x = rgb_hex(0xE8703A), .force_y = rgb_hex(0x2DB88F), .force_z = rgb_hex(0x4A9FE0),
    .force_computed = rgb_hex(0xCBBB98), .force_magnitude = rgb_hex(0xF2AE2E),
    .cld_commanded = rgb_hex(0x56B4E9), .cld_measured = rgb_hex(0xD98BB8),
    .error = rgb_hex(0xF0E442), .iterations = rgb_hex(0x7FCFA9), .tick_time = rgb_hex(0xA9B4C2),
    .energy = rgb_hex(0xC99BE8),
    .contact = rgb_hex(0xF0E442), .normal = rgb_hex(0x56B4E9), .finger = rgb_hex(0xF3C6A8),
    .penetration = rgb_hex(0xE8592A), .control_net = rgb_hex(0xDE8CBB), .crease = rgb_hex(0x3FA0EA),
    .boundary = rgb_hex(0xE8703A), .selection = rgb_hex(0xF2AE2E),
    .mesh = rgb_hex(0x87909B), .mesh_wire = rgb_hex(0x15181C), .smooth_surface = rgb_hex(0x5FAAA2),
    .accent = rgb_hex(0x56B4E9),
    .good = rgb_hex(0x2DB88F), .warning = rgb_hex(0xF2AE2E), .bad = rgb_hex(0xEA6539),
    .text = rgb_hex(0xE4E7EB), .text_dim = rgb_hex(0xA2ABB6), .panel = rgb_hex(0x1B1E23),
    .background_top = rgb_hex(0x343A43), .background_bottom = rgb_hex(0x1E2226)};
// clang-format on

// clang-format off
constexpr Palette kLightPalette{
    .force_x = rgb_hex(0xC24F00), .force_y = rgb_hex(0x007F5C), .force_z = rgb_hex(0x0067A3),
    .force_computed = rgb_hex(0x7D6B42), .force_magnitude = rgb_hex(0xC77F00),
    .cld_commanded = rgb_hex(0x1F86C4), .cld_measured = rgb_hex(0xB4558F),
    .error = rgb_hex(0x9A8B00), .iterations = rgb_hex(0x3E8A6A), .tick_time = rgb_hex(0x5A6675),
    .energy = rgb_hex(0x7D4BA6),
    .contact = rgb_hex(0xE3C400), .normal = rgb_hex(0x1F86C4), .finger = rgb_hex(0xCF9675),
    .penetration = rgb_hex(0xD0450A), .control_net = rgb_hex(0xB4478A), .crease = rgb_hex(0x0B63B0),
    .boundary = rgb_hex(0xC24F00), .selection = rgb_hex(0xC77F00),
    .mesh = rgb_hex(0xC4CAD1), .mesh_wire = rgb_hex(0x4A525C), .smooth_surface = rgb_hex(0x7FC2B8),
    .accent = rgb_hex(0x0068A2),
    .good = rgb_hex(0x007152), .warning = rgb_hex(0x895800), .bad = rgb_hex(0xB43700),
    .text = rgb_hex(0x1D2228), .text_dim = rgb_hex(0x4B545E), .panel = rgb_hex(0xF3F4F6),
    .background_top = rgb_hex(0xFAFBFC), .background_bottom = rgb_hex(0xDDE2E8)};
// clang-format on

// clang-format off
constexpr std::array<Palette, kThemeCount> make_palettes() {
  std::array<Palette, kThemeCount> all{kDarkPalette, kLightPalette, kDarkPalette, kLightPalette,
                                       kDarkPalette, kLightPalette, kDarkPalette, kLightPalette};
  const auto of = [&all](Theme theme) -> Palette& { return all[static_cast<std::size_t>(theme)]; };
  Palette& dark_protan = of(Theme::dark_protan);
  dark_protan.cld_measured = dark_protan.control_net = rgb_hex(0xCC859C);
  dark_protan.bad = rgb_hex(0xFF5500);
  Palette& dark_deutan = of(Theme::dark_deutan);
  dark_deutan.force_magnitude = rgb_hex(0xFFB726);
  dark_deutan.bad = rgb_hex(0xFF8066);
  Palette& dark_tritan = of(Theme::dark_tritan);
  dark_tritan.force_z = rgb_hex(0x8591CC);
  dark_tritan.bad = rgb_hex(0xFF6E26);
  Palette& light_protan = of(Theme::light_protan);
  light_protan.force_x = rgb_hex(0xAD3A00);
  light_protan.cld_commanded = light_protan.normal = rgb_hex(0x0099E6);
  light_protan.contact = rgb_hex(0xCCAA00);
  light_protan.good = rgb_hex(0x106B4D); light_protan.warning = rgb_hex(0x8C5115); light_protan.bad = rgb_hex(0x6B1200);
  Palette& light_deutan = of(Theme::light_deutan);
  light_deutan.force_x = rgb_hex(0x8C2F00);
  light_deutan.contact = rgb_hex(0xCCAA00); light_deutan.penetration = rgb_hex(0xCC3B1F);
  light_deutan.good = rgb_hex(0x006B47); light_deutan.warning = rgb_hex(0xAD3A00); light_deutan.bad = rgb_hex(0x6B1200);
  Palette& light_tritan = of(Theme::light_tritan);
  light_tritan.force_x = rgb_hex(0xCC4400); light_tritan.force_z = rgb_hex(0x5B5B8C);
  light_tritan.contact = rgb_hex(0xCCAA00);
  light_tritan.good = rgb_hex(0x006B47); light_tritan.warning = rgb_hex(0x8C5115); light_tritan.bad = rgb_hex(0xAD3A00);
  return all;
}
// clang-format on
inline constexpr std::array<Palette, kThemeCount> kPalettes = make_palettes();

constexpr const Palette& palette(Theme theme) { return kPalettes[static_cast<std::size_t>(theme)]; }

/// Colour of iteration `i` of `count` (the kept plane is 0): the colour map tide without its darkest tenth, so that the
/// first plane is visible on a dark background.
Rgba iteration_colour(std::size_t i, std::size_t count);

/// Contrast of two opaque colours after WCAG 2.1: 1 to 21.
double contrast_ratio(const Rgba& a, const Rgba& b);
/// The colour for words: as it is, or as much nearer to the colour of text as makes a contrast of 4.5 to 1 on panels
/// and behind the scene.
Rgba readable(const Palette& palette, const Rgba& colour);

}  // namespace tangent

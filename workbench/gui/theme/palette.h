// The colour of every quantity, defined once: 3D view, plots, tables and insets all use it, so that a force is the same
// orange everywhere. Hues are Okabe & Ito's (colour-blind safe), lightened or darkened per theme to keep contrast;
// quantities that never share a plot may share a hue.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tangent {

enum class Theme : std::uint8_t { dark, light };

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
    .good = rgb_hex(0x2DB88F), .warning = rgb_hex(0xF2AE2E), .bad = rgb_hex(0xE8592A),
    .text = rgb_hex(0xE4E7EB), .text_dim = rgb_hex(0x9099A4), .panel = rgb_hex(0x1B1E23),
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
    .accent = rgb_hex(0x0072B2),
    .good = rgb_hex(0x007F5C), .warning = rgb_hex(0xB97700), .bad = rgb_hex(0xC23B00),
    .text = rgb_hex(0x1D2228), .text_dim = rgb_hex(0x66707B), .panel = rgb_hex(0xF3F4F6),
    .background_top = rgb_hex(0xFAFBFC), .background_bottom = rgb_hex(0xDDE2E8)};
// clang-format on

constexpr const Palette& palette(Theme theme) { return theme == Theme::dark ? kDarkPalette : kLightPalette; }

/// Colour of iteration `i` of `count` (the kept plane is 0): the colour map tide without its darkest tenth, so that the
/// first plane is visible on a dark background.
Rgba iteration_colour(std::size_t i, std::size_t count);

}  // namespace tangent

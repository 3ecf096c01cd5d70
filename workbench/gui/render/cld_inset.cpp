// The contact location display from the side, to scale: a 10 mm roller on a rail under the fingerpad, +x distal (to the
// right). Filled: measured position; mark above: commanded position.
#include "workbench/gui/render/overlay_canvas.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

constexpr float kRollerRadius = 5e-3f;  // m
constexpr float kHalfView = 19e-3f;     // m, of the rail shown
constexpr float kFingerHeight = 0.62f;  // of true scale: the inset is about the roller
constexpr float kEmPerMetre = 235.0f;

// Outline of a fingertip over the rail: straight back, rounded tip, a pad that bulges down a little.
void finger_outline(const OverlayCanvas& c, ImVec2 pad, float px_per_m) {
  const auto at = [&](float x_mm, float up_mm) {
    return ImVec2(pad.x + 1e-3f * x_mm * px_per_m, pad.y - kFingerHeight * 1e-3f * up_mm * px_per_m);
  };
  c.list.PathLineTo(at(-33.0f, 1.2f));
  c.list.PathBezierCubicCurveTo(at(-10.0f, -0.6f), at(2.0f, -0.6f), at(9.0f, 0.9f), 24);
  c.list.PathBezierCubicCurveTo(at(15.5f, 2.4f), at(17.0f, 8.4f), at(12.5f, 11.4f), 24);
  c.list.PathBezierCubicCurveTo(at(8.5f, 14.0f), at(-6.0f, 14.0f), at(-33.0f, 14.6f), 24);
  c.list.PathFillConvex(c.ink(c.colours.finger, 0.30f));
  c.list.PathLineTo(at(-33.0f, 1.2f));
  c.list.PathBezierCubicCurveTo(at(-10.0f, -0.6f), at(2.0f, -0.6f), at(9.0f, 0.9f), 24);
  c.list.PathBezierCubicCurveTo(at(15.5f, 2.4f), at(17.0f, 8.4f), at(12.5f, 11.4f), 24);
  c.list.PathBezierCubicCurveTo(at(8.5f, 14.0f), at(-6.0f, 14.0f), at(-33.0f, 14.6f), 24);
  c.list.PathStroke(c.ink(c.colours.finger, 0.9f), 0, 1.4f);
  c.list.PathLineTo(at(14.6f, 5.2f));  // the nail
  c.list.PathBezierCubicCurveTo(at(16.4f, 8.6f), at(13.0f, 11.8f), at(6.5f, 13.2f), 16);
  c.list.PathStroke(c.ink(c.colours.finger, 0.55f), 0, 2.2f);
}

void number_row(const OverlayCanvas& c, ImVec2 at, float right, Rgba colour, const char* name, const double* metres) {
  char text[32] = "      \xE2\x80\x94   ";
  if (metres != nullptr) std::snprintf(text, sizeof text, "%+7.3f mm", *metres * 1e3);
  const float height = c.text_font->FontSize;
  c.list.AddCircleFilled({at.x + 0.3f * c.em, at.y + 0.5f * height}, 0.24f * c.em, c.ink(colour), 16);
  c.text(c.text_font, {at.x + 0.8f * c.em, at.y}, c.colours.text_dim, name);
  c.text(c.number_font, {right - c.text_size(c.number_font, text).x, at.y}, c.colours.text, text);
}

}  // namespace

void draw_cld_inset(const OverlayCanvas& c, ImVec2 corner, double travel_m, const double* commanded_m,
                    const double* measured_m) {
  const float width = kInsetWidth * c.em, height = kInsetHeight * c.em, pad = 0.7f * c.em;
  const ImVec2 min{corner.x - width, corner.y - height};
  c.card(min, corner);
  c.list.PushClipRect(min, corner, true);
  const float px_per_m = kEmPerMetre * c.em;
  const float middle = min.x + 0.5f * width;
  const float rail = min.y + pad + kFingerHeight * 15e-3f * px_per_m + 2.0f * kRollerRadius * px_per_m;
  const float top = rail - 2.0f * kRollerRadius * px_per_m;  // the roller's contact with the pad
  const auto x_of = [&](double metres) { return middle + static_cast<float>(metres) * px_per_m; };
  const double half = 0.5 * travel_m;
  const auto shown = [&](double metres) { return std::clamp(metres, -0.95 * kHalfView, 0.95 * kHalfView); };

  finger_outline(c, {middle, top}, px_per_m);
  c.list.AddLine({x_of(-kHalfView), rail}, {x_of(kHalfView), rail}, c.ink(c.colours.text_dim, 0.5f), 1.0f);
  c.list.AddLine({x_of(-half), rail}, {x_of(half), rail}, c.ink(c.colours.text_dim), 2.0f);
  for (int mm = -20; mm <= 20; mm += 2) {
    if (std::abs(mm * 1e-3) > half + 1e-9) continue;
    const float length = mm % 8 == 0 ? 0.40f : 0.22f;
    c.list.AddLine({x_of(mm * 1e-3), rail}, {x_of(mm * 1e-3), rail + length * c.em}, c.ink(c.colours.text_dim), 1.0f);
  }
  const float radius = kRollerRadius * px_per_m;
  if (measured_m != nullptr && std::isfinite(*measured_m)) {
    const ImVec2 centre{x_of(shown(*measured_m)), rail - radius};
    c.list.AddCircleFilled(centre, radius, c.ink(c.colours.cld_measured, 0.85f), 40);
    c.list.AddCircle(centre, radius, c.ink(c.colours.text, 0.65f), 40, 1.2f);
    // A spoke shows the roller's rotation.
    const float angle = static_cast<float>(*measured_m) / kRollerRadius;
    const ImVec2 spoke{0.72f * radius * std::sin(angle), -0.72f * radius * std::cos(angle)};
    c.list.AddLine(centre, {centre.x + spoke.x, centre.y + spoke.y}, c.ink(c.colours.text, 0.6f), 1.2f);
  }
  if (commanded_m != nullptr && std::isfinite(*commanded_m)) {
    const float x = x_of(shown(*commanded_m)), y = rail + 0.15f * c.em, s = 0.36f * c.em;
    c.list.AddCircle({x, rail - radius}, radius + 1.5f, c.ink(c.colours.cld_commanded), 40, 1.6f);
    c.list.AddTriangleFilled({x, y}, {x - 0.7f * s, y + 1.3f * s}, {x + 0.7f * s, y + 1.3f * s},
                             c.ink(c.colours.cld_commanded));
  }
  const float row = corner.y - pad - 0.9f * c.em;
  number_row(c, {min.x + pad, row - 1.15f * c.em}, corner.x - pad, c.colours.cld_commanded, "commanded", commanded_m);
  number_row(c, {min.x + pad, row}, corner.x - pad, c.colours.cld_measured, "measured", measured_m);
  c.list.PopClipRect();
}

}  // namespace tangent

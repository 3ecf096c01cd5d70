#include "workbench/gui/render/scene_overlay.h"

#include "workbench/gui/render/overlay_canvas.h"
#include "workbench/gui/render/quantity_text.h"
#include "workbench/gui/theme/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace tangent {
namespace {

// em: from the picture's edges, between the cards, and the cards.
constexpr float kLeft = 0.6f, kBottom = 0.7f, kGap = 0.5f;
constexpr float kAxesWidth = 14.0f, kBarWidth = 9.0f;
constexpr float kAxesHeight = 4.6f, kBarHeight = 3.6f, kBothHeight = 6.4f;
static_assert(kInsetWidth == kAxesWidth, "the two cards stand on each other");

struct Box2 {
  ImVec2 min, max;
  bool meets(const Box2& o) const { return min.x < o.max.x && o.min.x < max.x && min.y < o.max.y && o.min.y < max.y; }
};

/// Offset from the point by half an em plus the label's own extent in that direction.
Box2 label_box(const OverlayCanvas& c, const Vec2& point, const Vec2& away, const ImVec2& size) {
  const Vec2 half(0.5 * size.x, 0.5 * size.y);
  const Vec2 centre = point + away * (0.55 * c.em) + away * half;
  const ImVec2 at{c.top_left.x + static_cast<float>(centre.x - half.x),
                  c.top_left.y + static_cast<float>(centre.y - half.y)};
  return {at, {at.x + size.x, at.y + size.y}};
}

/// Each on the free side of its point, else on the first other side where it lies on no other label, and on nothing of
/// `taken`; where there is none, it is left out. The last are the most wanted: force and depth.
void draw_labels(const OverlayCanvas& c, double pixels_per_point, std::span<const SceneLabel> labels,
                 std::vector<Box2> taken) {
  constexpr std::array<double, 8> kTurns_deg{0.0, 45.0, -45.0, 90.0, -90.0, 135.0, -135.0, 180.0};
  for (auto label = labels.rbegin(); label != labels.rend(); ++label) {
    const ImVec2 size = c.text_size(c.number_font, label->text);
    for (const double turn : kTurns_deg) {
      const double cosine = std::cos(turn * kDegree), sine = std::sin(turn * kDegree);
      const Vec2 away(cosine * label->away.x - sine * label->away.y, sine * label->away.x + cosine * label->away.y);
      const Box2 box = label_box(c, label->pixel / pixels_per_point, away, size);
      if (std::any_of(taken.begin(), taken.end(), [&](const Box2& other) { return other.meets(box); })) continue;
      taken.push_back(box);
      c.haloed(c.number_font, box.min, readable(c.colours, mix(label->colour, c.colours.text, 0.55f)), label->text);
      break;
    }
  }
}

// World axes as the camera sees them; the names x y z in the colours of the force components.
void draw_triad(const OverlayCanvas& c, ImVec2 centre, const Camera& camera) {
  struct Axis {
    Vec3 direction;
    const char* name;
    Rgba colour;
    double toward_eye = 0.0;
  };
  std::array<Axis, 3> axes{{{Vec3(1, 0, 0), "x", c.colours.force_x},
                            {Vec3(0, 1, 0), "y", c.colours.force_y},
                            {Vec3(0, 0, 1), "z", c.colours.force_z}}};
  for (Axis& axis : axes) axis.toward_eye = -glm::dot(axis.direction, camera.forward());
  std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.toward_eye < b.toward_eye; });
  const float length = 1.5f * c.em;
  for (const Axis& axis : axes) {
    const float x = static_cast<float>(glm::dot(axis.direction, camera.right()));
    const float y = static_cast<float>(-glm::dot(axis.direction, camera.up()));
    const float fade = axis.toward_eye < -0.1 ? 0.55f : 1.0f;
    const ImVec2 tip{centre.x + length * x, centre.y + length * y};
    c.list.AddLine(centre, tip, c.ink(axis.colour, fade), 2.0f);
    const ImVec2 size = c.text_size(c.number_font, axis.name);
    const float clear = 0.55f * c.em;
    const float across = std::hypot(x, y);
    const ImVec2 beyond = across > 0.05f ? ImVec2(clear * x / across, clear * y / across) : ImVec2(clear, -clear);
    c.haloed(c.number_font, {tip.x + beyond.x - 0.5f * size.x, tip.y + beyond.y - 0.5f * size.y},
             readable(c.colours, axis.colour), axis.name);
  }
}

void draw_bar(const OverlayCanvas& c, ImVec2 at, float length, Rgba colour, const std::string& text) {
  const float tick = 0.28f * c.em;
  c.list.AddLine(at, {at.x + length, at.y}, c.ink(colour), 2.0f);
  c.list.AddLine({at.x, at.y - tick}, {at.x, at.y + tick}, c.ink(colour), 1.5f);
  c.list.AddLine({at.x + length, at.y - tick}, {at.x + length, at.y + tick}, c.ink(colour), 1.5f);
  c.haloed(c.number_font, {at.x + length + 0.6f * c.em, at.y - 0.5f * c.number_font->FontSize}, c.colours.text, text);
}

// Scale bars of length and force at the depth of the camera's target.
void draw_scales(const OverlayCanvas& c, ImVec2 at, double metres_per_point, const SceneRenderer& renderer,
                 const SceneFrame& frame) {
  const double limit_m = 4.9 * c.em * metres_per_point;
  if (!(limit_m > 0.0)) return;
  const double length_m = round_number_below(limit_m);
  draw_bar(c, at, static_cast<float>(length_m / metres_per_point), c.colours.text_dim, length_text(length_m));
  const double metres_per_newton = renderer.force_metres_per_newton();
  if (!frame.toggles.force || !frame.tick || !(metres_per_newton > 0.0)) return;
  const double newton = round_number_below(limit_m / metres_per_newton);
  char text[32];
  std::snprintf(text, sizeof text, "%g N", newton);
  draw_bar(c, {at.x, at.y - 1.3f * c.em}, static_cast<float>(newton * metres_per_newton / metres_per_point),
           c.colours.force_magnitude, text);
}

void draw_iteration_bar(const OverlayCanvas& c, ImVec2 at, const SceneFrame& frame) {
  const std::size_t count = frame.trace.size();
  const float width = 8.0f * c.em, height = 0.5f * c.em;
  const std::size_t cells = std::min<std::size_t>(count, 64);
  for (std::size_t i = 0; i < cells; ++i) {
    const std::size_t iteration = cells == count ? i : i * (count - 1) / (cells - 1);
    const float gap = cells <= 24 ? 1.0f : 0.0f;
    const float x0 = at.x + width * static_cast<float>(i) / static_cast<float>(cells);
    const float x1 = at.x + width * static_cast<float>(i + 1) / static_cast<float>(cells) - gap;
    c.list.AddRectFilled({x0, at.y}, {x1, at.y + height}, c.ink(iteration_colour(iteration, count)));
    if (frame.selected_iteration == iteration) {
      c.list.AddRect({x0 - 1.5f, at.y - 1.5f}, {x1 + 1.5f, at.y + height + 1.5f}, c.ink(c.colours.text), 0.0f, 0, 1.5f);
    }
  }
  const std::string last = std::to_string(count - 1);
  c.haloed(c.text_font, {at.x, at.y - 1.2f * c.text_font->FontSize}, c.colours.text_dim, "iteration");
  c.haloed(c.number_font, {at.x, at.y + height + 0.1f * c.em}, c.colours.text, "0");
  c.haloed(c.number_font, {at.x + width - c.text_size(c.number_font, last).x, at.y + height + 0.1f * c.em},
           c.colours.text, last);
}

// Width and height of the card with axes and scales, with the colour bar, or with both, em.
ImVec2 scales_card(bool axes, bool bar) {
  return {axes ? kAxesWidth : kBarWidth, !bar ? kAxesHeight : axes ? kBothHeight : kBarHeight};
}

}  // namespace

OverlayCards overlay_cards(const SceneToggles& toggles, float em, float room) {
  const bool bar = toggles.colour_bar && toggles.planes;
  const ImVec2 scales = scales_card(toggles.axes, bar);
  const auto fits = [&](float height) { return (kBottom + height + kGap) * em <= room; };
  OverlayCards cards;
  cards.inset = toggles.cld_inset && fits(kInsetHeight);
  cards.scales = (toggles.axes || bar) && fits(scales.y);
  if (!cards.inset && !cards.scales) return cards;
  const float inset_width = cards.inset ? kInsetWidth : 0.0f, inset_height = cards.inset ? kInsetHeight + kGap : 0.0f;
  const float width = cards.scales ? scales.x : 0.0f, height = cards.scales ? scales.y + kGap : 0.0f;
  cards.beside = cards.inset && cards.scales && !fits(inset_height + scales.y);
  cards.size = cards.beside ? Vec2(kLeft + inset_width + kGap + width + kGap, kBottom + std::max(inset_height, height))
                            : Vec2(kLeft + std::max(inset_width, width) + kGap, kBottom + inset_height + height);
  cards.size *= static_cast<double>(em);
  return cards;
}

void draw_scene_overlay(ImDrawList& draw_list, const ImVec2& top_left, double pixels_per_point, float top,
                        const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const ThemeFonts& fonts) {
  const float per_point = static_cast<float>(pixels_per_point);
  const ImVec2 size{static_cast<float>(renderer.width_px()) / per_point,
                    static_cast<float>(renderer.height_px()) / per_point};
  const OverlayCanvas canvas{draw_list,           top_left, size, palette(frame.theme), fonts.small, fonts.small_number,
                             fonts.text->FontSize};
  draw_list.PushClipRect(top_left, {top_left.x + size.x, top_left.y + size.y}, true);
  const float em = canvas.em;
  ImVec2 lower_left{top_left.x + kLeft * em, top_left.y + size.y - kBottom * em};
  const OverlayCards cards = overlay_cards(frame.toggles, em, size.y - top);
  const float cards_right = top_left.x + static_cast<float>(cards.size.x),
              cards_top = top_left.y + size.y - static_cast<float>(cards.size.y);
  draw_labels(canvas, pixels_per_point, renderer.labels(),
              {{top_left, {top_left.x + size.x, top_left.y + top}},
               {{top_left.x, cards_top}, {cards_right, top_left.y + size.y}}});
  // The inset is at the bottom, because the card above it changes height with the tick.
  if (cards.inset && (frame.cld_commanded_m || frame.cld_measured_m)) {
    draw_cld_inset(canvas, {lower_left.x + kInsetWidth * em, lower_left.y}, frame.display_travel_m,
                   frame.cld_commanded_m ? &*frame.cld_commanded_m : nullptr,
                   frame.cld_measured_m ? &*frame.cld_measured_m : nullptr);
    if (cards.beside)
      lower_left.x += (kInsetWidth + kGap) * em;
    else
      lower_left.y -= (kInsetHeight + kGap) * em;
  }
  const bool room = lower_left.x + scales_card(frame.toggles.axes, true).x * em <= top_left.x + size.x;
  const bool bar = room && cards.scales && frame.toggles.colour_bar && frame.toggles.planes && frame.trace.size() > 1;
  const bool axes = room && cards.scales && frame.toggles.axes;
  if (axes || bar) {  // a card behind them, for legibility
    const ImVec2 card = scales_card(axes, bar);
    canvas.card({lower_left.x, lower_left.y - card.y * em}, {lower_left.x + card.x * em, lower_left.y});
  }
  lower_left = {lower_left.x + 0.3f * em, lower_left.y - 0.2f * em};
  float left = lower_left.x + 0.4f * em;
  if (axes) {
    draw_triad(canvas, {lower_left.x + 2.1f * em, lower_left.y - 2.1f * em}, camera);
    left += 4.9f * em;
    const double metres_per_point = camera.metres_per_pixel(camera.target, renderer.height_px()) * pixels_per_point;
    draw_scales(canvas, {left, lower_left.y - 0.7f * em}, metres_per_point, renderer, frame);
  }
  if (bar) {
    draw_iteration_bar(canvas, {left, lower_left.y - (axes ? 4.0f : 1.4f) * em}, frame);
  }
  draw_list.PopClipRect();
}

}  // namespace tangent

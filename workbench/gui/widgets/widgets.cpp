#include "workbench/gui/widgets/widgets.h"

#include "core/io/csv_table.h"
#include "workbench/gui/widgets/nearest_names.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <utility>

namespace tangent {

namespace {

/// Bookmark icon: a notched ribbon, with a chevron for previous (`d` -1) or next (1).
void draw_ribbon(ImDrawList& draw, ImVec2 c, float r, float d, float line, ImU32 ink) {
  const float x = c.x - d * 0.45f * r, w = 0.42f * r, h = 0.8f * r;
  const ImVec2 ribbon[5] = {
      {x - w, c.y - h}, {x + w, c.y - h}, {x + w, c.y + h}, {x, c.y + 0.35f * h}, {x - w, c.y + h}};
  draw.AddPolyline(ribbon, 5, ink, ImDrawFlags_Closed, line);
  if (d == 0.0f) return;
  const ImVec2 points[3] = {
      {c.x + d * 0.4f * r, c.y - 0.5f * r}, {c.x + d * 0.95f * r, c.y}, {c.x + d * 0.4f * r, c.y + 0.5f * r}};
  draw.AddPolyline(points, 3, ink, 0, 1.2f * line);
}

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 c, float r, ImU32 ink) {
  const auto triangle = [&](float x, float direction) {
    draw.AddTriangleFilled({x - direction * 0.55f * r, c.y - 0.75f * r}, {x - direction * 0.55f * r, c.y + 0.75f * r},
                           {x + direction * 0.65f * r, c.y}, ink);
  };
  const auto bar = [&](float x) {
    draw.AddRectFilled({x - 0.15f * r, c.y - 0.75f * r}, {x + 0.15f * r, c.y + 0.75f * r}, ink);
  };
  const float line = std::max(1.0f, 0.2f * r);
  switch (icon) {
    case Icon::first:
      bar(c.x - 0.65f * r);
      triangle(c.x + 0.2f * r, -1.0f);
      break;
    case Icon::live:
      bar(c.x + 0.65f * r);
      triangle(c.x - 0.2f * r, 1.0f);
      break;
    case Icon::step_back:
      triangle(c.x - 0.3f * r, -1.0f);
      bar(c.x + 0.65f * r);
      break;
    case Icon::step_forward:
      triangle(c.x + 0.3f * r, 1.0f);
      bar(c.x - 0.65f * r);
      break;
    case Icon::play:
      triangle(c.x, 1.15f);
      break;
    case Icon::pause:
      draw.AddRectFilled({c.x - 0.6f * r, c.y - 0.75f * r}, {c.x - 0.18f * r, c.y + 0.75f * r}, ink);
      draw.AddRectFilled({c.x + 0.18f * r, c.y - 0.75f * r}, {c.x + 0.6f * r, c.y + 0.75f * r}, ink);
      break;
    case Icon::previous:
    case Icon::next: {
      const float d = icon == Icon::next ? 1.0f : -1.0f;
      const ImVec2 points[3] = {
          {c.x - d * 0.35f * r, c.y - 0.65f * r}, {c.x + d * 0.4f * r, c.y}, {c.x - d * 0.35f * r, c.y + 0.65f * r}};
      draw.AddPolyline(points, 3, ink, 0, 1.4f * line);
      break;
    }
    case Icon::bookmark:
    case Icon::bookmark_back:
    case Icon::bookmark_on:
      draw_ribbon(draw, c, r, icon == Icon::bookmark ? 0.0f : icon == Icon::bookmark_on ? 1.0f : -1.0f, line, ink);
      break;
    case Icon::record:
      draw.AddCircleFilled(c, 0.62f * r, ink, 20);
      break;
    case Icon::reset:
      draw.PathArcTo(c, 0.62f * r, -2.3f, 2.6f, 16);
      draw.PathStroke(ink, 0, line);
      draw.AddTriangleFilled({c.x - 0.85f * r, c.y - 0.35f * r}, {c.x - 0.02f * r, c.y - 0.55f * r},
                             {c.x - 0.62f * r, c.y - 0.98f * r}, ink);
      break;
  }
}

std::string id_of(std::string_view path) { return "##" + std::string(path); }

}  // namespace

void draw_star(ImDrawList& draw, ImVec2 centre, float radius, ImU32 ink) {
  // Five kites: ImGui fills convex shapes only.
  const auto at = [&](int tenth, float r) {
    const float angle = 0.2f * std::numbers::pi_v<float> * static_cast<float>(tenth) - 0.5f * std::numbers::pi_v<float>;
    return ImVec2(centre.x + r * std::cos(angle), centre.y + r * std::sin(angle));
  };
  for (int i = 0; i < 10; i += 2)
    draw.AddQuadFilled(centre, at(i - 1, 0.42f * radius), at(i, radius), at(i + 1, 0.42f * radius), ink);
}

bool section(const UiContext& ui, const char* title, bool open_at_first) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float height = ui.px(24);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const auto kept = ui.open_sections.find(title);
  bool open = kept != ui.open_sections.end() ? kept->second : open_at_first;
  if (ImGui::InvisibleButton(title, {std::max(1.0f, width), height})) ui.open_sections[title] = open = !open;
  ui.items.note_last(std::string("section/") + title);
  if (ui.section_wanted != nullptr && *ui.section_wanted == title) {
    ui.open_sections[title] = open = true;
    ImGui::SetScrollHereY(0.0f);
    ui.section_wanted->clear();
  }
  tooltip(ui, open ? "Folds this section" : "Unfolds this section");
  const bool hovered = ImGui::IsItemHovered();
  // Over the column's full width, beyond the padding at which ImGui clips.
  const float left = ImGui::GetWindowPos().x, right = at.x + width + ui.px(4);
  draw.PushClipRect({left, draw.GetClipRectMin().y}, {right, draw.GetClipRectMax().y}, false);
  draw.AddRectFilled({left, at.y}, {right, at.y + height}, ui.colours.panel_header);
  draw.PopClipRect();
  const ImU32 ink = hovered ? ui.colours.text : ui.colours.text_dim;
  const ImVec2 c{at.x + ui.px(4), at.y + 0.5f * height};
  const float r = ui.px(4);
  if (open)
    draw.AddTriangleFilled({c.x - r, c.y - 0.6f * r}, {c.x + r, c.y - 0.6f * r}, {c.x, c.y + 0.7f * r}, ink);
  else
    draw.AddTriangleFilled({c.x - 0.6f * r, c.y - r}, {c.x - 0.6f * r, c.y + r}, {c.x + 0.7f * r, c.y}, ink);
  ImFont* font = ui.fonts.strong;
  draw.AddText(font, font->FontSize, {at.x + ui.px(15), at.y + 0.5f * (height - font->FontSize) - ui.px(1)},
               ui.colours.text, title);
  return open;
}

void edit_next(const char* label) { GImGui->NavActivateInputId = ImGui::GetID(label); }

bool text_is_edited() { return GImGui->ActiveId != 0 && GImGui->ActiveId == GImGui->InputTextState.ID; }

std::optional<std::string> number_box(const UiContext& ui, std::string_view path, float width, const std::string& text,
                                      bool focus) {
  std::string edited = text;
  ImGui::SetNextItemWidth(width);
  ImGui::PushFont(ui.fonts.number);
  if (focus) edit_next(id_of(path).c_str());
  ImGui::InputText(id_of(path).c_str(), &edited, ImGuiInputTextFlags_AutoSelectAll);
  ImGui::PopFont();
  ui.items.note_last(path);
  const ImGuiID id = ImGui::GetItemID();
  Typing& state = ui.typing;
  std::optional<std::string> result;
  if (ImGui::IsItemActivated()) {
    state.id = id;
    state.text = state.shown = text;
  }
  if (ImGui::IsItemActive() && state.id == id) {
    state.text = edited;
  } else if (ImGui::IsItemDeactivated() && state.id == id) {
    // On Enter this frame's text counts; when another widget took the focus, the last text seen.
    if (edited != text) state.text = edited;
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (!escaped && state.text != state.shown) result = state.text;
    state.id = 0;
  }
  if (auto given = ui.items.take_value(path)) result = std::move(given);
  return result;
}

namespace {

/// The field being typed in.
std::optional<std::string> type_in_field(const UiContext& ui, std::string_view path, const ValueField& field) {
  Typing& state = ui.typing;
  const bool focus = std::exchange(state.focus_field, false);
  const bool was_active = state.id != 0;
  std::optional<std::string> typed = number_box(ui, path, field.width, field.text, focus);
  if (was_active && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab), false)) {
    // Tab in ImGui cycles through text boxes, of which this is the only one; we move to the next field instead.
    if (!typed && state.text != state.shown) typed = state.text;
    ImGui::ClearActiveID();
    state.id = 0;
    state.field.clear();
    state.tab_on = true;
  } else if (ImGui::IsItemDeactivated()) {
    state.field.clear();
  }
  return typed;
}

}  // namespace

void draw_bands(const UiContext& ui, ImVec2 at, float width, std::span<const ShareBand> bands) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float low = at.y + ImGui::GetFrameHeight(), line = ui.px(2), tooth = ui.px(4), gap = ui.px(4);
  for (const ShareBand& band : bands) {
    const float x0 = at.x + band.from * width, x1 = at.x + band.to * width;
    switch (band.safety) {
      case Safety::stable:
        draw.AddRectFilled({x0, low - line}, {x1, low}, ui.colours.good);
        break;
      case Safety::shakes:
        for (float x = x0; x < x1; x += gap)
          draw.AddTriangleFilled({x, low}, {x + 0.5f * gap, low - tooth}, {std::min(x + gap, x1), low}, ui.colours.bad);
        break;
      case Safety::unknown:
        for (float x = x0; x + 0.5f * gap <= x1; x += gap)
          draw.AddRectFilled({x, low - line}, {x + 0.5f * gap, low}, ui.colours.text_dim);
        break;
    }
  }
}

namespace {

/// Draws the last item as a filled field.
void draw_field(const UiContext& ui, const ValueField& field, ImVec2 at, double share) {
  const float height = ImGui::GetFrameHeight();
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + field.width, at.y + height};
  const float round = ui.px(3);
  draw.AddRectFilled(at, end, ImGui::GetColorU32(lit ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), round);
  const float filled = static_cast<float>(std::clamp(share, 0.0, 1.0)) * field.width;
  if (filled >= 1.0f) {
    draw.PushClipRect(at, {at.x + filled, end.y}, true);
    draw.AddRectFilled(at, end, ui.colours.accent_soft, round);
    draw.PopClipRect();
  }
  draw_bands(ui, at, field.width, field.bands);
  ImFont* number = ui.fonts.number;
  const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, field.text.c_str()).x;
  // The unit goes before it would push the number out.
  const bool narrow = w > field.width - ui.px(34 + 3);
  const float unit_room = narrow ? ui.px(3) : ui.px(34);
  const auto centred = [&](const ImFont* font) { return std::round(at.y + 0.5f * (height - font->FontSize)); };
  const std::string unit(narrow ? std::string_view() : field.unit);
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {end.x - unit_room + ui.px(3), centred(ui.fonts.small)},
               ui.colours.text_dim, unit.c_str());
  draw.AddText(number, number->FontSize, {end.x - unit_room - w, centred(number)}, ui.colours.text, field.text.c_str());
}

}  // namespace

namespace {

/// Left and Right on the widget with the focus: -1, 1; 0: neither.
int arrows_on(const UiContext& ui, std::string_view path) {
  if (!ui.items.has_focus(path) || ImGui::GetIO().KeyCtrl) return 0;
  const auto down = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), true) ? 1 : 0; };
  return down(ImGuiKey_RightArrow) - down(ImGuiKey_LeftArrow);
}

}  // namespace

ValueFieldResult value_field(const UiContext& ui, std::string_view path, const ValueField& field) {
  ValueFieldResult out;
  Typing& state = ui.typing;
  if (state.tab_on && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    state.tab_on = false;
    state.field = path;
    state.focus_field = true;
  }
  if (state.field == path) {
    out.typed = type_in_field(ui, path, field);
    return out;
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  ImGui::InvisibleButton((id_of(path) + "/slide").c_str(), {std::max(4.0f, field.width), height});
  ui.items.note_last(path);
  ui.items.note_arrows(path);
  out.typed = ui.items.take_value(path);
  const bool by_key = ImGui::IsItemActivated() && GImGui->ActiveIdSource == ImGuiInputSource_Nav;
  const float mouse = ImGui::GetIO().MousePos.x;
  if (ImGui::IsItemActivated()) {
    state.slide_from = field.share;
    state.slide_x = mouse;
  }
  double share = field.share;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, ui.px(3))) {
    // Relative, so that the value doesn't jump to the pointer when grabbed.
    const double fine = ImGui::GetIO().KeyShift ? 0.1 : 1.0;
    share = std::clamp(state.slide_from + fine * static_cast<double>((mouse - state.slide_x) / field.width), 0.0, 1.0);
    if (share != field.share) out.slid = share;
  } else if (const int by = arrows_on(ui, path); by != 0) {
    out.slid = std::clamp(field.share + by * field.step * (ImGui::GetIO().KeyShift ? 0.1 : 1.0), 0.0, 1.0);
  } else if (by_key ||
             (ImGui::IsItemDeactivated() && ImGui::IsItemHovered() && std::abs(mouse - state.slide_x) <= ui.px(3))) {
    // The box appears in this frame and receives input from the next one on.
    state.field = path;
    ImGui::SetCursorScreenPos(at);
    number_box(ui, path, field.width, field.text, true);
    return out;
  }
  draw_field(ui, field, at, share);
  return out;
}

bool icon_button(const UiContext& ui, std::string_view path, Icon icon, const char* tip, bool on, bool enabled) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = icon == Icon::reset ? 0.8f * side : 1.25f * side;
  const bool hit = ImGui::InvisibleButton(id_of(path).c_str(), {width, side}), pressed = hit && enabled;
  ui.items.note_last(path);
  if (hit && !enabled && ui.items.was_wanted(path))
    ui.items.refuse("\"" + std::string(path) + "\" is greyed: there is nothing for it to do now");
  const bool hovered = ImGui::IsItemHovered() && enabled;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool plain = icon == Icon::reset;
  if (on || hovered || !plain) {
    const ImU32 fill =
        on ? ui.colours.accent_fill : ImGui::GetColorU32(hovered ? ImGuiCol_ButtonHovered : ImGuiCol_Button);
    if (!plain || hovered) draw.AddRectFilled(at, {at.x + width, at.y + side}, fill, ui.px(3));
  }
  const ImU32 ink = icon == Icon::record ? ui.colours.bad
                    : !enabled           ? ui.colours.text_faint
                    : on                 ? ui.colours.accent
                    : hovered            ? ui.colours.text
                                         : ui.colours.text_dim;
  draw_icon(draw, icon, {at.x + 0.5f * width, at.y + 0.5f * side}, plain ? ui.px(5.5f) : ui.px(6.5f), ink);
  tooltip(ui, tip);
  return pressed;
}

bool text_button(const UiContext& ui, std::string_view path, const char* text, const char* tip) {
  const bool pressed = ImGui::Button((std::string(text) + id_of(path)).c_str());
  ui.items.note_last(path);
  tooltip(ui, tip);
  return pressed;
}

bool toggle_button(const UiContext& ui, std::string_view path, const char* text, bool& on, const char* tip) {
  const bool was = on;
  if (was) {
    ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.accent_fill);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ui.colours.accent_fill);
  }
  const bool pressed = text_button(ui, path, text, tip);
  if (was) ImGui::PopStyleColor(2);
  if (pressed) on = !on;
  return pressed;
}

bool choice_row(const UiContext& ui, std::string_view path, float width, std::span<const std::string_view> choices,
                int& chosen, bool again) {
  bool changed = false;
  const std::string current(
      choices[static_cast<std::size_t>(std::clamp(chosen, 0, static_cast<int>(choices.size()) - 1))]);
  ImGui::SetNextItemWidth(width);
  const float room = width - ImGui::GetFrameHeight() - 2.0f * ImGui::GetStyle().FramePadding.x;
  const bool open = ImGui::BeginCombo(id_of(path).c_str(), fitted(ImGui::GetFont(), current, room).c_str());
  ui.items.note_last(path);
  ui.items.note_arrows(path);
  if (open) {
    for (int i = 0; i < static_cast<int>(choices.size()); ++i) {
      const std::string name(choices[static_cast<std::size_t>(i)]);
      if (ImGui::Selectable(name.c_str(), i == chosen) && (again || i != chosen)) {
        chosen = i;
        changed = true;
      }
      ui.items.note_last(std::string(path) + "/" + name);
    }
    ImGui::EndCombo();
  }
  int wanted = chosen;
  if (const auto given = ui.items.take_value(path)) {
    const auto found = std::find(choices.begin(), choices.end(), *given);
    if (found != choices.end())
      wanted = static_cast<int>(found - choices.begin());
    else
      ui.items.refuse(show_text(*given) + " is not among the choices of " + std::string(path) + "; " +
                      nearest_text(*given, choices));
  } else if (!open) {
    wanted = std::clamp(chosen + arrows_on(ui, path), 0, static_cast<int>(choices.size()) - 1);
  }
  changed = changed || wanted != chosen;
  chosen = wanted;
  return changed;
}

void fact(const UiContext& ui, const char* label, const std::string& value, const char* unit,
          std::optional<ImU32> ink) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImFont* number = ui.fonts.number;
  ImFont* text = ui.fonts.text;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float unit_width = unit[0] != '\0' ? ui.px(40) : 0.0f;
  const std::string shown_value = fitted(number, value, width - unit_width);
  const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, shown_value.c_str()).x;
  const std::string shown_label = fitted(text, label, width - unit_width - w - ui.px(6));
  draw.AddText(text, text->FontSize, at, ui.colours.text_dim, shown_label.c_str());
  draw.AddText(number, number->FontSize, {at.x + width - unit_width - w, at.y + ui.px(1)},
               ink.value_or(ui.colours.text), shown_value.c_str());
  if (unit_width > 0.0f)
    draw.AddText(text, text->FontSize, {at.x + width - unit_width + ui.px(4), at.y}, ui.colours.text_dim, unit);
  ImGui::Dummy({width, text->FontSize});
  if (shown_label != label || shown_value != value) tooltip(ui, std::string(label) + ": " + value + " " + unit);
}

std::string fitted(const ImFont* font, std::string text, float room) {
  const auto width = [&](const std::string& s) { return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, s.c_str()).x; };
  if (width(text) <= room) return text;
  while (!text.empty() && width(text + "...") > room) {
    while (!text.empty() && (text.back() & 0xC0) == 0x80) text.pop_back();  // UTF-8: whole characters
    if (!text.empty()) text.pop_back();
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? text : text + "...";
}

void same_line_if_room(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

float button_width(const char* text) { return ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x; }

namespace {

/// Beside its item, because at the pointer it would cover the value about to be changed; at the pointer for tall items.
void place_tooltip(const UiContext& ui) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  if (max.y - min.y > ui.px(60)) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float x = ImGui::GetIO().MousePos.x;
  const bool low = min.y > 0.6f * screen.y, right = x > 0.6f * screen.x;
  ImGui::SetNextWindowPos({x, low ? min.y - ui.px(4) : max.y + ui.px(4)}, ImGuiCond_Always,
                          {right ? 1.0f : 0.0f, low ? 1.0f : 0.0f});
}

bool any_key_down() {
  const auto& down = ImGui::GetIO().KeysDown;
  return std::any_of(std::begin(down), std::end(down), [](bool key) { return key; });
}

}  // namespace

void tooltip(const UiContext& ui, std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  if (ImGui::IsAnyMouseDown()) {
    ui.resting = {};
    return;
  }
  // Items without an id (rows of facts) are identified by position.
  const ImVec2 at = ImGui::GetItemRectMin();
  const ImGuiID id = ImGui::GetItemID() != 0 ? ImGui::GetItemID() : ImHashData(&at, sizeof at);
  Resting& resting = ui.resting;
  const int frame = ImGui::GetFrameCount();
  if (resting.id != id || frame - resting.frame > 1) resting = {id, 0.0f, frame};
  if (frame != resting.frame) resting.seconds += ImGui::GetIO().DeltaTime;
  resting.frame = frame;
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x != 0.0f || moved.y != 0.0f)
    resting.typed_over = false;
  else if (any_key_down())
    resting.typed_over = true;
  // While something is typed nothing may cover it.
  if (resting.seconds < 0.35f || resting.typed_over || text_is_edited()) return;
  place_tooltip(ui);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ui.px(320));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string printed(const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string short_number(double value) { return printed("%.6g", value); }

}  // namespace tangent

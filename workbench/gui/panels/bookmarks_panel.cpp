// Bookmarks of the user, with notes, those set by triggers, and the triggers' settings.
#include "core/io/csv_table.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace tangent {

ImU32 bookmark_ink(const UiContext& ui, BookmarkKind kind) {
  switch (kind) {
    case BookmarkKind::user:
      return ui.colours.accent;
    case BookmarkKind::reseeded:
      return packed(ui.palette.cld_measured);
    case BookmarkKind::iterations:
      return packed(ui.palette.iterations);
    case BookmarkKind::force:
      return ui.colours.text;  // no hue is left that the others leave room for
    case BookmarkKind::unconverged:
      return ui.colours.warning;
    default:
      return ui.colours.bad;
  }
}

namespace {

struct TriggerRow {
  BookmarkKind kind;
  const char* label;
  const char* doc;
};
constexpr std::array kTriggers{
    TriggerRow{BookmarkKind::unconverged, "Unconverged",
               "A tick that did not converge, or where the surface offers no contact (facing)"},
    TriggerRow{BookmarkKind::reseeded, "Reseeded", "Tracking was lost and started again from the nearest triangles"},
    TriggerRow{BookmarkKind::iterations, "Iterations over", "More iterations than this in one tick"},
    TriggerRow{BookmarkKind::force, "Force over", "More force than this sent to the device"},
    TriggerRow{BookmarkKind::device_fault, "Device fault", "A fault of a device or of the safety gate"}};

/// Value field for a trigger's threshold.
void threshold(const UiContext& ui, MessageLog& messages, const char* path, double& value, double most,
               const char* unit, bool whole) {
  const auto result =
      value_field(ui, path, {ImGui::GetContentRegionAvail().x, value / most, short_number(value), unit});
  double wanted = value;
  if (result.slid) wanted = *result.slid * most;
  if (result.typed) {
    char* end = nullptr;
    const double typed = std::strtod(result.typed->c_str(), &end);
    if (end == result.typed->c_str() || !std::isfinite(typed))
      messages.say(Severity::error, show_text(*result.typed) + " is not a number");
    else
      wanted = typed;
  }
  wanted = std::clamp(wanted, 0.0, most);
  value = whole ? std::round(wanted) : std::round(wanted * 10.0) / 10.0;
}

void draw_triggers(const UiContext& ui, AppModel& model) {
  BookmarkTriggers& triggers = model.time().live_bookmarks().triggers;
  for (const TriggerRow& row : kTriggers) {
    bool& on = triggers.on[static_cast<std::size_t>(row.kind)];
    const std::string path = std::string("bookmarks/trigger/") + to_string(row.kind);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(2), ui.px(1)));
    ImGui::Checkbox((std::string(row.label) + "##" + path).c_str(), &on);
    ImGui::PopStyleVar();
    ui.items.note_last(path);
    tooltip(ui, row.doc);
    if (row.kind != BookmarkKind::iterations && row.kind != BookmarkKind::force) continue;
    ImGui::SameLine(ui.px(150));
    if (row.kind == BookmarkKind::iterations) {
      double over = triggers.iterations_over;
      threshold(ui, model.messages(), "bookmarks/iterations_over", over, 200.0, "", true);
      triggers.iterations_over = static_cast<std::int32_t>(over);
    } else {
      threshold(ui, model.messages(), "bookmarks/force_over", triggers.force_over_n, 20.0, "N", false);
    }
  }
}

void draw_row(const UiContext& ui, TimeModel& time, const Bookmark& mark, std::size_t i) {
  const ServoRecord* seen = time.tick().record();
  const bool here = seen != nullptr && seen->tick.tick >= mark.tick && seen->tick.tick <= mark.last_tick;
  const bool gone = !time.reaches(mark.tick) && !time.reaches(mark.last_tick);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  ImGui::PushStyleColor(ImGuiCol_Text, gone ? ui.colours.text_faint : ui.colours.text);
  ImGui::PushFont(ui.fonts.small_number);
  const std::string text = printed("  %9.3f  ", mark.t_s);
  if (ImGui::Selectable((text + "##bookmark" + std::to_string(mark.id)).c_str(), here,
                        ImGuiSelectableFlags_AllowItemOverlap) &&
      !gone)
    time.select_tick(time.reaches(mark.tick) ? mark.tick : mark.last_tick);
  const float text_width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::PopFont();
  // The note's field covers the rest of the row.
  ui.items.note_last(printed("bookmarks/row/%zu", i), at, {at.x + text_width, at.y + height});
  const std::string span = mark.ticks > 1
                               ? printed("ticks %llu to %llu, %u of them", static_cast<unsigned long long>(mark.tick),
                                         static_cast<unsigned long long>(mark.last_tick), mark.ticks)
                               : printed("tick %llu", static_cast<unsigned long long>(mark.tick));
  tooltip(ui, gone ? span + ", no longer kept"
              : time.recording() != nullptr || time.past().main().covers(mark.last_tick)
                  ? span
                  : span + ", kept with the half second before it");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, at.y + ui.px(2)}, {at.x + ui.px(6), at.y + height - ui.px(1)}, bookmark_ink(ui, mark.kind),
                     ui.px(1.5f));
  const float x = text_width + ui.px(2), remove = ui.px(18);
  ImGui::PushFont(ui.fonts.small);
  ImGui::SameLine(x);
  if (mark.kind == BookmarkKind::user) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(3), 0.0f));
    if (auto note =
            number_box(ui, printed("bookmarks/note/%u", mark.id), ImGui::GetContentRegionAvail().x - remove, mark.note))
      time.bookmarks().set_note(mark.id, *note);
    ImGui::PopStyleVar();
    if (mark.note.empty() && !ImGui::IsItemActive())
      draw.AddText({ImGui::GetItemRectMin().x + ui.px(3), at.y}, ui.colours.text_faint, "note");
  } else {
    const std::string what = mark.ticks > 1 ? printed("%s in %u ticks, first ", to_string(mark.kind), mark.ticks)
                                            : printed("%s: ", to_string(mark.kind));
    const std::string shown = fitted(ui.fonts.small, what + mark.note, ImGui::GetContentRegionAvail().x - remove);
    ImGui::TextUnformatted(shown.c_str());
    if (shown != what + mark.note) tooltip(ui, what + mark.note);
  }
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - remove + ui.px(4));
  const std::uint32_t id = mark.id;
  if (ImGui::SmallButton(printed("\u00d7##remove%u", id).c_str())) time.bookmarks().remove(id);
  ui.items.note_last(printed("bookmarks/remove/%zu", i));
  ImGui::PopFont();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_bookmarks_panel(const UiContext& ui, AppModel& model, BookmarksPanel& state) {
  if (!section(ui, "Bookmarks", state.open)) return;
  const bool any = model.time().tick().record() != nullptr;
  if (text_button(ui, "bookmarks/add", "Add", "A bookmark on the tick in view (K)") && any) {
    model.time().set_paused(true);
    model.time().add_bookmark();
  }
  ImGui::SameLine();
  toggle_button(ui, "bookmarks/triggers", "Triggers", state.triggers_open, "What sets bookmarks automatically");
  same_line_if_room(button_width("Solve here"));
  if (text_button(ui, "bookmarks/solve", "Solve here",
                  "At the contact of the bookmark in view: a tick in the direction that needs most iterations (H)")) {
    model.view().picked_triangle = kNone;
    model.solve_here();
  }
  same_line_if_room(button_width("Clear triggered"));
  if (text_button(ui, "bookmarks/clear", "Clear triggered", "Removes those that triggers set"))
    model.time().bookmarks().clear_automatic();
  if (state.triggers_open) draw_triggers(ui, model);
  const std::size_t count = model.time().bookmarks().all().size();
  if (count == 0) {
    ImGui::PushFont(ui.fonts.small);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.text_dim);
    ImGui::TextWrapped("No bookmarks. K sets one, [ and ] go to the previous and next");
    ImGui::PopStyleColor();
    ImGui::PopFont();
    return;
  }
  ImGui::PushFont(ui.fonts.small);
  ImGui::TextDisabled("      time, s     what happened");
  ImGui::PopFont();
  const float row = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("bookmarks", {0.0f, row * static_cast<float>(std::min<std::size_t>(6, count)) + ui.px(12)}, true);
  // A row may remove itself, so the list is read again for each.
  for (std::size_t i = 0; i < model.time().bookmarks().all().size(); ++i)
    draw_row(ui, model.time(), model.time().bookmarks().all()[i], i);
  ImGui::EndChild();
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent

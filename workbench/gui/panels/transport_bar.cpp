// Transport: pause, step by tick or iteration, back to live, and the history as a strip for scrubbing.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

std::string memory_text(std::size_t bytes) {
  return printed("%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

void draw_strip_text(const UiContext& ui, const std::string& text, ImVec2 min, ImVec2 max) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 size = ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9f, 0.0f, text.c_str());
  const ImVec2 at{max.x - size.x - ui.px(8), min.y + 0.5f * (max.y - min.y - size.y)};
  draw.AddRectFilled({at.x - ui.px(4), min.y + ui.px(2)}, {max.x - ui.px(2), max.y - ui.px(2)},
                     packed(with_alpha(ui.palette.panel, 0.85f)), ui.px(2));
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, at, ui.colours.text, text.c_str());
  ui.items.note("transport/frozen", at, {at.x + size.x, at.y + size.y});
}

/// While paused: an outline, and in words how far the servo has gone on where the past no longer grows.
void draw_freeze(const UiContext& ui, const TimeModel& time, ImVec2 min, ImVec2 max) {
  if (!time.paused()) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRect(min, max, ui.colours.accent, ui.px(3), 0, ui.px(1));
  if (const OpenedRecording* recording = time.recording()) {
    const std::string text =
        "recording " + recording->path().filename().string() + (recording->info().closed ? "" : ", cut short") +
        (time.selection_loading() ? printed(", reading A to B: %.0f %%", 100.0 * time.selection_progress())
         : recording->loading()   ? std::string(", loading")
                                  : std::string());
    return draw_strip_text(ui, text, min, max);
  }
  const double ahead_s =
      (static_cast<double>(time.newest_recorded()) - static_cast<double>(time.end_tick() - 1)) * time.tick_period_s();
  const std::string kept = time.past().shows_kept() ? "kept around a bookmark" : "frozen";
  if (!(ahead_s > 0.5) && !time.past().shows_kept()) return;
  const std::string text = printed("%s; live is %.0f s ahead", kept.c_str(), ahead_s);
  draw_strip_text(ui, text, min, max);
}

/// Draws the whole history and the plots' range; bars show iterations, so that unconverged or slow ticks stand out.
void draw_strip(const UiContext& ui, TimeModel& time, float width) {
  const float height = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (width < ui.px(40)) return;
  ImGui::InvisibleButton("##strip", {width, height});
  ui.items.note_last("transport/strip");
  tooltip(ui, time.recording() != nullptr
                  ? std::string("The whole recording; the lit part is what the plots show. Drag to scrub")
              : time.paused()
                  ? "Frozen: every tick here stays and can be solved again while the view is paused. Beyond the "
                    "history it takes " +
                        memory_text(time.frozen_bytes()) + ". Drag to scrub"
                  : std::string("The recorded ticks, all of which can be solved again. Drag to scrub; the lit "
                                "part is what the plots show"));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colours.field, ui.px(3));
  const double first = static_cast<double>(time.first_tick()), end = static_cast<double>(time.end_tick());
  if (!(end > first)) return;
  // Until the history is full the strip grows from the left at a fixed scale, so that it doesn't shrink under the
  // pointer; afterwards it scrolls.
  const double span =
      std::max(end - first, std::min(static_cast<double>(time.store().capacity()), 30.0 / time.tick_period_s()));
  const auto x_of = [&](double tick) {
    return at.x + static_cast<float>(std::clamp((tick - first) / span, 0.0, 1.0)) * width;
  };
  TimeAxis whole;
  whole.update(time.first_tick(), time.end_tick(), span + 1.0);
  whole.show(first, first + span);
  static thread_local std::vector<ColumnBar> bars;
  column_bars(time.store(), static_cast<std::size_t>(Channel::iterations), whole, width, bars);
  const MinMax most =
      time.store().min_max(static_cast<std::size_t>(Channel::iterations), time.first_tick(), time.end_tick());
  const float top = std::max(8.0f, most.empty() ? 8.0f : most.max);
  for (const ColumnBar& bar : bars) {
    // Logarithmic, so that one tick of 90 iterations does not flatten the others.
    const float share = std::min(1.0f, std::log1p(bar.range.max) / std::log1p(top));
    draw.AddRectFilled({at.x + bar.x, at.y + height - ui.px(2) - share * (height - ui.px(4))},
                       {at.x + bar.x + 1.0f, at.y + height - ui.px(2)},
                       packed(with_alpha(ui.palette.iterations, 0.55f)));
  }
  for (const Bookmark& mark : time.bookmarks().all()) {
    if (static_cast<double>(mark.last_tick) < first) continue;
    const float x0 = std::floor(x_of(static_cast<double>(mark.tick))),
                x1 = std::max(x0 + ui.px(2), x_of(static_cast<double>(mark.last_tick)));
    const float deep = mark.kind == BookmarkKind::user ? height : ui.px(5);
    draw.AddRectFilled({x0, at.y}, {x1, at.y + ui.px(3)}, bookmark_ink(ui, mark.kind));
    draw.AddRectFilled({x0, at.y}, {x0 + ui.px(1.5f), at.y + deep}, bookmark_ink(ui, mark.kind));
  }
  draw.AddRectFilled({x_of(time.axis().from()), at.y}, {x_of(time.axis().to()), at.y + height}, ui.colours.accent_soft,
                     ui.px(2));
  if (const ServoRecord* record = time.tick().record()) {
    const float x = x_of(static_cast<double>(record->tick.tick));
    draw.AddRectFilled({x - ui.px(1), at.y}, {x + ui.px(1), at.y + height},
                       time.paused() ? ui.colours.accent : ui.colours.text_dim);
  }
  draw_freeze(ui, time, at, {at.x + width, at.y + height});
  if (ImGui::IsItemActive()) {
    const double tick = first + static_cast<double>((ImGui::GetIO().MousePos.x - at.x) / width) * span;
    time.select_tick(static_cast<std::uint64_t>(std::clamp(tick, first, end - 1.0)));
  }
}

/// `any`: there are ticks.
void draw_tick_buttons(const UiContext& ui, TimeModel& time, bool any) {
  const bool paused = time.paused();
  if (icon_button(ui, "transport/first", Icon::first, "Oldest tick kept (Home)", false, any))
    time.select_tick(time.first_tick());
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/step_back", Icon::step_back, "One tick back (Left; Shift: ten)", false, any))
    time.step_tick(-1);
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/pause", paused ? Icon::play : Icon::pause,
                  time.recording() != nullptr ? "A recording is open: End closes it"
                  : paused                    ? "Back to live (Space)"
                                              : "Freeze the view (Space). The servo goes on",
                  paused, any))
    time.set_paused(!paused);
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/step_forward", Icon::step_forward, "One tick on (Right; Shift: ten)", false, any))
    time.step_tick(1);
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/live", Icon::live, "Live, at the newest tick (End)",
                  !paused && time.axis().following(), any))
    time.go_live();
}

void draw_iteration_buttons(const UiContext& ui, TimeModel& time, bool any) {
  if (icon_button(ui, "transport/iteration_back", Icon::previous, "One iteration back (comma)", false, any))
    time.step_iteration(-1);
  ImGui::SameLine(0, ui.px(3));
  ImGui::PushFont(ui.fonts.number);
  const std::size_t count = time.tick().iterations().size();
  const std::string which = count == 0               ? " -/-"
                            : time.tick().selected() ? printed("%2zu/%zu", *time.tick().selected(), count - 1)
                                                     : printed(" -/%zu", count - 1);
  const float which_x = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(which.c_str());
  ImGui::SameLine();
  ImGui::SetCursorPosX(which_x + 6.0f * ImGui::CalcTextSize("0").x + ui.px(4));
  ImGui::PopFont();
  if (icon_button(ui, "transport/iteration_on", Icon::next, "One iteration on (full stop)", false, any))
    time.step_iteration(1);
}

void draw_bookmark_buttons(const UiContext& ui, TimeModel& time, bool any) {
  if (icon_button(ui, "transport/bookmark_back", Icon::bookmark_back, "The bookmark before ([)", false, any))
    time.go_to_bookmark(-1);
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/bookmark", Icon::bookmark, "A bookmark on the tick in view (K)", false, any))
    time.add_bookmark();
  ImGui::SameLine(0, ui.px(3));
  if (icon_button(ui, "transport/bookmark_on", Icon::bookmark_on, "The next bookmark (])", false, any))
    time.go_to_bookmark(1);
}

void draw_record_button(const UiContext& ui, RecordModel& record) {
  if (icon_button(ui, "transport/record", Icon::record,
                  record.recording() ? "Stops recording (R)"
                                     : "Records every tick from now on, into a new file (R). More in the tab record",
                  record.recording()))
    record.recording() ? record.stop() : record.start();
}

void draw_captions(const UiContext& ui, const ServoRecord* record) {
  const auto caption = [&](const char* label, const std::string& value, float characters) {
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(0, ui.px(5));
    const float x = ImGui::GetCursorPosX();
    ImGui::PushFont(ui.fonts.number);
    const float digit = ImGui::CalcTextSize("0").x;
    characters = std::max(characters, static_cast<float>(value.size()));  // hours of a recording
    ImGui::SetCursorPosX(x + characters * digit - ImGui::CalcTextSize(value.c_str()).x);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopFont();
    ImGui::SameLine(0, ui.px(12));
  };
  caption("tick", record != nullptr ? printed("%llu", static_cast<unsigned long long>(record->tick.tick)) : "-", 9.0f);
  caption("t", record != nullptr ? printed("%.3f s", record->tick.input.t_s) : "-", 10.0f);
}

}  // namespace

void draw_transport_bar(const UiContext& ui, AppModel& model, const Rect& rect) {
  TimeModel& time = model.time();
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(8), 0));
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoNav;
  ImGui::Begin("##transport", nullptr, flags);
  ImGui::PopStyleVar();
  ImGui::SetCursorPosY(0.5f * (rect.h - ImGui::GetFrameHeight()));
  const bool any = !time.store().empty();
  draw_tick_buttons(ui, time, any);
  ImGui::SameLine(0, ui.px(14));
  draw_iteration_buttons(ui, time, any);
  ImGui::SameLine(0, ui.px(14));
  draw_bookmark_buttons(ui, time, any);
  ImGui::SameLine(0, ui.px(14));
  draw_record_button(ui, model.record());
  ImGui::SameLine(0, ui.px(14));
  ImGui::AlignTextToFramePadding();
  draw_captions(ui, time.placed() != nullptr ? nullptr : time.tick().record());
  draw_strip(ui, time, ImGui::GetContentRegionAvail().x);
  ImGui::End();
}

}  // namespace tangent

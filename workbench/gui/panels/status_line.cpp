// Status line: servo rate, late ticks, drops, tick time, and the window's frame time.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

/// Values in fixed-width fields, so that the line does not shift.
class Values {
 public:
  Values(const UiContext& ui, const Rect& rect)
      : ui_(ui),
        rect_(rect),
        y_text_(std::round(rect.y + 0.5f * (rect.h - ui.fonts.small->FontSize))),
        y_number_(std::round(rect.y + 0.5f * (rect.h - ui.fonts.small_number->FontSize))),
        x_(rect.x + ui.px(10)) {}

  /// `characters`: width of the field. Without a value the label has its ink. Left out where there is no room.
  void put(const char* name, const char* label, const std::string& value, float characters, ImU32 ink,
           const char* doc) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont *text = ui_.fonts.small, *number = ui_.fonts.small_number;
    const float from = x_, digit = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, "0").x;
    const float words = text->CalcTextSizeA(text->FontSize, 1e9f, 0.0f, label).x;
    if (from + words + characters * digit > rect_.right() - ui_.px(5)) return;
    draw.AddText(text, text->FontSize, {x_, y_text_}, value.empty() ? ink : ui_.colours.text_dim, label);
    x_ += words + ui_.px(5);
    draw.AddText(number, number->FontSize, {x_, y_number_}, ink, value.c_str());
    x_ += characters * digit + ui_.px(16);
    ImGui::SetCursorScreenPos({from, rect_.y});
    ImGui::InvisibleButton(name, {std::max(1.0f, x_ - ui_.px(16) - from), rect_.h});
    ui_.items.note_last(std::string("status/") + name);
    tooltip(ui_, doc);
  }

  /// Right-aligned, if there is room.
  void put_right(const std::string& value) {
    const ImFont* number = ui_.fonts.small_number;
    const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, value.c_str()).x;
    if (x_ + w >= rect_.right() - ui_.px(10)) return;
    const ImVec2 at{rect_.right() - w - ui_.px(10), y_number_};
    ImGui::GetWindowDrawList()->AddText(number, number->FontSize, at, ui_.colours.text_dim, value.c_str());
    ui_.items.note("status/frame", at, {at.x + w, at.y + number->FontSize});
  }

 private:
  const UiContext& ui_;
  Rect rect_;
  float y_text_, y_number_, x_;
};

}  // namespace

void draw_status_line(const UiContext& ui, AppModel& model, const Rect& rect, double frame_ms) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(10), 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.window);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoNav;
  ImGui::Begin("##status", nullptr, flags);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  Values values(ui, rect);
  const auto integer = [](std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); };
  // Not measured in simulated time.
  const auto time = [](double ns, int width) {
    return ns > 0.0 ? printed("%*.1f \u00b5s", width, ns * 1e-3) : printed("%*s", width, "-");
  };
  const ServoStatus& servo = model.devices().status().servo;
  const ImU32 plain = ui.colours.text, warn = ui.colours.warning;
  values.put("rate", "Servo",
             servo.rate_hz > 0.0 ? printed("%7.1f Hz", servo.rate_hz)
             : servo.running     ? "   ... Hz"
                                 : "   off",
             11, plain, "Ticks per second, measured");
  if (const std::string trouble = model.record().recording() ? model.record().status().trouble : std::string();
      !trouble.empty())
    values.put("not_recorded", "Not recorded", "", 0, ui.colours.bad, trouble.c_str());
  const SessionStatus& session = model.devices().status();
  if (session.real_devices && servo.running && !servo.realtime.fifo)
    values.put("realtime", "No real-time scheduling", "", 0, warn, session.realtime_remedy.c_str());
  const double late_share =
      servo.ticks > 0 ? static_cast<double>(servo.late_ticks) / static_cast<double>(servo.ticks) : 0.0;
  values.put("late", "Late", printed("%s (%.2f %%)", integer(servo.late_ticks).c_str(), 100.0 * late_share), 16,
             late_share > 0.01 ? warn : plain, "Ticks that started after missing at least one deadline");
  values.put("drops", "Lost ticks", integer(servo.gui_drops), 7, servo.gui_drops > 0 ? warn : plain,
             "Ticks that the window did not receive because its buffer was full");
  values.put("p99", "Tick p99", time(servo.tick_p99_ns, 6), 10, plain, "99 of 100 ticks took no longer");
  values.put("worst", "worst", time(servo.tick_worst_ns, 7), 11, plain, "The longest tick so far");
  const double kept_s =
      static_cast<double>(model.time().end_tick() - model.time().first_tick()) * model.time().tick_period_s();
  const double mib = 1.0 / (1024.0 * 1024.0);
  values.put("history", "History", printed("%5.1f s", kept_s), 8, plain, "How far back you can scrub");
  values.put(
      "memory", "in",
      printed("%3.0f of %.0f MiB",
              static_cast<double>(model.time().history_bytes() + model.time().store().memory_bytes()) * mib,
              static_cast<double>(model.time().most_history_bytes() + model.time().store().memory_bytes()) * mib),
      15, plain, "Memory of the history, and its limit");
  // Not known in screenshots, which are reproducible.
  if (frame_ms > 0.0) values.put_right(printed("frame %.0f ms, drawing included", frame_ms));
  ImGui::End();
}

}  // namespace tangent

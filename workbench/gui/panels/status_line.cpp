// One line: servo rate, late ticks, drops, tick time, and what the window itself costs.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>

namespace tangent {

void draw_status_line(const UiContext& ui, AppModel& model, const Rect& rect, double build_ms) {
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
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y_text = std::round(rect.y + 0.5f * (rect.h - ui.fonts.small->FontSize));
  const float y_number = std::round(rect.y + 0.5f * (rect.h - ui.fonts.small_number->FontSize));
  ImFont* text = ui.fonts.small;
  ImFont* number = ui.fonts.small_number;
  const float digit = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, "0").x;
  float x = rect.x + ui.px(10);
  // Every value has a fixed room, so that the line stands still.
  const auto put = [&](const char* name, const std::string& label, const std::string& value, float characters,
                       ImU32 ink, const char* doc) {
    draw.AddText(text, text->FontSize, {x, y_text}, ui.colours.text_dim, label.c_str());
    const float from = x;
    x += text->CalcTextSizeA(text->FontSize, 1e9f, 0.0f, label.c_str()).x + ui.px(5);
    draw.AddText(number, number->FontSize, {x, y_number}, ink, value.c_str());
    x += characters * digit + ui.px(16);
    ImGui::SetCursorScreenPos({from, rect.y});
    ImGui::InvisibleButton(name, {std::max(1.0f, x - ui.px(16) - from), rect.h});
    ui.items.note_last(std::string("status/") + name);
    tooltip(ui, doc);
  };
  const auto integer = [](std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); };
  // In simulated time nothing is measured.
  const auto time = [](double ns, int width) {
    return ns > 0.0 ? printed("%*.1f \u00b5s", width, ns * 1e-3) : printed("%*s", width, "-");
  };
  const ServoStatus& servo = model.devices().status().servo;
  const ImU32 plain = ui.colours.text, warn = ui.colours.warning;
  put("rate", "Servo",
      servo.rate_hz > 0.0 ? printed("%7.1f Hz", servo.rate_hz)
      : servo.running     ? "   ... Hz"
                          : "   off",
      11, plain, "Ticks a second, measured");
  const double late_share =
      servo.ticks > 0 ? static_cast<double>(servo.late_ticks) / static_cast<double>(servo.ticks) : 0.0;
  put("late", "Late", printed("%s (%.2f %%)", integer(servo.late_ticks).c_str(), 100.0 * late_share), 16,
      late_share > 0.01 ? warn : plain, "Ticks before which a deadline was missed");
  put("drops", "Dropped records", integer(servo.gui_drops), 7, servo.gui_drops > 0 ? warn : plain,
      "Records that did not fit into the ring to the window");
  put("p99", "Tick p99", time(servo.tick_p99_ns, 6), 10, plain, "99 of 100 ticks took no longer");
  put("worst", "worst", time(servo.tick_worst_ns, 7), 11, plain, "The longest tick so far");
  const double kept_s =
      static_cast<double>(model.time().end_tick() - model.time().first_tick()) * model.time().tick_period_s();
  const double mib = 1.0 / (1024.0 * 1024.0);
  put("history", "History", printed("%5.1f s", kept_s), 8, plain, "How far back one can scrub");
  put("memory", "in",
      printed("%3.0f of %.0f MiB",
              static_cast<double>(model.time().history_bytes() + model.time().store().memory_bytes()) * mib,
              static_cast<double>(model.time().most_history_bytes() + model.time().store().memory_bytes()) * mib),
      15, plain, "What the history takes of what it may");
  // Pictures are the same every time: no wall-clock numbers in them.
  const std::string right = model.deterministic() ? std::string()
                                                  : printed("frame %.2f ms   %.0f/s", build_ms,
                                                            static_cast<double>(ImGui::GetIO().Framerate));
  const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, right.c_str()).x;
  if (x + w < rect.right() - ui.px(10))
    draw.AddText(number, number->FontSize, {rect.right() - w - ui.px(10), y_number}, ui.colours.text_dim,
                 right.c_str());
  ImGui::End();
}

}  // namespace tangent

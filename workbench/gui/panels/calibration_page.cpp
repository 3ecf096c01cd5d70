// The page of the device monitor that calibrates a force device's torque scale: its steps, what is asked, the answers,
// and the readings against what was asked for.
#include "workbench/bringup/bring_up_text.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

void calibration_text(const std::string& text, ImU32 ink) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void draw_calibration_steps(const UiContext& ui, const CalibrationModel& calibration) {
  const CalibrationView& view = calibration.view();
  const auto steps = falcon_scale_steps();
  std::size_t reading = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool over = i < view.step || view.done, now = i == view.step && !view.ended;
    std::string state = over ? "done" : now ? "under way" : view.ended && i == view.step ? "ended" : "not reached";
    if (over && steps[i].reads && reading < view.reading_count)
      state = "read " + printed("%.2f N", view.readings[reading++].read_n);
    fact(ui, steps[i].title, state, "", over ? ui.colours.good : now ? ui.colours.accent : ui.colours.text_faint);
  }
}

void draw_scale_reading(const UiContext& ui, CalibrationModel& calibration) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("It shows");
  ImGui::SameLine();
  const auto& typed_n = calibration.typed_n();
  const auto typed = number_box(ui, "calibration/reading", ui.px(90), typed_n ? printed("%.4g", *typed_n) : "");
  if (typed) calibration.type_reading(*typed);
  ImGui::SameLine();
  ImGui::TextUnformatted("N");
  const std::string take = yes_text(calibration.view());
  constexpr const char* kNotRead = "It can't be read";
  same_line_if_room(button_width(take.c_str()));
  ImGui::BeginDisabled(!typed_n);
  if (text_button(ui, "calibration/read", take.c_str(), "Then the pull ends")) calibration.take_reading();
  ImGui::EndDisabled();
  same_line_if_room(button_width(kNotRead));
  if (text_button(ui, "calibration/no", kNotRead, "Zero force; then it may pull again"))
    calibration.answer(BringUpAnswer::no);
}

void draw_calibration_answers(const UiContext& ui, CalibrationModel& calibration) {
  const CalibrationView& view = calibration.view();
  ImGui::BeginDisabled(!calibration.settled());
  if (view.ask == CalibrationAsk::reading) {
    draw_scale_reading(ui, calibration);
  } else if (view.asks()) {
    const bool pulls = view.ask == CalibrationAsk::pull;
    if (text_button(ui, "calibration/yes", yes_text(view).c_str(),
                    pulls ? "Until the reading is taken, a minute at the most" : "Then it goes on"))
      calibration.answer(BringUpAnswer::yes);
  }
  ImGui::EndDisabled();
}

/// In a row of its own above all that grows, where it is always in view.
void draw_calibration_stop(const UiContext& ui, CalibrationModel& calibration) {
  ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.bad);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.on_bad);
  if (text_button(ui, "calibration/stop", "Stop", "Zero force at once, and the end: nothing is kept (Escape)"))
    calibration.stop();
  ImGui::PopStyleColor(2);
}

/// What is asked, or what came of it.
void draw_calibration_question(const UiContext& ui, CalibrationModel& calibration) {
  const CalibrationView& view = calibration.view();
  ImGui::PushFont(ui.fonts.strong);
  if (const auto& scale = calibration.scale(); scale && *scale)
    calibration_text(printed("Torque scale: %.0f counts for 1 N m", **scale), ui.colours.good);
  else if (scale)
    calibration_text("No torque scale was found, and none is kept.", ui.colours.bad);
  else if (view.asks())
    calibration_text(question_text(view, calibration.capabilities()), ui.colours.text);
  else
    calibration_text(view.device == DeviceState::ready ? "It pulls ..." : "Waits for the device ...", ui.colours.text);
  ImGui::PopFont();
  ImGui::Dummy({1, ui.px(4)});
  if (!view.ended) return draw_calibration_answers(ui, calibration);
  const auto& scale = calibration.scale();
  if (scale && !*scale) return calibration_text(scale->error().message(), ui.colours.bad);
  calibration_text(calibration.rehearsal() ? "A rehearsal: nothing is kept." : calibration.kept_text(),
                   ui.colours.text_dim);
}

/// Read against asked, with the line of the scale in use and, once there are readings, theirs.
void draw_readings_plot(const UiContext& ui, const CalibrationView& view) {
  constexpr double kMostAsked = 1.1;
  double most = kMostAsked, both = 0.0, asked2 = 0.0;
  for (std::size_t i = 0; i < view.reading_count; ++i) {
    const FalconReading& r = view.readings[i];
    most = std::max(most, 1.1 * r.read_n);
    both += r.asked_n * r.read_n;
    asked2 += r.asked_n * r.asked_n;
  }
  const float left = ui.px(44), below = ui.px(34), width = std::min(ImGui::GetContentRegionAvail().x, ui.px(420));
  const float height = ui.px(210);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 origin{at.x + left, at.y + height - below};
  const ImVec2 top{at.x + width - ui.px(8), at.y + ui.px(6)};
  const auto place = [&](double asked, double read) {
    return ImVec2(origin.x + static_cast<float>(asked / kMostAsked) * (top.x - origin.x),
                  origin.y + static_cast<float>(read / most) * (top.y - origin.y));
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  const auto text = [&](ImVec2 where, const std::string& what, float right = 0.0f) {
    draw.AddText(font, font->FontSize,
                 {where.x - right * font->CalcTextSizeA(font->FontSize, 1e9f, 0, what.c_str()).x, where.y},
                 ui.colours.text_dim, what.c_str());
  };
  draw.AddRectFilled({origin.x, top.y}, {top.x, origin.y}, ui.colours.plot);
  const double step = most > 2.2 ? 1.0 : 0.5;
  for (double y = 0.0; y <= most + 1e-9; y += step) {
    draw.AddLine(place(0.0, y), place(kMostAsked, y), ui.colours.grid);
    text({origin.x - ui.px(5), place(0.0, y).y - 0.5f * font->FontSize}, printed("%.1f", y), 1.0f);
  }
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    draw.AddLine(place(x, 0.0), place(x, most), ui.colours.grid);
    text({place(x, 0.0).x, origin.y + ui.px(2)}, printed("%.2g", x), 0.5f);
  }
  text({0.5f * (origin.x + top.x), origin.y + ui.px(3) + font->FontSize}, "asked for, N", 0.5f);
  text({origin.x + ui.px(5), top.y + ui.px(2)}, "read, N");
  const double reach = std::min(kMostAsked, most);
  draw.AddLine(place(0.0, 0.0), place(reach, reach), ui.colours.text_faint, ui.px(1));
  if (asked2 > 0.0) {
    const double slope = both / asked2, end = std::min(kMostAsked, most / slope);
    draw.AddLine(place(0.0, 0.0), place(end, slope * end), ui.colours.accent, ui.px(1.5f));
  }
  for (std::size_t i = 0; i < view.reading_count; ++i)
    draw.AddCircleFilled(place(view.readings[i].asked_n, view.readings[i].read_n), ui.px(4), ui.colours.accent);
  ImGui::Dummy({width, height});
}

void draw_calibration_now(const UiContext& ui, const CalibrationModel& calibration) {
  const CalibrationView& view = calibration.view();
  const ForceCapabilities& can = calibration.capabilities();
  const std::string serial = calibration.serial();
  fact(ui, can.name.c_str(), serial.empty() ? "no serial number" : serial);
  fact(ui, "State", to_string(view.device));
  const Vec3 p = 0.1 * glm::round(1e4 * view.position_m) + Vec3(0.0);  // never "-0.0"
  const bool in_middle = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= 1e3 * ForceCalibration::kMiddle_m;
  fact(ui, "Position", printed("%.1f %.1f %.1f", p.x, p.y, p.z), "mm",
       in_middle ? ui.colours.text : ui.colours.warning);
  fact(ui, "Of the middle, at the most", printed("%.0f", 1e3 * ForceCalibration::kMiddle_m), "mm");
  fact(ui, "Force sent", printed("%.3f", glm::length(view.sent_n)), "N");
  fact(ui, "Counts for 1 N m, to begin with", printed("%.0f", calibration.used_scale()));
  if (calibration.rehearsal()) return;
  ImGui::Dummy({1, ui.px(4)});
  calibration_text("Keep a hand on its power switch: it may hold its last force when this program dies.",
                   ui.colours.warning);
}

}  // namespace

void draw_calibration_page(const UiContext& ui, CalibrationModel& calibration) {
  if (!calibration.open()) return;
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = room > ui.px(640) ? 2 : 1;
  if (calibration.under_way()) draw_calibration_stop(ui, calibration);
  draw_calibration_question(ui, calibration);
  ImGui::Dummy({1, ui.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(ui.px(12), 0));
  if (ImGui::BeginTable("##calibration", columns, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoPadOuterX,
                        {std::min(room, ui.px(1000)), 0})) {
    ImGui::TableNextColumn();
    draw_calibration_steps(ui, calibration);
    ImGui::Dummy({1, ui.px(8)});
    draw_calibration_now(ui, calibration);
    ImGui::TableNextColumn();
    draw_readings_plot(ui, calibration.view());
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
}

}  // namespace tangent

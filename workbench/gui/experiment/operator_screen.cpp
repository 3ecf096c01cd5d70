#include "workbench/gui/experiment/operator_screen.h"

#include "workbench/gui/experiment/operator_plots.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

namespace tangent {
namespace {

constexpr ImGuiWindowFlags kFixedPart = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                        ImGuiWindowFlags_NoNav;

ImU32 ink_of(const UiContext& ui, StatusLine::Level level) {
  switch (level) {
    case StatusLine::Level::good:
      return ui.colours.good;
    case StatusLine::Level::warning:
      return ui.colours.warning;
    case StatusLine::Level::bad:
      return ui.colours.bad;
    case StatusLine::Level::plain:
      break;
  }
  return ui.colours.text;
}

void title(const UiContext& ui, const char* text) {
  ImGui::Dummy({1, ui.px(4)});
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y}, ui.colours.border);
  ImGui::Dummy({1, ui.px(1)});
}

void words(const std::string& text, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// A word in a frame of its colour.
void badge(const UiContext& ui, const std::string& text, ImU32 colour) {
  ImGui::SameLine(0, ui.px(10));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRect({at.x, at.y}, {at.x + size.x + ui.px(12), at.y + ImGui::GetFrameHeight()}, colour,
                                      ui.px(3), 0, ui.px(1.2f));
  ImGui::SetCursorScreenPos({at.x + ui.px(6), at.y});
  ImGui::AlignTextToFramePadding();
  words(text, colour);
  ImGui::SameLine(0, ui.px(6));
  ImGui::Dummy({0, 0});
}

constexpr const char* kPilotRun = "pilot run";

/// With the gap before it.
float badge_width(const UiContext& ui, const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x + ui.px(28);
}

/// Too narrow for names and buttons in one line, and for three columns.
bool is_narrow(const UiContext& ui, float width) { return width < ui.px(860); }
float bar_height(const UiContext& ui, float width) { return is_narrow(ui, width) ? ui.px(78) : ui.px(44); }

bool filled_button(const UiContext& ui, const char* path, const char* text, ImU32 fill, ImU32 letters, ImVec2 size) {
  ImGui::PushStyleColor(ImGuiCol_Button, fill);
  ImGui::PushStyleColor(ImGuiCol_Text, letters);
  const bool pressed = ImGui::Button((std::string(text) + "##" + path).c_str(), size);
  ImGui::PopStyleColor(2);
  ui.items.note_last(path);
  return pressed;
}

/// Red, with what to do. Returns its height.
float draw_fault(const UiContext& ui, const OperatorScreen& screen, float y, float width) {
  if (screen.fault.empty()) return 0.0f;
  const std::string& text = screen.fault;
  const float room = width - ui.px(28);
  const float height =
      ui.fonts.strong->CalcTextSizeA(ui.fonts.strong->FontSize, 1e9f, room, text.c_str()).y + ui.px(14);
  ImGui::SetNextWindowPos({0, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.bad);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(14), ui.px(7)));
  ImGui::Begin("##fault", nullptr, kFixedPart);
  ImGui::PushFont(ui.fonts.strong);
  words(text, ui.colours.on_bad);
  ImGui::PopFont();
  ui.items.note("experiment/fault", {0, y}, {width, y + height});
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return height;
}

void begin_part(const UiContext& ui, const char* name, ImVec2 at, ImVec2 size) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(10), ui.px(4)));
  ImGui::Begin(name, nullptr, kFixedPart & ~ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar();
}

void draw_stages(const UiContext& ui, const OperatorScreen& screen) {
  for (const ExperimentStage& stage : screen.stages) {
    const std::string count = stage.of > 0     ? printed("%d of %d", stage.done, stage.of)
                              : stage.over     ? printed("%d, over", stage.done)
                              : stage.now      ? printed("%d so far", stage.done)
                              : stage.done > 0 ? std::to_string(stage.done)
                                               : std::string("to come");
    fact(ui, stage.name.c_str(), (stage.now ? "now: " : "") + count, "",
         stage.now    ? ui.colours.accent
         : stage.over ? ui.colours.text
                      : ui.colours.text_dim);
  }
}

}  // namespace

bool OperatorPanel::prepare(Theme theme, float scale) {
  scale = std::clamp(scale, 0.5f, 6.0f);
  const bool fonts = scale != scale_;
  if (fonts || theme != theme_) apply_theme(theme, scale);
  theme_ = theme;
  if (!fonts) return false;
  std::vector<std::string> missing;
  fonts_ = load_fonts(scale, missing);
  scale_ = scale;
  return true;
}

ImVec4 OperatorPanel::ground() const { return ImGui::ColorConvertU32ToFloat4(theme_colours(theme_).panel); }

void OperatorPanel::draw_bar(const UiContext& ui, const OperatorScreen& screen, float width, OperatorWishes& wishes) {
  const bool narrow = is_narrow(ui, width);
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({width, bar_height(ui, width)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(10), ui.px(8)));
  ImGui::Begin("##bar", nullptr, kFixedPart);
  ImGui::PopStyleVar();
  const float high = ui.px(28), stop = ui.px(140), pause = ui.px(100), end = ui.px(120);
  const std::string simulated = screen.simulated.empty() ? "" : "simulated: " + screen.simulated;
  const float badges =
      (screen.pilot ? badge_width(ui, kPilotRun) : 0.0f) + (simulated.empty() ? 0.0f : badge_width(ui, simulated));
  const float room = narrow ? width - badges - ui.px(44) : width - stop - pause - end - badges - ui.px(60);
  ImGui::SetCursorPosY(ui.px(11));
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(fitted(ui.fonts.strong, "Participant " + screen.participant, 0.45f * room).c_str());
  ImGui::PopFont();
  ImGui::SameLine(0, ui.px(12));
  ImGui::TextUnformatted(fitted(ui.fonts.text, screen.protocol, 0.5f * room).c_str());
  if (screen.pilot) badge(ui, kPilotRun, ui.colours.warning);
  if (!simulated.empty()) badge(ui, simulated, ui.colours.warning);
  ImGui::SetCursorPos({width - stop - pause - end - ui.px(26), narrow ? ui.px(42) : ui.px(8)});
  if (ImGui::Button(ending_ ? "End now##end" : "End session##end", {end, high})) {
    wishes.end = ending_;
    ending_ = !ending_;
  }
  items_.note_last("experiment/end");
  tooltip(ui, "Two clicks. Every answer given is kept, and the same command goes on from there another time");
  ImGui::SameLine(0, ui.px(8));
  ImGui::BeginDisabled(!screen.paused);
  wishes.resume =
      filled_button(ui, "experiment/resume", "Resume", ui.colours.accent_fill, ui.colours.text, {pause, high});
  ImGui::EndDisabled();
  tooltip(ui, "Clears faults, arms, and begins the trial again that was cut");
  ImGui::SameLine(0, ui.px(8));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ui.colours.stop_hovered);
  filled_button(ui, "experiment/stop", "Stop force (Esc)", ui.colours.stop, IM_COL32_WHITE, {stop, high});
  if (ImGui::IsItemActivated()) wishes.stop = true;  // when it is pressed, not when it is let go
  ImGui::PopStyleColor();
  tooltip(ui, "No force, at once, and a pause: the participant is asked to wait");
  ImGui::End();
}

void OperatorPanel::draw_device(const UiContext& ui, const OperatorScreen& screen, const OperatorWishes&) {
  title(ui, "Device and safety");
  fact(ui, "Force", screen.force_on ? "on" : "off", "", screen.force_on ? ui.colours.good : ui.colours.warning);
  for (const StatusLine& line : screen.device) fact(ui, line.name.c_str(), line.text, "", ink_of(ui, line.level));
  title(ui, "The participant reads");
  words(screen.prompt, ui.colours.text);
  title(ui, "Data");
  words(screen.data, ui.colours.text_dim);
  tooltip(ui, "An answer is a row of this file, on the disk before the next stimulus is shown");
}

void OperatorPanel::draw_now(const UiContext& ui, const OperatorScreen& screen, OperatorWishes& wishes) {
  title(ui, "Now");
  fact(ui, "Answers", printed("%d of about %d", screen.trial, screen.expected));
  if (covered_) {
    words("Stimulus, condition and answers are covered, so that nobody reads them who must not.", ui.colours.text_dim);
  } else {
    fact(ui, "Stimulus", screen.stimulus);
    fact(ui, "Condition", screen.condition);
  }
  bool covered = covered_;
  if (toggle_button(ui, "experiment/cover", "Cover", covered,
                    "Hides stimulus, condition and answers: where the participant sees this screen, or you should not "
                    "know"))
    covered_ = covered;
  if (!screen.participant_has_keys && screen.participant_window) {
    ImGui::SameLine(0, ui.px(8));
    if (filled_button(ui, "experiment/keys", "Give the keyboard to the participant", ui.colours.warning,
                      packed(ui.palette.panel), {0, 0}))
      wishes.give_keys = true;
    tooltip(ui, "Keys go to this window now, so that the participant's answers would be lost");
  }
  title(ui, "Next");
  words(screen.next, ui.colours.text);
  title(ui, "Progress");
  if (covered_)
    words("covered", ui.colours.text_dim);
  else
    draw_stages(ui, screen);
}

void OperatorPanel::draw_notes(const UiContext& ui, const OperatorScreen& screen, OperatorWishes& wishes) {
  title(ui, "Notes");
  const float line = ImGui::GetFrameHeightWithSpacing();
  const float room = std::max(2.0f * line, ImGui::GetContentRegionAvail().y - 1.3f * line);
  ImGui::BeginChild("notes", {0, room});
  for (const std::string& note : screen.notes) words(note, ui.colours.text);
  if (screen.notes.empty()) words("None so far.", ui.colours.text_dim);
  if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 2.0f * line) ImGui::SetScrollHereY(1.0f);
  ImGui::EndChild();
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##note", "Write a note, then Enter", &note_, ImGuiInputTextFlags_EnterReturnsTrue)) {
    wishes.note = std::exchange(note_, {});
    wishes.give_keys = screen.participant_window;
  }
  items_.note_last("experiment/note");
  tooltip(ui, "Kept with its time in the data");
}

void OperatorPanel::draw_plots(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size) {
  begin_part(ui, "##plots", at, size);
  const ImVec2 from = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const bool staircase = !screen.staircase.empty() && !covered_;
  if (room.x > 2.5f * room.y && staircase) {  // a flat place: side by side
    const float half = 0.5f * (room.x - ui.px(6));
    draw_force_trace(ui, screen, from, {half, room.y});
    draw_staircase(ui, screen, {from.x + half + ui.px(6), from.y}, {half, room.y});
  } else {
    const float force = staircase ? 0.45f * room.y : room.y;
    draw_force_trace(ui, screen, from, {room.x, force});
    if (staircase) draw_staircase(ui, screen, {from.x, from.y + force + ui.px(6)}, {room.x, room.y - force - ui.px(6)});
  }
  ImGui::End();
}

OperatorWishes OperatorPanel::frame(const OperatorScreen& screen, ImVec2 size, double now_s) {
  OperatorWishes wishes;
  const ImGuiIO& io = ImGui::GetIO();
  const int escape = io.KeyMap[ImGuiKey_Escape];
  wishes.stop = escape >= 0 && io.KeysDown[escape] && io.KeysDownDuration[escape] < 0.0f;
  ImGui::NewFrame();
  items_.begin_frame();
  const UiContext ui{items_, typing_, resting_, theme_colours(theme_), palette(theme_), fonts_, open_sections_,
                     scale_, now_s,   nullptr};
  draw_bar(ui, screen, size.x, wishes);
  const float bar = bar_height(ui, size.x), top = bar + draw_fault(ui, screen, bar, size.x), high = size.y - top;
  const bool narrow = is_narrow(ui, size.x);
  const float side = narrow ? 0.5f * size.x : std::min(ui.px(300), 0.28f * size.x);
  const float words_high = narrow ? 0.62f * high : high;  // then the plots are below
  begin_part(ui, "##device", {0, top}, {side, words_high});
  draw_device(ui, screen, wishes);
  ImGui::End();
  if (narrow)
    draw_plots(ui, screen, {0, top + words_high}, {size.x, high - words_high});
  else
    draw_plots(ui, screen, {side, top}, {size.x - 2.0f * side, high});
  begin_part(ui, "##now", {size.x - side, top}, {side, words_high});
  draw_now(ui, screen, wishes);
  draw_notes(ui, screen, wishes);
  ImGui::End();
  ImGui::Render();
  return wishes;
}

}  // namespace tangent

// The recording that is open, and the one that is made.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

std::string count_of(std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); }

void draw_opened(const UiContext& ui, TimeModel& time) {
  const OpenedRecording& recording = *time.recording();
  const RecordingInfo& info = recording.info();
  ImGui::TextUnformatted(recording.path().filename().c_str());
  ui.items.note_last("recording/name");
  tooltip(ui, recording.path().string());
  fact(ui, "Length", printed("%.3f", info.last_s - info.first_s), "s");
  fact(ui, "Ticks", count_of(info.ticks));
  if (info.missing > 0) fact(ui, "Missing", count_of(info.missing), "", ui.colours.warning);
  fact(ui, "Recorded", info.started_utc);
  fact(ui, "By version", info.version);
  if (!info.closed) fact(ui, "End", "cut short", "", ui.colours.warning);
  const HistorySnapshot& page = recording.page().records;
  fact(ui, "Loaded", printed("%.1f", static_cast<double>(page.size()) * recording.tick_period_s()), "s");
  tooltip(ui,
          "Ticks around the one in view that plots, what-if, sweep and comparison work on. The others are known by "
          "the minima and maxima that the file keeps");
  const std::string why = recording.unsolvable();
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextDisabled("%s", why.empty() ? "Its ticks can be solved again" : ("Not solved again: " + why).c_str());
  ui.items.note_last("recording/solvable");
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  if (text_button(ui, "recording/close", "Close", "Back to live (End)")) time.go_live();
}

void draw_made(const UiContext& ui, RecordModel& record) {
  const RecorderStatus status = record.status();
  if (record.file().empty()) return;
  ImGui::TextUnformatted(record.file().filename().c_str());
  tooltip(ui, record.file().string());
  fact(ui, record.recording() ? "Recording" : "Recorded", count_of(status.written), "ticks");
  fact(ui, "Missing", count_of(status.missing), "",
       status.missing > 0 ? std::optional(ui.colours.warning) : std::nullopt);
  tooltip(ui, "Ticks that the file lacks: it could not be written for too long");
  if (status.trouble.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.bad);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(status.trouble.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ui.items.note_last("recording/trouble");
}

}  // namespace

void draw_recording_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Recording", state.open)) return;
  RecordModel& record = model.record();
  const bool on = record.recording();
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.stop);
  const bool pressed = text_button(ui, "recording/record", on ? "Stop recording" : "Record",
                                   "Every tick from now on, into a new file in the folder the program was started in "
                                   "(R); the command `record to FILE` names one");
  if (on) ImGui::PopStyleColor();
  if (pressed) on ? record.stop() : record.start();
  ImGui::SameLine();
  if (text_button(ui, "recording/history", "History", "All that is in the history, into a new file"))
    record.write_history();
  ImGui::SameLine();
  if (text_button(ui, "recording/selection", "A to B", "The ticks between the cursors A and B, into a new file"))
    record.write_selection();
  draw_made(ui, record);
  if (model.recordings().opening())
    ImGui::TextDisabled("opening %s", model.recordings().opening_path().filename().c_str());
  if (model.time().recording() != nullptr) draw_opened(ui, model.time());
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent

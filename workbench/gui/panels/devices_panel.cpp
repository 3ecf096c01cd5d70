// The devices, their state, the safety gate, and the simulated hand.
#include "core/io/csv_table.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tangent {

namespace {

ImU32 state_ink(const UiContext& ui, DeviceState state) {
  switch (state) {
    case DeviceState::ready:
      return ui.colours.good;
    case DeviceState::faulted:
      return ui.colours.bad;
    case DeviceState::absent:
      return ui.colours.text_faint;
    default:
      return ui.colours.warning;
  }
}

std::string state_text(DeviceState state, DeviceFault fault) {
  return std::string(to_string(state)) + (fault == DeviceFault::none ? "" : std::string(": ") + to_string(fault));
}

/// State of the devices at the tick in view, live or past.
DeviceTelemetry seen(const AppModel& model) {
  const ServoRecord* record = model.time().tick().record();
  if (model.time().paused() && record != nullptr) return record->device;
  DeviceTelemetry now;
  const SessionStatus& status = model.devices().status();
  now.force_state = status.force_state;
  now.force_fault = status.force_fault;
  now.display_state = status.display_state;
  now.display_fault = status.display_fault;
  now.gate_state = status.servo.gate_state;
  now.gate_fault = status.servo.gate_fault;
  return now;
}

void draw_force_device(const UiContext& ui, const AppModel& model) {
  const ForceCapabilities* can = model.devices().session()->force_capabilities();
  const DeviceTelemetry status = seen(model);
  fact(ui, can != nullptr ? can->name.c_str() : "Force device", state_text(status.force_state, status.force_fault), "",
       state_ink(ui, status.force_state));
  if (can == nullptr) return;
  tooltip(ui,
          printed("Peak %.1f N, continuous %.1f N along %s; stable up to %.0f N/m and %.0f N s/m; resolution %.0f "
                  "\u00b5m; apparent mass %.0f g; rotations sensed: %s, buttons %d%s",
                  can->peak_force_n, can->continuous_force_n, pushed_axes(*can).c_str(), can->largest_stiffness_n_per_m,
                  can->largest_damping_n_s_per_m, can->position_resolution_m * 1e6, can->apparent_mass_kg * 1e3,
                  sensed_rotations(*can).c_str(), can->buttons, can->simulated ? "; simulated" : ""));
}

void draw_display(const UiContext& ui, const AppModel& model) {
  const DisplayCapabilities* can = model.devices().session()->display_capabilities();
  const DeviceTelemetry status = seen(model);
  fact(ui, can != nullptr ? can->name.c_str() : "Contact display",
       state_text(status.display_state, status.display_fault), "", state_ink(ui, status.display_state));
  if (can == nullptr) return;
  tooltip(ui, printed("Travel %.0f mm, resolution %.1f \u00b5m, bandwidth %.0f Hz%s", can->travel_m * 1e3,
                      can->resolution_m * 1e6, can->bandwidth_hz, can->simulated ? ", simulated" : ""));
}

void draw_gate(const UiContext& ui, AppModel& model) {
  const ServoStatus& servo = model.devices().status().servo;
  const DeviceTelemetry device = seen(model);
  const bool armed = device.gate_state == GateState::armed;
  const bool faulted = device.gate_state == GateState::faulted;
  const std::string text =
      std::string(to_string(device.gate_state)) + (faulted ? std::string(": ") + to_string(device.gate_fault) : "");
  fact(ui, "Safety gate", text, "", armed ? ui.colours.good : faulted ? ui.colours.bad : ui.colours.warning);
  if (model.time().paused()) {
    for (std::size_t i = 0; i < kGateActionCount; ++i) {
      if ((device.gate_actions >> i) & 1u) fact(ui, to_string(static_cast<GateAction>(i)), "in this tick");
    }
    return;
  }
  for (std::size_t i = 0; i < kGateActionCount; ++i) {
    if (servo.gate_counts[i] == 0) continue;
    fact(ui, to_string(static_cast<GateAction>(i)),
         printed("%llu", static_cast<unsigned long long>(servo.gate_counts[i])), "ticks");
  }
}

/// Numbers of the tick in view, while paused.
void draw_tick(const UiContext& ui, const TimeModel& time) {
  const ServoRecord& r = *time.tick().record();
  const auto length = [](const Vec3& v) { return glm::length(v); };
  fact(ui, "Force computed", printed("%.3f", length(r.tick.output.force_n)), "N",
       packed(readable(ui.palette, ui.palette.force_computed)));
  tooltip(ui, "By the solver, before the safety gate");
  fact(ui, "Force felt", printed("%.3f", length(r.device.force_command_n)), "N",
       packed(readable(ui.palette, ui.palette.force_magnitude)));
  tooltip(ui, "What the safety gate lets through to the device in this tick");
  fact(ui, "Force at the sample", printed("%.3f", length(r.device.force_rendered_n)), "N");
  tooltip(ui, "Applied by the device while this tick's position was measured: sent a tick or more before");
  fact(ui, "Display commanded / measured",
       printed("%.3f / %.3f", r.device.cld_command_m * 1e3, r.device.cld_measured_m * 1e3), "mm");
  fact(ui, "Missed deadlines before", printed("%u", r.missed_deadlines));
  if (r.tick_ns <= 0.0) return;  // simulated time
  fact(ui, "Tick / solver", printed("%.1f / %.1f", r.tick_ns * 1e-3, r.tick.solve_ns * 1e-3), "\u00b5s");
  fact(ui, "Lateness", printed("%.0f", r.lateness_ns * 1e-3), "\u00b5s");
}

void draw_servo(const UiContext& ui, const DeviceModel& devices) {
  const ServoStatus& servo = devices.status().servo;
  fact(ui, "Rate", printed("%.1f", servo.rate_hz), "Hz");
  fact(ui, "Tick p50 / p99", printed("%.1f / %.1f", servo.tick_p50_ns * 1e-3, servo.tick_p99_ns * 1e-3), "\u00b5s");
  tooltip(ui, "Whole tick: exchange with the devices, solver, safety gate");
  fact(ui, "Tick worst", printed("%.1f", servo.tick_worst_ns * 1e-3), "\u00b5s");
  fact(ui, "Lateness p99 / worst", printed("%.0f / %.0f", servo.lateness_p99_ns * 1e-3, servo.lateness_worst_ns * 1e-3),
       "\u00b5s");
  fact(ui, "Late ticks", printed("%llu", static_cast<unsigned long long>(servo.late_ticks)));
  fact(ui, "Missed deadlines", printed("%llu", static_cast<unsigned long long>(servo.missed_deadlines)));
  if (!devices.status().realtime_note.empty()) {
    ImGui::PushFont(ui.fonts.small);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.text_dim);
    ImGui::TextWrapped("%s", devices.status().realtime_note.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
  }
}

void draw_hand(const UiContext& ui, AppModel& model) {
  HandSettings hand = model.devices().session()->hand();
  bool follows = model.devices().hand_follows_mouse();
  if (toggle_button(
          ui, "devices/hand_follows_mouse", "Hand follows mouse", follows,
          "Drag on the surface in the 3D view to lead the simulated hand (M). Off: it explores the mesh by itself"))
    model.devices().set_hand_follows_mouse(follows);
  const float width = ImGui::GetContentRegionAvail().x, label = ui.px(116);
  const auto row = [&](const char* title, const char* path, double& value, double most, double scale, const char* unit,
                       const char* doc) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(title);
    tooltip(ui, doc);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + label);
    const auto result = value_field(ui, path, {width - label, value / most, short_number(value / scale), unit});
    tooltip(ui, doc);
    if (result.slid) value = std::round(*result.slid * most / scale * 100.0) / 100.0 * scale;
    if (!result.typed) return;
    char* end = nullptr;
    const double typed = std::strtod(result.typed->c_str(), &end);
    if (end != result.typed->c_str() && std::isfinite(typed))
      value = std::clamp(typed * scale, 0.0, most);
    else
      model.messages().say(Severity::error, show_text(*result.typed) + " is not a number");
  };
  const HandSettings before = hand;
  row("Hand speed", "devices/hand_speed", hand.speed_m_per_s, 0.5, 1e-3, "mm/s",
      "Along the exploration path; 0: rests");
  row("Hand depth", "devices/hand_press", hand.press_m, 10e-3, 1e-3, "mm",
      "How far inside the surface the hand aims. The rendered force holds the finger back, so it goes less deep");
  if (!(hand == before)) model.devices().session()->set_hand(hand);
}

}  // namespace

void draw_devices_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Devices", state.open)) return;
  if (model.devices().session() == nullptr) {
    ImGui::TextDisabled("No session");
    return;
  }
  const bool past = model.time().paused() && model.time().tick().record() != nullptr;
  if (past)
    fact(ui, "At tick", printed("%llu", static_cast<unsigned long long>(model.time().tick().record()->tick.tick)), "",
         ui.colours.accent);
  draw_force_device(ui, model);
  draw_display(ui, model);
  draw_gate(ui, model);
  if (past)
    draw_tick(ui, model.time());
  else
    draw_servo(ui, model.devices());
  draw_hand(ui, model);
  draw_guard(ui, model.guard());
  draw_placement(ui, model);
  toggle_button(ui, "devices/monitor", "Monitor", model.view().device_monitor,
                "Rates, histograms, limits and faults, in place of the 3D view");
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent

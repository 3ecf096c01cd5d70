// The device monitor, in place of the 3D view: states, rates, histograms, limits and clamps, the fault log, raw values,
// and buttons for the operator.
#include "core/io/csv_table.h"
#include "workbench/gui/panels/monitor_histogram.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace tangent {

namespace {

std::string count_text(std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); }

ImU32 monitor_ink(const UiContext& ui, DeviceState state) {
  if (state == DeviceState::ready) return ui.colours.good;
  if (state == DeviceState::faulted) return ui.colours.bad;
  return state == DeviceState::absent ? ui.colours.text_faint : ui.colours.warning;
}

std::string monitor_text(DeviceState state, DeviceFault fault) {
  return std::string(to_string(state)) + (fault == DeviceFault::none ? "" : std::string(": ") + to_string(fault));
}

void heading(const UiContext& ui, const char* title) {
  ImGui::Dummy({1, ui.px(6)});
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(title);
  ImGui::PopFont();
  // Drawn within the column: ImGui's separator would reach into the next one.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y}, ui.colours.border);
  ImGui::Dummy({1, ui.px(1)});
}

void dim_text(const UiContext& ui, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.text_dim);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void warning_text(const UiContext& ui, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.warning);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

std::string known_newtons(double force_n) { return force_n > 0.0 ? printed("%.1f", force_n) : "not known"; }

void draw_states(const UiContext& ui, DeviceModel& devices) {
  const SessionStatus& s = devices.status();
  Session& session = *devices.session();
  const ForceCapabilities* force = session.force_capabilities();
  const DisplayCapabilities* display = session.display_capabilities();
  fact(ui, force != nullptr ? force->name.c_str() : "Force device", monitor_text(s.force_state, s.force_fault), "",
       monitor_ink(ui, s.force_state));
  fact(ui, display != nullptr ? display->name.c_str() : "Contact display",
       monitor_text(s.display_state, s.display_fault), "", monitor_ink(ui, s.display_state));
  const bool faulted = s.servo.gate_state == GateState::faulted;
  fact(ui, "Safety gate",
       std::string(to_string(s.servo.gate_state)) + (faulted ? std::string(": ") + to_string(s.servo.gate_fault) : ""),
       "",
       faulted                                  ? ui.colours.bad
       : s.servo.gate_state == GateState::armed ? ui.colours.good
                                                : ui.colours.warning);
  ImGui::Dummy({1, ui.px(2)});
  for (const std::string& name : session.without_timeout())
    warning_text(ui, name + " goes on with its last command when this program dies: its firmware has no time-out.");
  if (session.needs_yes() && text_button(ui, "monitor/accept_no_timeout", "Use it anyway",
                                         "Nothing is armed until you confirm. Keep a hand on its power switch"))
    session.accept_no_timeout();
  const bool fault = devices.faulted();
  if (fault) ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.bad);
  if (fault) ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.on_bad);
  if (text_button(ui, "monitor/arm", fault ? "Clear fault and arm" : "Arm",
                  "One attempt: clears faults, homes what is not homed, waits until the finger is off the surface, "
                  "and ramps the force in"))
    session.arm();
  if (fault) ImGui::PopStyleColor(2);
  ImGui::SameLine();
  if (text_button(ui, "monitor/home", "Home", "Stops the force and homes both devices")) session.home();
}

void draw_limits(const UiContext& ui, const DeviceModel& devices) {
  const GateLimits limits = devices.session()->gate_limits();
  const ServoStatus& servo = devices.status().servo;
  heading(ui, "Limits");
  fact(ui, "Peak / continuous force",
       printed("%.1f / ", limits.peak_force_n) + known_newtons(limits.continuous_force_n), "N");
  if (const auto* can = devices.session()->force_capabilities(); can != nullptr) {
    fact(ui, "Force axes / rotations sensed", pushed_axes(*can) + " / " + sensed_rotations(*can));
    const auto known = [](double value) { return value > 0.0 ? printed("%.0f", value) : std::string("-"); };
    fact(ui, "Largest stiffness", known(can->largest_stiffness_n_per_m), "N/m");
    fact(ui, "Largest damping", known(can->largest_damping_n_s_per_m), "N s/m");
    if (!(can->frame == DeviceFrame{})) dim_text(ui, "Its frame in the world: " + frame_text(can->frame));
  }
  fact(ui, "Change of force", printed("%.0f", limits.slew_n_per_s), "N/s");
  const Vec3 size = 2e3 * limits.workspace_half_size_m;
  fact(ui, "Workspace", printed("%.0f x %.0f x %.0f", size.x, size.y, size.z), "mm");
  fact(ui, "Display travel", printed("%.1f", limits.display_travel_m * 1e3), "mm");
  const ControllerSettings& controller = devices.session()->preset().controller;
  const double end = 0.5 * limits.display_travel_m;
  fact(ui, "Display targets",
       printed("%.1f to %.1f", std::max(controller.lowest_m, -end) * 1e3, std::min(controller.highest_m, end) * 1e3),
       "mm");
  fact(ui, "Oldest sample / longest tick", printed("%.0f / %.0f", limits.stale_s * 1e3, longest_tick_s(limits) * 1e3),
       "ms");
  const auto timeout = [](double s) { return s > 0.0 ? printed("%.0f ms", s * 1e3) : std::string("none"); };
  if (const auto* can = devices.session()->force_capabilities())
    fact(ui, "Time-out, force device", timeout(can->firmware_timeout_s));
  if (const auto* can = devices.session()->display_capabilities())
    fact(ui, "Time-out, display", timeout(can->firmware_timeout_s));
  heading(ui, "Gate");
  fact(ui, "Faults", count_text(servo.gate_faults), "", servo.gate_faults > 0 ? ui.colours.bad : ui.colours.text);
  for (std::size_t i = 0; i < kGateActionCount; ++i) {
    fact(ui, to_string(static_cast<GateAction>(i)), count_text(servo.gate_counts[i]), "ticks",
         servo.gate_counts[i] > 0 ? ui.colours.text : ui.colours.text_faint);
  }
}

void draw_raw(const UiContext& ui, const DeviceModel& devices) {
  heading(ui, "Raw values");
  const History& history = devices.session()->history();
  if (history.empty()) return dim_text(ui, "No tick yet");
  const ServoRecord& r = history.newest();
  const Vec3 p = r.tick.input.finger.position * 1e3, f = r.device.force_command_n;
  fact(ui, "Position", printed("%.3f %.3f %.3f", p.x, p.y, p.z), "mm");
  fact(ui, "Force felt", printed("%.3f %.3f %.3f", f.x, f.y, f.z), "N",
       colour(readable(ui.palette, ui.palette.force_magnitude)));
  tooltip(ui, "What the safety gate lets through to the device");
  fact(ui, "Energy, made by the loop", printed("%.3f", r.device.energy_j * 1e3), "mJ");
  tooltip(ui,
          "Observed by the safety gate: force sent times motion measured. Below zero the hand has stored it in the "
          "surface; at 5 mJ in half a second the gate stops");
  fact(ui, "Roller, measured / commanded",
       printed("%.4f / %.4f", r.device.cld_measured_m * 1e3, r.device.cld_command_m * 1e3), "mm");
  if (const auto* can = devices.session()->force_capabilities(); can != nullptr && can->buttons > 0) {
    std::string pressed;
    for (int i = 0; i < can->buttons; ++i) pressed += ((r.device.buttons >> i) & 1u) != 0 ? '1' : '0';
    fact(ui, "Buttons, the first is the clutch", pressed);
  }
  fact(ui, "Age of position / roller", printed("%.2f / %.2f", r.device.force_age_s * 1e3, r.device.display_age_s * 1e3),
       "ms");
}

/// What the drivers say of their cables, libraries and services; null: nothing.
struct MonitorLinks {
  std::optional<LinkReport> force, display;

  explicit MonitorLinks(const Session& session) {
    LinkReport link;
    if (session.force_report(link)) force = link;
    link = {};
    if (session.display_report(link)) display = link;
  }
};

void draw_link(const UiContext& ui, const char* title, const LinkReport& link) {
  heading(ui, title);
  fact(ui, "Connection", link.connected ? "connected" : "not connected", "",
       link.connected ? ui.colours.good : ui.colours.warning);
  if (!link.identity.empty()) dim_text(ui, link.identity);
  if (!link.problem.empty()) warning_text(ui, link.problem);
  if (link.round_trip_us != nullptr && link.round_trip_us->count() > 0)
    fact(
        ui, "Round trip, median / 99 %",
        printed("%.2f / %.2f", 1e-3 * link.round_trip_us->percentile(0.5), 1e-3 * link.round_trip_us->percentile(0.99)),
        "ms");
  if (link.connects + link.packets_in + link.packets_out + link.errors == 0) return;  // no USB, or never connected
  fact(ui, "Packets in / out / control",
       count_text(link.packets_in) + " / " + count_text(link.packets_out) + " / " + count_text(link.controls));
  fact(ui, "Stalls / time-outs / errors",
       count_text(link.stalls) + " / " + count_text(link.time_outs) + " / " + count_text(link.errors));
  fact(ui, "Short / empty packets", count_text(link.short_packets) + " / " + count_text(link.empty_packets));
  fact(ui, "Refused packets", count_text(link.refused_sends));
  fact(ui, "Connections made", count_text(link.connects));
  fact(ui, "Wrong checksums / lost / doubled",
       count_text(link.crc_errors) + " / " + count_text(link.lost) + " / " + count_text(link.doubled));
  fact(ui, "Lost by device / refused", count_text(link.lost_by_device) + " / " + count_text(link.refused));
  if (link.last_packet_bytes == 0) return;
  std::string hex;
  for (std::size_t i = 0; i < link.last_packet_bytes; ++i) hex += printed("%02x ", link.last_packet[i]);
  ImGui::PushFont(ui.fonts.small_number);
  dim_text(ui, hex);
  ImGui::PopFont();
}

void draw_injection(const UiContext& ui, DeviceModel& devices) {
  Session& session = *devices.session();
  const auto* force = session.force_capabilities();
  const auto* display = session.display_capabilities();
  const bool to_force = force != nullptr && force->simulated, to_display = display != nullptr && display->simulated;
  if (!to_force && !to_display) return;
  heading(ui, "Faults of the simulated devices");
  const auto row = [&](const char* title, const char* path, bool is_display) {
    dim_text(ui, title);
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    bool first = true;
    for (const std::string_view name : injected_fault_names()) {
      const std::string text(name);
      // On one line as long as they fit.
      if (!first) ImGui::SameLine();
      const float needed = ImGui::CalcTextSize(text.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
      if (!first && ImGui::GetCursorScreenPos().x + needed > end) ImGui::NewLine();
      first = false;
      if (text_button(ui, std::string(path) + "/" + text, text.c_str(), "Lasts 100 ticks; see what the gate does")) {
        if (const auto kind = injected_fault(name)) session.inject({*kind, 100}, is_display);
      }
    }
  };
  if (to_force) row("Force device", "monitor/inject/force", false);
  if (to_display) row("Contact display", "monitor/inject/display", true);
}

void draw_calibration(const UiContext& ui, AppModel& model) {
  heading(ui, "Calibration of the servo");
  dim_text(ui, "Two places of the roller, measured with a calliper, and the pulses that hold it there.");
  MaestroCalibration c = model.devices().maestro();
  const float width = ImGui::GetContentRegionAvail().x, label = ui.px(140);
  const auto row = [&](const char* title, const char* path, double& value, double scale) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(title);
    ImGui::SameLine(ImGui::GetCursorPosX() + label);
    const auto typed = number_box(ui, path, std::min(ui.px(100), width - label), short_number(value / scale));
    char* end = nullptr;
    const double number = typed ? std::strtod(typed->c_str(), &end) : 0.0;
    if (typed && end != typed->c_str() && std::isfinite(number))
      value = number * scale;
    else if (typed)
      model.messages().say(Severity::error, show_text(*typed) + " is not a number");
  };
  row("Lower place, mm", "monitor/maestro/low_mm", c.low_m, 1e-3);
  row("Its pulse, \u00b5s", "monitor/maestro/low_us", c.low_us, 1.0);
  row("Upper place, mm", "monitor/maestro/high_mm", c.high_m, 1e-3);
  row("Its pulse, \u00b5s", "monitor/maestro/high_us", c.high_us, 1.0);
  if (!(c == model.devices().maestro())) model.devices().calibrate_maestro(c, model.devices().maestro_channel());
}

void draw_log(const UiContext& ui, const DeviceModel& devices) {
  heading(ui, "Log");
  const auto& entries = devices.session()->safety_log().entries();
  if (entries.empty()) return dim_text(ui, "Nothing yet");
  ImFont* number = ui.fonts.small_number;
  constexpr std::size_t kShown = 60;
  std::size_t shown = 0;
  for (auto e = entries.rbegin(); e != entries.rend() && shown < kShown; ++e, ++shown) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImU32 ink = e->kind == SafetyEntry::Kind::fault    ? ui.colours.bad
                      : e->kind == SafetyEntry::Kind::action ? ui.colours.warning
                                                             : ui.colours.text;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddText(number, number->FontSize, {at.x, at.y + ui.px(1)}, ui.colours.text_dim,
                 printed("%9.3f s", e->t_s).c_str());
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {at.x + ui.px(84), at.y}, ink, e->text.c_str());
    ImGui::Dummy({1, ui.fonts.small->FontSize});
  }
}

void draw_state_column(const UiContext& ui, DeviceModel& devices) {
  draw_states(ui, devices);
  draw_limits(ui, devices);
}

/// `room`: height for the histograms.
void draw_rates(const UiContext& ui, const DeviceModel& devices, const MonitorLinks& links, float room) {
  const ServoStatus& servo = devices.status().servo;
  const Session& session = *devices.session();
  fact(ui, "Rate, measured / asked for",
       (servo.rate_hz > 0.0 ? printed("%.1f", servo.rate_hz) : std::string("-")) + printed(" / %.0f", servo.nominal_hz),
       "Hz");
  fact(ui, "Ticks / late ticks", count_text(servo.ticks) + " / " + count_text(servo.late_ticks));
  ImGui::Dummy({1, ui.px(4)});
  const LogHistogram* round_trip = links.display ? links.display->round_trip_us : nullptr;
  const LogHistogram* arrival = links.display ? links.display->arrival_us : nullptr;
  const int shown = 3 + int{round_trip != nullptr} + int{arrival != nullptr};
  const float around = ui.px(42);  // each one's title and axis
  const float height = std::clamp(room / static_cast<float>(shown) - around, ui.px(64), ui.px(240));
  draw_duration_histogram(ui, "Tick to tick", session.period_ns(), 1.0, colour(ui.palette.tick_time), height);
  draw_duration_histogram(ui, "Late by", session.lateness_ns(), 1.0, colour(ui.palette.force_x), height);
  draw_duration_histogram(ui, "Sample to command", session.latency_ns(), 1.0, colour(ui.palette.force_z), height);
  if (round_trip != nullptr)
    draw_duration_histogram(ui, "Round trip", *round_trip, 1e3, colour(ui.palette.cld_commanded), height);
  if (arrival != nullptr)
    draw_duration_histogram(ui, "Between samples", *arrival, 1e3, colour(ui.palette.cld_measured), height);
}

void draw_service_column(const UiContext& ui, AppModel& model, const MonitorLinks& links) {
  if (links.force) draw_link(ui, "Link of the force device", *links.force);
  if (links.display) draw_link(ui, "Link of the display", *links.display);
  draw_injection(ui, model.devices());
  if (model.devices().names().display == "maestro") draw_calibration(ui, model);
  draw_log(ui, model.devices());
}

/// As many columns as fit, each narrow enough to read labels and values together.
void draw_columns(const UiContext& ui, AppModel& model) {
  const MonitorLinks links(*model.devices().session());
  const float room = ImGui::GetContentRegionAvail().x, high = ImGui::GetContentRegionAvail().y;
  const int columns = room > ui.px(1200) ? 3 : room > ui.px(456) ? 2 : 1;
  const float width = std::min(room, static_cast<float>(columns) * ui.px(columns == 3 ? 640 : 600));
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(ui.px(columns == 3 ? 16 : 10), 0));
  if (ImGui::BeginTable("##monitor", columns, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoPadOuterX,
                        {width, 0})) {
    ImGui::TableNextColumn();
    draw_state_column(ui, model.devices());
    if (columns < 3) draw_raw(ui, model.devices());
    ImGui::TableNextColumn();
    // In their own column the histograms take the height left by the values below.
    draw_rates(ui, model.devices(), links, columns == 3 ? high - ui.px(190) : 0.0f);
    if (columns == 3) {
      draw_raw(ui, model.devices());
      ImGui::TableNextColumn();
    }
    draw_service_column(ui, model, links);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
}

/// The guided runs of the force device, or the way back from the one that is open. `narrow`: each has a row of its own.
void draw_guided_buttons(const UiContext& ui, AppModel& model, bool narrow) {
  BringUpModel& bring_up = model.bring_up();
  CalibrationModel& calibration = model.calibration();
  constexpr const char* kBack = "Zero force, then a session without force";
  if (bring_up.open()) {
    if (text_button(ui, "monitor/bring_up_end", "Back to the session", kBack)) bring_up.end();
    return;
  }
  if (calibration.open()) {
    if (text_button(ui, "monitor/calibrate_end", "Back to the session", kBack)) calibration.end();
    return;
  }
  if (text_button(ui, "monitor/bring_up", "Bring up ...",
                  "Step by step from the cable to the first force of the force device. The session ends; nothing "
                  "moves before you say yes"))
    bring_up.begin();
  if (!calibration.possible()) return;
  if (!narrow) ImGui::SameLine();
  if (text_button(ui, "monitor/calibrate", "Calibrate ...",
                  "Its torque scale by a spring scale, step by step; of a simulated device a rehearsal. The session "
                  "ends; nothing pulls before you say yes"))
    calibration.begin();
}

}  // namespace

void draw_device_monitor(const UiContext& ui, AppModel& model, const Rect& rect) {
  if (!model.view().device_monitor) {  // a page that nobody sees pushes nobody
    model.bring_up().end();
    return model.calibration().end();
  }
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(12), ui.px(8)));
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
  ImGui::Begin("##device_monitor", nullptr, flags);
  ImGui::PopStyleVar();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Device monitor");
  ImGui::PopFont();
  const bool narrow = ImGui::GetWindowWidth() < ui.px(480);  // then the second button has a row of its own
  const auto close = [&] {
    ImGui::SameLine(ImGui::GetWindowWidth() - ui.px(80));
    if (text_button(ui, "monitor/close", "Close", "Back to the 3D view")) model.view().device_monitor = false;
  };
  if (narrow) close();
  if (!narrow) ImGui::SameLine(0.0f, ui.px(16));
  draw_guided_buttons(ui, model, narrow);
  if (!narrow) close();
  if (model.bring_up().open()) {
    draw_bring_up_page(ui, model.bring_up());
  } else if (model.calibration().open()) {
    draw_calibration_page(ui, model.calibration());
  } else if (model.devices().session() == nullptr) {
    ImGui::TextDisabled("No session");
  } else {
    draw_columns(ui, model);
  }
  ImGui::End();
}

}  // namespace tangent

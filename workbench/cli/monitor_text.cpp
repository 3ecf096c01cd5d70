#include "workbench/cli/monitor_text.h"

#include "workbench/cli/text_format.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tangent {
namespace {

unsigned long long number(std::uint64_t n) { return n; }

/// Histogram by powers of two, from the first to the last bin that is not empty.
std::string histogram_text(const char* title, const LogHistogram& histogram, double scale, const char* unit) {
  const std::uint64_t total = histogram.count();
  std::string text = format("%s: %llu values, p50 %.3g, p99 %.3g, largest %.3g %s\n", title, number(total),
                            histogram.percentile(0.5) * scale, histogram.percentile(0.99) * scale,
                            histogram.percentile(1.0) * scale, unit);
  if (total == 0) return text;
  std::vector<std::uint64_t> octaves(65, 0);
  for (std::size_t bin = 0; bin < LogHistogram::kBins; ++bin) {
    octaves[static_cast<std::size_t>(std::bit_width(LogHistogram::top_of(bin)))] += histogram.count_in(bin);
  }
  std::size_t first = 0, last = 64;
  while (octaves[first] == 0) ++first;
  while (octaves[last] == 0) --last;
  const std::uint64_t most = *std::max_element(octaves.begin(), octaves.end());
  for (std::size_t i = first; i <= last; ++i) {
    const auto bar =
        static_cast<std::size_t>(std::llround(40.0 * static_cast<double>(octaves[i]) / static_cast<double>(most)));
    text += format("  below %9.4g %s %10llu %s\n", std::ldexp(scale, static_cast<int>(i)), unit, number(octaves[i]),
                   std::string(bar, '#').c_str());
  }
  return text;
}

std::string device_text(const char* name, DeviceState state, DeviceFault fault) {
  return format("%s %s%s%s", name, to_string(state), fault == DeviceFault::none ? "" : ": ",
                fault == DeviceFault::none ? "" : to_string(fault));
}

std::string gate_text(const ServoStatus& servo) {
  std::string text =
      format("Safety gate: %s%s%s, %llu faults\n", to_string(servo.gate_state),
             servo.gate_fault == GateFault::none ? "" : ", ",
             servo.gate_fault == GateFault::none ? "" : to_string(servo.gate_fault), number(servo.gate_faults));
  for (std::size_t i = 0; i < kGateActionCount; ++i) {
    if (servo.gate_counts[i] > 0)
      text += format("  %-22s %10llu ticks\n", to_string(static_cast<GateAction>(i)), number(servo.gate_counts[i]));
  }
  if (servo.hung != ExchangeWith::none)
    text += format("  %s did not return from an exchange; %s\n", to_string(servo.hung),
                   servo.hung_was_stopped ? "it was told to stop" : "it has no way to be stopped");
  return text;
}

std::string placement_text(const SessionStatus& s) {
  const Placement& p = s.placement;
  const Vec3 at = p.offset_m * 1e3, turn = degrees_of(p.rotation);
  return format("Scene on the device: scale %.4g, the device at %.2f %.2f %.2f mm, turned by %.1f %.1f %.1f deg%s\n",
                p.scale, at.x, at.y, at.z, turn.x, turn.y, turn.z, s.clutched ? "; the clutch is held" : "");
}

std::string link_text(const LinkReport& link) {
  std::string text = format("Link: %s%s%s\n", link.connected ? "connected" : "not connected",
                            link.identity.empty() ? "" : ", ", link.identity.c_str());
  if (!link.problem.empty()) text += "  " + link.problem + "\n";
  text += format("  packets in %llu, out %llu, control %llu; short %llu, empty %llu, connects %llu\n",
                 number(link.packets_in), number(link.packets_out), number(link.controls), number(link.short_packets),
                 number(link.empty_packets), number(link.connects));
  text += format("  stalls %llu, time-outs %llu, bus errors %llu, sends refused %llu\n", number(link.stalls),
                 number(link.time_outs), number(link.errors), number(link.refused_sends));
  text += format(
      "  frames %llu, wrong checks %llu, lost %llu, doubled %llu, late %llu; lost by the device %llu, refused by it "
      "%llu\n",
      number(link.frames), number(link.crc_errors), number(link.lost), number(link.doubled), number(link.late),
      number(link.lost_by_device), number(link.refused));
  if (link.last_packet_bytes > 0) {
    text += "  last packet";
    for (std::size_t i = 0; i < link.last_packet_bytes; ++i) text += format(" %02x", link.last_packet[i]);
    text += "\n";
  }
  if (link.round_trip_us != nullptr) text += histogram_text("Round trip", *link.round_trip_us, 1e-3, "ms");
  if (link.arrival_us != nullptr) text += histogram_text("Between telemetry frames", *link.arrival_us, 1e-3, "ms");
  return text;
}

}  // namespace

namespace {

/// Of an armed gate, which by itself reads as if there were force.
std::string faded_text(const ServoRecord& newest) {
  constexpr double kNone = 0.01;  // of what is asked for
  if (((newest.device.gate_actions >> static_cast<unsigned>(GateAction::workspace_faded)) & 1u) == 0) return {};
  const bool none = glm::length(newest.device.force_command_n) <= kNone * force_wanted_n(newest.tick.output);
  return std::string(none ? " | No force" : " | Less force") + ": the finger is outside the device's workspace";
}

}  // namespace

std::string monitor_line(const Session& session) {
  const SessionStatus s = session.status();
  std::string text = device_text("force device", s.force_state, s.force_fault) + " | " +
                     device_text("display", s.display_state, s.display_fault) + " | gate " +
                     to_string(s.servo.gate_state);
  if (s.servo.gate_fault != GateFault::none) text += std::string(": ") + to_string(s.servo.gate_fault);
  const bool live = s.servo.gate_state == GateState::ramping || s.servo.gate_state == GateState::armed;
  const std::string why = arming_text(s.arming, s.in_the_way, s.force_wanted_n);
  if (s.clutched) text += " | clutch held";
  if (s.placement_refused) text += " | not placed: force was sent";
  LinkReport force;
  if (!live && session.force_report(force) && !force.problem.empty()) text += " | " + force.problem;
  if (!live) text += " | " + (why.empty() ? std::string("No force: a arms") : why);
  if (live && !session.history().empty()) text += faded_text(session.history().newest());
  text += format(" | %.1f Hz", s.servo.rate_hz);
  if (session.history().empty()) return text;
  const ServoRecord& r = session.history().newest();
  const Vec3 p = r.tick.input.finger.position * 1e3, f = r.device.force_rendered_n;
  return text + format(" | %.2f %.2f %.2f mm | %.2f N | roller %.3f to %.3f mm, %.1f ms old", p.x, p.y, p.z,
                       std::sqrt(glm::dot(f, f)), r.device.cld_measured_m * 1e3, r.device.cld_command_m * 1e3,
                       r.device.display_age_s * 1e3);
}

std::string monitor_report(const Session& session) {
  const SessionStatus s = session.status();
  std::string text =
      format("Servo: %llu ticks, %.1f Hz, %llu late ticks, %llu missed deadlines; %s\n", number(s.servo.ticks),
             s.servo.rate_hz, number(s.servo.late_ticks), number(s.servo.missed_deadlines), s.realtime_note.c_str());
  if (!s.realtime_remedy.empty())
    text +=
        (s.real_devices ? "  Warning: a real device without real-time scheduling. " : "  ") + s.realtime_remedy + "\n";
  text += histogram_text("Tick to tick", session.period_ns(), 1e-6, "ms");
  text += histogram_text("Late by", session.lateness_ns(), 1e-6, "ms");
  text += histogram_text("From sample to command", session.latency_ns(), 1e-6, "ms");
  text += gate_text(s.servo);
  if (session.force_capabilities() != nullptr) text += placement_text(s);
  LinkReport force, link;
  if (session.force_report(force)) text += "Force device\n" + link_text(force);
  if (session.display_report(link)) text += link_text(link);
  text += "Log\n";
  for (const SafetyEntry& e : session.safety_log().entries()) text += format("  %10.3f s  %s\n", e.t_s, e.text.c_str());
  return text;
}

}  // namespace tangent

#include "workbench/experiment/trial_setup.h"

#include "core/io/rendering_condition.h"
#include "workbench/recording/core_digest.h"

#include <algorithm>
#include <cstdio>

namespace tangent::experiment {

std::string program_digest() { return std::string(core_digest()).substr(0, 16); }

bool is_live(const ServoRecord& record) {
  return record.device.gate_state == GateState::ramping || record.device.gate_state == GateState::armed;
}

bool touches(const ServoRecord& record) {
  const TickOutput& output = record.tick.output;
  return is_live(record) && output.status != TickStatus::free && output.force_n != Vec3(0.0);
}

std::vector<Stimulus> kinds_of(const Protocol& protocol) {
  std::vector<Stimulus> out;
  Stimulus shown;
  if (const Discrimination* arcs = protocol.discrimination()) {
    shown.kind = Stimulus::Kind::arc;
    for (const ComparisonCondition& condition : arcs->conditions) {
      shown.condition = condition.name;
      out.push_back(shown);
    }
    return out;
  }
  const Identification& design = *protocol.identification();
  shown.kind = Stimulus::Kind::object;
  shown.object = design.practice.empty() ? design.objects.front() : design.practice;
  for (const bool shaded : {true, false})
    for (const bool tactile : {false, true}) {
      shown.shaded = shaded;
      shown.tactile = tactile;
      out.push_back(shown);
    }
  return out;
}

Status check_conditions(const Protocol& protocol, const Stimuli& stimuli, const Session& session) {
  if (session.force_capabilities() == nullptr)
    return fail("there is no force device, which every trial needs", "--force", "choose one, for example simulated");
  for (const Stimulus& shown : kinds_of(protocol)) {
    const auto stimulus = stimuli.rendered(shown);
    if (!stimulus) return tl::unexpected(stimulus.error());
    if (Status ok = check_devices(stimulus->preset, true, session.display_capabilities() != nullptr); !ok) return ok;
  }
  return {};
}

std::string device_text(const Session& session) {
  std::string out = session.force_capabilities()->name;
  if (!session.force_capabilities()->serial.empty()) out += " " + session.force_capabilities()->serial;
  const DisplayCapabilities* display = session.display_capabilities();
  return out + ", " + (display != nullptr ? display->name : "no display");
}

std::string feedback_text(const Stimulus& shown) {
  if (shown.kind == Stimulus::Kind::arc) return shown.condition;
  if (shown.kind == Stimulus::Kind::none) return {};
  return std::string(shown.tactile ? "force and tactile" : "force") + (shown.shaded ? ", shaded" : ", unshaded");
}

double force_limit_n(const Protocol& protocol, const Session& session) {
  return std::min(protocol.preset.force.limit_n, session.force_capabilities()->peak_force_n);
}

std::string limit_text(const Protocol& protocol, const Session& session) {
  const double wanted_n = protocol.preset.force.limit_n, most_n = session.force_capabilities()->peak_force_n;
  char text[96];
  if (wanted_n <= most_n)
    std::snprintf(text, sizeof text, "force limit %g N", wanted_n);
  else
    std::snprintf(text, sizeof text, "force limit %.3g N, the device's own (the protocol allows %g N)", most_n,
                  wanted_n);
  return text;
}

std::string fault_text(const ServoRecord& record) {
  const DeviceTelemetry& device = record.device;
  std::string why = device.gate_fault == GateFault::none
                        ? std::string("the force was stopped")
                        : std::string("the safety gate stopped the force: ") + to_string(device.gate_fault);
  if (device.force_fault != DeviceFault::none) why += std::string("; force device: ") + to_string(device.force_fault);
  if (device.display_fault != DeviceFault::none) why += std::string("; display: ") + to_string(device.display_fault);
  return why;
}

}  // namespace tangent::experiment

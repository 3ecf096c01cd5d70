#include "workbench/gui/experiment/trial_screens.h"

#include "workbench/experiment/order.h"
#include "workbench/experiment/trial_setup.h"
#include "workbench/gui/experiment/experiment_keys.h"

#include <algorithm>

namespace tangent {
namespace {

using Level = StatusLine::Level;

StatusLine device_line(const std::string& name, DeviceState state, DeviceFault fault) {
  const Level level = state == DeviceState::ready     ? Level::good
                      : state == DeviceState::faulted ? Level::bad
                                                      : Level::warning;
  return {name,
          std::string(to_string(state)) + (fault == DeviceFault::none ? "" : std::string(": ") + to_string(fault)),
          level};
}

std::vector<StatusLine> device_lines(const Session& session, const std::string& sound) {
  const SessionStatus s = session.status();
  std::vector<StatusLine> lines;
  if (const ForceCapabilities* force = session.force_capabilities())
    lines.push_back(device_line(force->name, s.force_state, s.force_fault));
  if (const DisplayCapabilities* display = session.display_capabilities())
    lines.push_back(device_line(display->name, s.display_state, s.display_fault));
  const GateState gate = s.servo.gate_state;
  lines.push_back(
      {"Safety gate",
       gate == GateState::faulted ? std::string("fault: ") + to_string(s.servo.gate_fault) : to_string(gate),
       gate == GateState::faulted ? Level::bad
       : gate == GateState::armed ? Level::good
                                  : Level::warning});
  lines.push_back({"Gate's faults so far", std::to_string(s.servo.gate_faults),
                   s.servo.gate_faults > 0 ? Level::warning : Level::plain});
  lines.push_back({"Missed deadlines", std::to_string(s.servo.missed_deadlines),
                   s.servo.missed_deadlines > 0 ? Level::warning : Level::plain});
  lines.push_back({"Sound", sound, sound == "none" ? Level::warning : Level::plain});
  return lines;
}

/// The list of objects is drawn as keys.
std::string without_key_list(const std::string& prompt) {
  const std::size_t question = prompt.find('?');
  return question == std::string::npos ? prompt : prompt.substr(0, question + 1);
}

std::vector<ExperimentStage> run_stages(const experiment::Identification& design, int done) {
  const int of = 2 * static_cast<int>(design.objects.size());
  std::vector<ExperimentStage> stages;
  for (int session = 1; session <= design.sessions; ++session)
    for (int block = 1; block <= design.blocks; ++block)
      for (int run = 1; run <= design.runs; ++run) {
        const int here = std::clamp(done - of * static_cast<int>(stages.size()), 0, of);
        ExperimentStage stage{
            "Session " + std::to_string(session) + ", block " + std::to_string(block) + ", run " + std::to_string(run),
            here, of};
        stage.over = here == of;
        stage.now = !stage.over && (stages.empty() || stages.back().over);
        stages.push_back(std::move(stage));
      }
  return stages;
}

}  // namespace

ParticipantScreen participant_screen(const experiment::ParticipantView& view, const experiment::Protocol& protocol,
                                     int choice) {
  ParticipantScreen screen;
  screen.prompt = without_key_list(view.prompt);
  screen.hint = view.hint;
  screen.keys = keys_to_press(protocol, view.phase, choice);
  const bool in_trial = view.phase != experiment::Phase::finished && view.phase != experiment::Phase::training;
  screen.trial = in_trial ? view.trial : 0;                        // practice is none
  screen.of = protocol.identification() != nullptr ? view.of : 0;  // of a staircase it is a guess
  screen.show_scene = view.show_scene;
  screen.show_mark = view.show_finger;
  screen.away_mm = 1e3 * view.finger_from_start_m.x;
  screen.right_mm = -1e3 * view.finger_from_start_m.y;
  screen.up_mm = 1e3 * view.finger_from_start_m.z;
  if (const experiment::Identification* design = protocol.identification())
    screen.mark_mm = 1e3 * design->start_radius_m;
  return screen;
}

void TraceFeeder::take(const Session& session) {
  const History& history = session.history();
  std::size_t i = last_tick_ ? history.lower_bound(*last_tick_ + 1) : 0;
  for (; i < history.size(); ++i) {
    const ServoRecord& record = history[i];
    trace_.add(record.tick.input.t_s, glm::length(record.device.force_command_n));
    last_tick_ = record.tick.tick;
  }
}

std::vector<StaircasePoint> staircase_points(const experiment::Protocol& protocol, const std::string& condition,
                                             const std::vector<std::pair<int, bool>>& answers) {
  std::vector<StaircasePoint> points;
  const experiment::Discrimination* design = protocol.discrimination();
  if (design == nullptr) return points;
  const auto found = std::find_if(design->conditions.begin(), design->conditions.end(),
                                  [&](const experiment::ComparisonCondition& c) { return c.name == condition; });
  if (found == design->conditions.end()) return points;
  experiment::Staircase staircase(found->staircase);
  for (const auto& [segments, right] : answers) points.push_back({segments, right, staircase.answer(right)});
  return points;
}

std::vector<ExperimentStage> experiment_stages(const experiment::Protocol& protocol, std::string_view participant,
                                               const std::string& condition, int in_condition, int done) {
  if (const experiment::Identification* design = protocol.identification()) return run_stages(*design, done);
  const experiment::Discrimination& design = *protocol.discrimination();
  std::vector<ExperimentStage> stages;
  const std::uint64_t number = experiment::participant_number(participant).value_or(0);
  for (const std::size_t i : experiment::latin_row(design.conditions.size(), number)) {
    ExperimentStage stage{"Condition " + design.conditions[i].name, 0, 0};
    stage.now = design.conditions[i].name == condition;
    if (stage.now) stage.done = in_condition;
    stages.push_back(std::move(stage));
  }
  const auto now = std::find_if(stages.begin(), stages.end(), [](const ExperimentStage& s) { return s.now; });
  if (now != stages.end())
    for (auto stage = stages.begin(); stage != now; ++stage) stage->over = true;
  return stages;
}

OperatorScreen operator_screen(const experiment::TrialSession& trials, const ExperimentFacts& facts,
                               const ForceTrace& trace) {
  const experiment::OperatorView view = trials.operator_view();
  const Session& session = trials.session();
  OperatorScreen screen;
  screen.protocol = facts.protocol.name;
  screen.participant = facts.participant;
  const ForceCapabilities* force = session.force_capabilities();
  const bool by_device = facts.simulated.empty() && force != nullptr && force->simulated;
  screen.simulated = by_device ? "device" : facts.simulated;  // as the rows say
  screen.pilot = facts.pilot;
  screen.data = trials.rows().string();
  screen.stimulus = view.stimulus;
  screen.condition = view.condition;
  screen.prompt = trials.participant().prompt;
  screen.next = view.what_is_next;
  screen.trial = view.progress.done;
  screen.expected = view.progress.expected;
  screen.paused = view.paused;
  screen.touching = view.touching;
  screen.fault = view.fault;
  const GateState gate = session.status().servo.gate_state;
  screen.force_on = gate == GateState::armed || gate == GateState::ramping;
  screen.device = device_lines(session, facts.sound);
  screen.staircase = staircase_points(facts.protocol, view.condition, view.staircase);
  screen.stages = experiment_stages(facts.protocol, facts.participant, view.condition,
                                    static_cast<int>(view.staircase.size()), view.progress.done);
  screen.notes = view.notes;
  screen.force_n = trace.values();
  screen.trace_s = trace.length_s();
  screen.force_limit_n = facts.protocol.preset.force.limit_n;
  if (force != nullptr) {
    screen.limit_is_the_devices = force->peak_force_n < screen.force_limit_n;
    screen.force_limit_n = experiment::force_limit_n(facts.protocol, session);
  }
  return screen;
}

}  // namespace tangent

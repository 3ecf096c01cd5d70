// What the participant and the operator see of a trial session, and what its rows say of where they come from.
#include "workbench/experiment/trial_session.h"
#include "workbench/experiment/trial_setup.h"

namespace tangent::experiment {

ParticipantView TrialSession::participant() const {
  const Shown& shown = run_.shown();
  ParticipantView out;
  out.phase = shown.phase;
  out.cues = shown.cues;
  out.trial = std::min(run_.progress().done + 1, run_.progress().expected);
  out.of = run_.progress().expected;
  out.prompt = shown.prompt;
  if (ended_ || run_.finished()) return out;
  if (stage_ != Stage::running) {
    out.prompt = "A short break. Please wait.";
    return out;
  }
  out.hint = last_.device.surface_waits != 0 ? "Raise your finger." : shown.hint;
  out.show_scene = shown.in_view && changer_.is_in(shown.stimulus);
  out.show_finger = shown.guided;
  if (shown.guided) out.finger_from_start_m = changer_.finger_from_m(options_.protocol.identification()->start_m);
  return out;
}

OperatorView TrialSession::operator_view() const {
  const Shown& shown = run_.shown();
  OperatorView out;
  out.stimulus = shown.stimulus.kind == Stimulus::Kind::none ? "none" : changer_.stimulus().name;
  out.condition = feedback_text(shown.stimulus);
  out.what_is_next = run_.what_is_next();
  out.progress = run_.progress();
  out.touching = moment_.touching;
  out.paused = stage_ == Stage::paused;
  out.fault = fault_;
  out.notes = notes_;
  out.staircase = run_.staircase();
  return out;
}

RowOrigin TrialSession::origin() const {
  RowOrigin out;
  out.interruptions = std::max(0, events_.begun(run_.trial()) - 1);
  out.device = device_text(*session_);
  out.sound = options_.sound;
  out.mesh = changer_.comparison_hash();
  out.preset = preset_digest(session_->preset());
  out.protocol = options_.enrolment.protocol_digest;
  out.program = program_digest();
  out.recording = recorder_.file();
  return out;
}

}  // namespace tangent::experiment

#include "workbench/experiment/trial_session.h"

#include "workbench/experiment/trial_setup.h"

#include <cstdio>
#include <limits>

namespace tangent::experiment {
namespace {

constexpr double kLongestGap_s = 0.1;  // between two ticks; longer: time has jumped, or the program was held up

}  // namespace

TrialKey digit_key(int digit) {
  if (digit < 1 || digit > 9) return TrialKey::enter;
  return static_cast<TrialKey>(static_cast<int>(TrialKey::digit_1) + digit - 1);
}

Status TrialSession::log(TrialEvent event, const std::string& text) {
  const double t_s = clock_s();
  char when[32];
  std::snprintf(when, sizeof when, "%.1f s  ", t_s);
  const bool shown = event == TrialEvent::trial || event == TrialEvent::second || event == TrialEvent::guide;
  if (!shown) notes_.push_back(when + text);  // the operator's, who sees those anyway
  return events_.add(begun_after_s_ + t_s, run_.trial(), event, text);
}

void TrialSession::note(const std::string& text) {
  if (const Status ok = log(TrialEvent::note, text); !ok) pause(ok.error().message());
}

// --- Keys ----------------------------------------------------------------------------------------------

void TrialSession::press(TrialKey key) {
  if (ended_) return;
  switch (key) {
    case TrialKey::stop:
      session_->stop();
      return pause("stopped by the operator");
    case TrialKey::resume:
      return resume();
    case TrialKey::quit:
      session_->stop();
      ended_ = true;
      return;
    case TrialKey::lift:
      changer_.raise_hand(!changer_.hand_is_raised());
      return lead_hand();
    default:
      break;
  }
  if (stage_ != Stage::running || !any_) return;
  if (key == TrialKey::enter)
    advance(Key::enter, 0);
  else
    advance(Key::digit, 1 + static_cast<int>(key) - static_cast<int>(TrialKey::digit_1));
  show();
}

void TrialSession::pause(const std::string& why) {
  if (stage_ == Stage::paused && !fault_.empty()) return;
  stage_ = Stage::paused;
  fault_ = why + "; press resume when it is mended: the trial begins again";
  changer_.take_away(nullptr);
  begun_ = -1;
  told_.reset();
  paused_at_s_ = clock_s();
  static_cast<void>(recorder_.end());  // what it lacks is said by the file itself
  static_cast<void>(log(TrialEvent::paused, why));
}

void TrialSession::resume() {
  if (stage_ != Stage::paused || ended_) return;
  Status ok = run_.settle();
  if (ok && session_->needs_yes())
    ok = fail(session_->without_timeout().front() + " goes on with its last command when this program dies", "devices",
              "start with --without-timeout if that is known and accepted");
  if (ok) ok = check_devices_are_there();
  if (ok) ok = log_arming();
  if (!ok) {
    fault_ = ok.error().message();
    return;
  }
  if (any_) run_.repeat(last_.tick.input.t_s);
  fault_.clear();
  ever_armed_ = true;
  stage_ = Stage::arming;
  armed_from_ = session_->status().servo.ticks + 1;
  session_->arm();
}

Status TrialSession::log_arming() {
  if (!ever_armed_) return log(TrialEvent::armed, "arms");
  char text[48];
  std::snprintf(text, sizeof text, "goes on after %.1f s", clock_s() - paused_at_s_);
  return log(TrialEvent::resumed, text);
}

// The gate takes a device that is absent for none, and would go on without it.
Status TrialSession::check_devices_are_there() const {
  const DisplayCapabilities* display = session_->display_capabilities();
  const char* remedy = "plug it in, then press resume";
  if (!any_ && session_->status().real_devices)
    return fail("has not answered yet", session_->force_capabilities()->name, "press resume once more");
  if (any_ && last_.device.force_state == DeviceState::absent)
    return fail("the force device is not there", session_->force_capabilities()->name, remedy);
  if (any_ && display != nullptr && last_.device.display_state == DeviceState::absent)
    return fail("the contact display is not there", display->name, remedy);
  return {};
}

// --- Ticks ---------------------------------------------------------------------------------------------

void TrialSession::poll() {
  if (closed_) return;
  take_records();
  if (stage_ == Stage::running && session_->status().servo.hung != ExchangeWith::none)
    pause("a device does not return from an exchange: switch it off, and start the program again");
  if (const std::string trouble = recorder_.poll(); !trouble.empty()) pause("the trial is not recorded: " + trouble);
  watch_start();
  show();
}

// What is missing is said before anybody presses a key, and no longer once it is there.
void TrialSession::watch_start() {
  if (ever_armed_ || stage_ != Stage::paused || !any_) return;
  const Status there = check_devices_are_there();
  if (devices_there_ == there.has_value()) return;
  devices_there_ = there.has_value();
  const std::string fault = there ? kNotArmed : there.error().message();
  if (fault == fault_) return;
  fault_ = fault;
  static_cast<void>(log(TrialEvent::paused, fault));
}

void TrialSession::take_records() {
  session_->poll();
  const History& history = session_->history();
  std::size_t i = any_ ? history.lower_bound(last_.tick.tick + 1) : 0;
  for (; i < history.size(); ++i) take(history[i]);
}

void TrialSession::take(const ServoRecord& record) {
  const double passed_s = record.tick.input.t_s - last_.tick.input.t_s;
  const bool gap = any_ && (record.tick.tick != last_.tick.tick + 1 || !(passed_s >= 0.0 && passed_s <= kLongestGap_s));
  last_ = record;
  any_ = true;
  changer_.look(last_, session_->status().placement);
  if (stage_ == Stage::arming) watch_arming(record);
  if (stage_ != Stage::running || ended_) return;
  if (gap) return pause("the clock jumped, or the program was held up: ticks of this trial are missing");
  if (!watch_faults(record)) advance(Key::none, 0);
}

void TrialSession::watch_arming(const ServoRecord& record) {
  if (record.tick.tick < armed_from_) return;
  if (is_live(record)) stage_ = Stage::running;
  if (record.device.arming == ArmingStage::given_up)
    pause("not armed: " + std::string(to_string(record.device.in_the_way)) + ". " + remedy(record.device.in_the_way));
}

bool TrialSession::watch_faults(const ServoRecord& record) {
  if (is_live(record)) return false;
  pause(fault_text(record));
  return true;
}

void TrialSession::advance(Key key, int digit) {
  const Identification* naming = options_.protocol.identification();
  const bool in = changer_.is_in(run_.shown().stimulus);
  moment_ = {last_.tick.input.t_s, in && touches(last_), std::numeric_limits<double>::infinity(), key, digit};
  if (naming != nullptr && changer_.is_away())
    moment_.from_start_m = glm::length(changer_.finger_from_m(naming->start_m));
  const std::uint64_t cues = run_.shown().cues;
  if (const Status ok = run_.advance(moment_, key == Key::none ? RowOrigin{} : origin()); !ok)
    pause(ok.error().message());
  if (run_.shown().cues != cues) changer_.raise_hand(false);
}

// --- Stimuli -------------------------------------------------------------------------------------------

void TrialSession::show() {
  lead_hand();
  if (stage_ != Stage::running || !any_) return;
  const Shown& shown = run_.shown();
  if (const Status ok = tell_interval(); !ok) return pause(ok.error().message());
  if (ended_ || shown.stimulus.kind == Stimulus::Kind::none) {
    changer_.take_away(!ended_ && shown.guided ? options_.protocol.identification() : nullptr);
    if (const Status ok = recorder_.end(); !ok) pause(ok.error().message());
    return;
  }
  const auto state = changer_.change_to(shown.stimulus);
  if (!state) return pause(state.error().message());
  if (*state == StimulusChanger::State::put) recorder_.scene_changed(changer_.scene(), changer_.stimulus());
  if (*state == StimulusChanger::State::there && begin_trial()) changer_.feel();
}

// Intervals besides the one that begins a trial.
Status TrialSession::tell_interval() {
  const Phase phase = run_.shown().phase;
  if (told_ == phase) return {};
  told_ = phase;
  switch (phase) {
    case Phase::training:
      return log(TrialEvent::training, run_.shown().prompt);
    case Phase::guide:
      return log(TrialEvent::guide, "to the start");
    case Phase::second:
      return log(TrialEvent::second, "the second of the pair");
    case Phase::rest:
      return log(TrialEvent::rest, run_.shown().prompt);
    default:
      return {};
  }
}

// Each trial, and each time it begins again, is in the events before it is felt.
bool TrialSession::begin_trial() {
  const Phase phase = run_.shown().phase;
  if ((phase != Phase::first && phase != Phase::explore) || begun_ == run_.trial()) return true;
  const RenderedStimulus& stimulus = changer_.stimulus();
  Status ok = log(TrialEvent::trial, stimulus.name);
  if (ok && options_.record) ok = recorder_.begin(*session_, recordings_path(run_.rows()), run_.trial(), stimulus);
  if (!ok) return pause(ok.error().message()), false;
  begun_ = run_.trial();
  return true;
}

void TrialSession::lead_hand() {
  const Shown& shown = run_.shown();
  changer_.lead_hand(options_.session.hand, changer_.is_in(shown.stimulus),
                     shown.guided ? options_.protocol.identification() : nullptr);
}

}  // namespace tangent::experiment

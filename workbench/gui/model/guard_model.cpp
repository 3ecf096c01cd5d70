#include "workbench/gui/model/guard_model.h"

#include "workbench/recording/build_identity.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

std::filesystem::path ranges_file(const AppOptions& options) {
  return options.settings.empty() ? std::filesystem::path() : options.settings.parent_path() / "safe-ranges.txt";
}

std::string where(const Verdict& verdict) {
  if (verdict.grip >= kGrips.size()) return "on the device, where it was undone before";
  return "in the simulated hand, " + std::string(kGrips[verdict.grip].name) + " grip";
}

}  // namespace

GuardModel::GuardModel(const AppOptions& options, const SceneModel& scene, PresetModel& presets, DeviceModel& devices,
                       MessageLog& messages, std::function<void(const std::string& what)> send,
                       std::function<void()> taken_back)
    : scene_(scene),
      presets_(presets),
      devices_(devices),
      messages_(messages),
      send_(std::move(send)),
      taken_back_(std::move(taken_back)),
      deterministic_(options.deterministic),
      sweep_(ranges_file(options), build_identity()),
      sent_(presets.current()) {}

bool GuardModel::armed() const {
  const GateState state = devices_.status().servo.gate_state;
  return state == GateState::ramping || state == GateState::armed;
}

std::optional<TrialGround> GuardModel::ground() const {
  const Session* session = devices_.session();
  if (session == nullptr || session->force_capabilities() == nullptr || session->scene() == nullptr)
    return std::nullopt;
  const ForceCapabilities& can = *session->force_capabilities();
  TrialDevice device;
  if (can.apparent_mass_kg > 0.0) device.mass_kg = can.apparent_mass_kg;
  device.step_m = can.position_resolution_m;
  if (can.position_resolution_m == 0.0) device.friction_n = 0.0;  // an ideal one has neither
  device.rate_hz = session->options().servo.rate_hz;
  device.scale = devices_.status().placement.scale;
  device.largest_stiffness_n_per_m = can.largest_stiffness_n_per_m;
  device.largest_damping_n_s_per_m = can.largest_damping_n_s_per_m;
  return TrialGround{session->scene(), device};
}

Preset GuardModel::rendered(const Preset& preset) const {
  const auto now = ground();
  return now ? rendered_by(now->device, preset) : preset;
}

bool GuardModel::guards() const {
  if (!on || !armed()) return false;
  const auto now = ground();
  if (!now) return false;
  return devices_.status().real_devices || guarding_;
}

bool GuardModel::lets_through(const std::string& what) {
  const Preset& wanted = presets_.current();
  const bool already = std::exchange(through_, false);
  refused_ = false;
  if (!already && guards() && !same_loop(rendered(wanted), rendered(sent_))) {
    const auto now = ground();
    if (!is_current(*now)) sweep_.start(*now, rendered(sent_), keys_);
    const Verdict known = sweep_.known(rendered(wanted));
    if (known.safety != Safety::stable || !(wanted.finger == sent_.finger)) {
      hold(what, known);
      return false;
    }
  }
  question_.reset();
  sent_ = wanted;
  sent_slot_ = presets_.slots().active_slot();
  return true;
}

/// What is not known is tried at once. Where nothing else runs beside the window, the answer is waited for.
void GuardModel::hold(const std::string& what, const Verdict& known) {
  Verdict verdict = known;
  if (known.safety == Safety::unknown) {
    sweep_.ask(rendered(presets_.current()));
    if (deterministic_) {
      sweep_.wait();
      verdict = sweep_.known(rendered(presets_.current()));
    }
  }
  question_ = {what, presets_.current(), known.safety != Safety::unknown || deterministic_, {}};
  say_why(verdict);
}

void GuardModel::refused_by_session() {
  sent_ = devices_.session()->preset();
  refused_ = true;
}

void GuardModel::say_why(const Verdict& known) {
  question_->why = known.safety == Safety::shakes ? "shakes " + where(known)
                   : !question_->tried            ? "is being tried in the simulated hand"
                   : known.safety == Safety::unknown
                       ? "is not known to be stable"
                       : "is stable in the simulated hand, and was not among the values known before";
  if (!(question_->wanted.finger == sent_.finger))
    question_->why += "; another finger moves the surface under the hand";
}

void GuardModel::answer(bool yes) {
  if (!question_) return messages_.refuse("there is no question of the guard to answer");
  const Question asked = *std::exchange(question_, std::nullopt);
  if (yes) {
    through_ = true;
    messages_.say(Severity::warning, asked.what + ": sent, though it " + asked.why);
    return send_(asked.what);
  }
  presets_.take_back(sent_, "kept as it was, not " + asked.what, sent_slot_);
  taken_back_();
}

void GuardModel::take_undone() {
  Session& session = *devices_.session();
  const PresetUndone& undone = session.preset_undone();
  if (undone.count == undone_seen_) return;
  undone_seen_ = undone.count;
  const Preset* bad = session.preset(undone.bad_id);
  if (bad != nullptr && ground() && is_current(*ground()))
    sweep_.learn(*bad, {Safety::shakes, 0, static_cast<std::uint8_t>(kGrips.size()), undone.why});
  const std::string what = presets_.note(undone.bad_id);
  messages_.say(Severity::error, (what.empty() ? "The change of preset" : what) + " was undone at once: " +
                                     to_text(undone) + " (tick " + std::to_string(undone.tick) + ")");
  question_.reset();
  refused_ = false;
  sent_ = session.preset();
  presets_.take_back(sent_, "undone: " + to_text(undone));
  presets_.note_sent(session.preset_id(), "undone: " + what);
  taken_back_();
}

/// Swept again around what is in use, when a person has let go of it.
void GuardModel::follow_values() {
  const auto now = ground();
  if (!sweeping_ || !now || presets_.slots().gesture_open() || question_) return;
  const Preset base = rendered(sent_);
  if (is_current(*now) && same_loop(base, sweep_.base())) return;
  sweep_.start(*now, base, keys_);
  if (deterministic_) sweep_.wait();
}

void GuardModel::update() {
  if (std::string problem = sweep_.take_problem(); !problem.empty())
    messages_.say(Severity::warning, "safe ranges: " + problem);
  Session* session = devices_.session();
  if (session == nullptr) return question_.reset();
  if (std::exchange(session_, session) != session) {
    undone_seen_ = session->preset_undone().count;
    sent_ = presets_.current();
    sent_slot_ = presets_.slots().active_slot();
    refused_ = false;
    question_.reset();
  }
  session->guard_presets(on && (devices_.status().real_devices || guarding_));
  take_undone();
  if (question_ && !(question_->wanted == presets_.current())) question_.reset();
  if (question_) {
    const Verdict known = sweep_.known(rendered(question_->wanted));
    if (!guards()) {
      const std::string what = std::exchange(question_, std::nullopt)->what;
      through_ = true;
      send_(what);
    } else if (!question_->tried && (sweep_.tried(rendered(question_->wanted)) || !sweep_.running())) {
      question_->tried = true;
      say_why(known);
    }
  }
  follow_values();
}

void GuardModel::find_ranges(std::vector<const PresetKey*> keys) {
  if (!ground()) return messages_.refuse("safe ranges are those of a force device: choose one");
  guarding_ = sweeping_ = true;
  keys_ = std::move(keys);
  follow_values();
}

void GuardModel::cancel() {
  sweeping_ = false;
  sweep_.cancel();
}

SafeRange GuardModel::range(const PresetKey& key) const {
  const auto now = ground();
  if (!now || !is_current(*now)) return {};
  // A line holds as long as nothing but its own value has changed since.
  Preset moved = sweep_.base();
  const Preset in_use = rendered(presets_.current());
  key.set(moved, key.get(in_use));
  return same_loop(moved, in_use) ? sweep_.range(key) : SafeRange();
}

}  // namespace tangent

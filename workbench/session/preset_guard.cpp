#include "workbench/session/preset_guard.h"

#include <algorithm>
#include <bit>

namespace tangent {

namespace {

bool is_live(GateState state) { return state == GateState::ramping || state == GateState::armed; }

}  // namespace

std::string to_text(const PresetUndone& undone) {
  switch (undone.why) {
    case UndoneBecause::stopped:
      return std::string("the safety gate stopped the force: ") + to_string(undone.fault);
    case UndoneBecause::limited:
      return "the safety gate had to limit how fast the force changes, tick after tick";
    case UndoneBecause::energy:
      return "the loop began to shake: it made most of the energy at which the safety gate stops";
    case UndoneBecause::none:
      break;
  }
  return {};
}

bool PresetGuard::take(const PresetLetter& letter, const PresetLetter& in_use, bool live) noexcept {
  if (letter.undone_seen != undone_.count) return false;
  if (letter.preset == in_use.preset) return true;
  if (!letter.guarded || !live || (on_trial() && letter.preset == good_.preset)) {
    trial_left_s_ = 0.0;
    return true;
  }
  if (!on_trial()) {
    good_ = in_use;
    excused_ = since_limited_ < kLimitedBefore;
  }
  trial_left_s_ = kTrial_s;
  limited_ = 0;
  overran_ = 0;
  return true;
}

void PresetGuard::note_limits(const GateOutput& gate) noexcept {
  const bool limited = gate.did(GateAction::slew_limited);
  limited_ = (limited_ << 1) | (limited ? 1u : 0u);
  since_limited_ = limited ? 0 : std::min(since_limited_ + 1, kLimitedBefore);
}

// Whether the preset on trial can be the cause. Devices, links and deadlines fail by themselves, too: a stop that was
// theirs, and comes with a controller's gains on trial, takes these back for nothing, which harms nobody.
bool PresetGuard::by_preset(GateFault fault, const Preset& in_use) const noexcept {
  switch (fault) {
    case GateFault::shaking:
    case GateFault::force_not_finite:
    case GateFault::display_not_finite:
    case GateFault::position_jumped:
    case GateFault::display_jumped:
      return true;
    case GateFault::display_frozen:
    case GateFault::contact_display:
      return in_use.controller != good_.preset.controller;
    case GateFault::late_tick:
      return overran_ > 0;
    case GateFault::late_ticks:
      return overran_ >= LatenessWatch::kFewest;
    default:
      return false;
  }
}

UndoneBecause PresetGuard::acts(const GateOutput& gate, const EnergyWatch& energy,
                                const Preset& in_use) const noexcept {
  if (gate.state == GateState::faulted)
    return is_live(last_state_) && by_preset(gate.fault, in_use) ? UndoneBecause::stopped : UndoneBecause::none;
  if (!is_live(gate.state)) return UndoneBecause::none;
  if (energy.made_j() > kEnergyShare * energy.allowed_j()) return UndoneBecause::energy;
  constexpr std::uint32_t kMask = (1u << kLimitedOf) - 1u;
  return !excused_ && std::popcount(limited_ & kMask) >= kLimited ? UndoneBecause::limited : UndoneBecause::none;
}

const PresetLetter* PresetGuard::watch(const GateOutput& gate, const EnergyWatch& energy, const PresetLetter& in_use,
                                       std::uint64_t tick, double dt_s, bool overran) noexcept {
  note_limits(gate);
  const UndoneBecause why = on_trial() ? acts(gate, energy, in_use.preset) : UndoneBecause::none;
  last_state_ = gate.state;
  if (why != UndoneBecause::none) {
    undone_ = {undone_.count + 1, in_use.id, good_.id, why, gate.fault, tick};
    trial_left_s_ = 0.0;
    return &good_;
  }
  if (overran) ++overran_;
  if (on_trial() && is_live(gate.state) && gate.force_n != Vec3(0.0)) trial_left_s_ -= dt_s;
  return nullptr;
}

}  // namespace tangent

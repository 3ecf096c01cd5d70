#include "workbench/experiment/naming_run.h"

namespace tangent::experiment {
namespace {

std::string key_list(const std::vector<std::string>& objects) {
  std::string out;
  for (std::size_t i = 0; i < objects.size(); ++i)
    out += (i > 0 ? ", " : "") + std::to_string(i + 1) + " " + objects[i];
  return out;
}

}  // namespace

NamingRun::NamingRun(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed)
    : protocol_(protocol), trials_(object_trials(*protocol.identification(), participant, seed)) {}

void NamingRun::begin(double t_s, bool first) {
  if (next_ == trials_.size()) return show(Phase::finished, t_s);
  const ObjectTrial& trial = trials_[next_];
  const ObjectTrial* before = next_ > 0 ? &trials_[next_ - 1] : nullptr;
  const bool new_session = before != nullptr && before->session != trial.session;
  if (new_session && !first) return show(Phase::finished, t_s);
  const bool new_block = before != nullptr && before->block != trial.block;
  if (new_block && !first && shown_.phase != Phase::rest) return show(Phase::rest, t_s);
  const bool new_feedback = before == nullptr || new_session || before->tactile != trial.tactile || first;
  if (new_feedback && !design().practice.empty()) return show(Phase::training, t_s);
  show(Phase::guide, t_s);
}

void NamingRun::show(Phase phase, double t_s) {
  shown_.phase = phase;
  shown_.in_view = phase == Phase::training;
  shown_.guided = phase == Phase::guide;
  shown_.stimulus = {};
  held_since_s_ = -1.0;
  clock_.begin(t_s);
  if (phase == Phase::training || phase == Phase::explore) {
    const ObjectTrial& trial = trials_[next_];
    shown_.stimulus.kind = Stimulus::Kind::object;
    shown_.stimulus.object = phase == Phase::training ? design().practice : design().objects[trial.object];
    shown_.stimulus.shaded = phase == Phase::training || trial.shaded;
    shown_.stimulus.tactile = trial.tactile;
    shown_.stimulus.facing = phase == Phase::training ? Facing::right : trial.facing;
  }
  switch (phase) {
    case Phase::training:
      shown_.prompt = "Feel this object as long as you like, then press Enter.";
      break;
    case Phase::guide:
      shown_.prompt = "Bring your finger to the mark, and wait there.";
      break;
    case Phase::rest:
      shown_.prompt = "A short rest. Press Enter to go on.";
      break;
    case Phase::finished:
      shown_.prompt = all_done() ? "That was the last one. Thank you." : "This session is over. Thank you.";
      break;
    default:
      ++shown_.cues;
      shown_.prompt = "Which object is it? " + key_list(design().objects) + ".";
  }
}

void NamingRun::wait_at_start(const Moment& moment) {
  if (moment.from_start_m > design().start_radius_m) {
    held_since_s_ = -1.0;
    return;
  }
  if (held_since_s_ < 0.0 || moment.t_s < held_since_s_) held_since_s_ = moment.t_s;
  if (moment.t_s - held_since_s_ >= design().hold_s) show(Phase::explore, moment.t_s);
}

NamingRow NamingRun::row_of(std::size_t i, std::size_t answer) const {
  const ObjectTrial& trial = trials_[i];
  NamingRow row;
  row.trial = static_cast<int>(i);
  row.session = trial.session + 1;
  row.block = trial.block + 1;
  row.run = trial.run + 1;
  row.object = design().objects[trial.object];
  row.shaded = trial.shaded;
  row.tactile = trial.tactile;
  row.facing = trial.facing;
  row.answer = design().objects[answer];
  row.right = answer == trial.object;
  return row;
}

std::optional<NamingRow> NamingRun::take_digit(int digit, double t_s) {
  if (digit < 1 || digit > static_cast<int>(design().objects.size())) {
    shown_.hint = "Press 1 to " + std::to_string(design().objects.size()) + ".";
    return std::nullopt;
  }
  if (!clock_.touched()) return shown_.hint = "Touch the object first.", std::nullopt;
  NamingRow row = row_of(next_, static_cast<std::size_t>(digit - 1));
  row.began_s = clock_.began_s();
  row.since_touch_s = clock_.since_touch_s();
  row.touching_s = clock_.touching_s();
  ++next_;
  begin(t_s, false);
  return row;
}

std::optional<NamingRow> NamingRun::advance(const Moment& moment) {
  if (finished()) return std::nullopt;
  clock_.advance(moment.t_s, moment.touching);
  if (moment.key != Key::none) shown_.hint.clear();
  if (shown_.phase == Phase::guide)
    wait_at_start(moment);
  else if (shown_.phase == Phase::explore && moment.key == Key::digit)
    return take_digit(moment.digit, moment.t_s);
  else if (shown_.phase == Phase::training && moment.key == Key::enter)
    show(Phase::guide, moment.t_s);
  else if (shown_.phase == Phase::rest && moment.key == Key::enter)
    begin(moment.t_s, false);
  return std::nullopt;
}

void NamingRun::repeat(double t_s) {
  if (shown_.phase == Phase::explore || shown_.phase == Phase::guide) show(Phase::guide, t_s);
  if (shown_.phase == Phase::training) show(Phase::training, t_s);
}

bool NamingRun::begins_session() const {
  return next_ > 0 && !all_done() && trials_[next_].session != trials_[next_ - 1].session;
}

std::string NamingRun::session_text() const {
  const int session = next_ > 0 ? trials_[next_ - 1].session : 0;
  return "session " + std::to_string(session + 1) + " of " + std::to_string(design().sessions);
}

std::string NamingRun::what_is_next() const {
  const auto named = [this](std::size_t i) {
    if (i >= trials_.size()) return std::string("the end");
    const ObjectTrial& trial = trials_[i];
    return design().objects[trial.object] + (trial.shaded ? ", shaded" : ", facets") +
           (trial.tactile ? ", with display" : "");
  };
  return finished() ? std::string{} : named(shown_.phase == Phase::explore ? next_ + 1 : next_);
}

Result<NamingRun> NamingRun::start(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed,
                                   const std::vector<NamingRow>& done) {
  NamingRun run(protocol, participant, seed);
  for (const NamingRow& row : done) {
    const std::string where = "trial " + std::to_string(row.trial);
    if (run.all_done()) return fail("the experiment was over before it", where, "use the file as it was written");
    const NamingRow expected = run.row_of(run.next_, 0);
    const bool same = row.trial == expected.trial && row.session == expected.session && row.block == expected.block &&
                      row.run == expected.run && row.object == expected.object && row.shaded == expected.shaded &&
                      row.tactile == expected.tactile && row.facing == expected.facing &&
                      row.right == (row.answer == row.object);
    if (!same)
      return fail("is not what this protocol and seed show there", where, "use the protocol that it was begun with");
    ++run.next_;
  }
  run.begin(0.0, true);
  return run;
}

}  // namespace tangent::experiment

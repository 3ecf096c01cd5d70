#include "workbench/experiment/comparison_run.h"

#include "core/base/units.h"
#include "workbench/experiment/order.h"

namespace tangent::experiment {
namespace {

constexpr std::string_view kFirstPrompt = "Feel the first shape. Then raise your finger and press Enter.";
constexpr std::string_view kSecondPrompt =
    "Feel the second shape. Then raise your finger, press 1 or 2 for the smooth one, and Enter.";
constexpr std::string_view kTrainingPrompt =
    "This is the smooth shape. Feel it as long as you like, then raise your finger and press Enter.";

}  // namespace

double comparison_angle_deg(const Discrimination& design, int segments) {
  const int angles = design.placement == ArcPlacement::tangent ? segments - 1 : segments;
  return design.angle_rad / angles / kDegree;
}

ComparisonRun::ComparisonRun(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed)
    : protocol_(protocol), seed_(seed), order_(latin_row(protocol.discrimination()->conditions.size(), participant)) {
  begin_condition();
}

const ComparisonCondition& ComparisonRun::condition() const {
  return protocol_.discrimination()->conditions[order_[place_]];
}

bool ComparisonRun::reference_is_first() const {
  return reference_first(seed_, order_[place_], static_cast<std::size_t>(staircase_->trials()));
}

void ComparisonRun::begin_condition() {
  if (place_ == order_.size()) {
    shown_.phase = Phase::finished;
    shown_.stimulus = {};
    shown_.in_view = false;
    shown_.prompt = "That was the last one. Thank you.";
    return;
  }
  staircase_.emplace(condition().staircase);
  answers_.clear();
  show(Phase::training, 0.0);
}

void ComparisonRun::show(Phase phase, double t_s) {
  shown_.phase = phase;
  shown_.in_view = phase == Phase::training;
  shown_.choice = 0;
  shown_.prompt = phase == Phase::training ? kTrainingPrompt : phase == Phase::first ? kFirstPrompt : kSecondPrompt;
  const bool exact = phase == Phase::training || (phase == Phase::first) == reference_is_first();
  shown_.stimulus = {};
  shown_.stimulus.kind = Stimulus::Kind::arc;
  shown_.stimulus.condition = condition().name;
  shown_.stimulus.segments = exact ? 0 : staircase_->segments();
  if (phase != Phase::training) ++shown_.cues;
  clock_.begin(t_s);
}

std::optional<ComparisonRow> ComparisonRun::advance(const Moment& moment) {
  if (finished()) return std::nullopt;
  clock_.advance(moment.t_s, moment.touching);
  if (moment.key == Key::none) return std::nullopt;
  shown_.hint.clear();
  if (moment.key == Key::digit) {
    if (shown_.phase == Phase::second && (moment.digit == 1 || moment.digit == 2))
      shown_.choice = moment.digit;
    else
      shown_.hint = shown_.phase == Phase::second ? "Press 1 or 2." : "Press Enter when you have felt it.";
    return std::nullopt;
  }
  return enter(moment.t_s);
}

std::optional<ComparisonRow> ComparisonRun::enter(double t_s) {
  if (shown_.phase != Phase::training && !clock_.touched()) return shown_.hint = "Touch the shape first.", std::nullopt;
  if (clock_.touching()) return shown_.hint = "Raise your finger first.", std::nullopt;
  if (shown_.phase == Phase::training) {
    show(Phase::first, t_s);
  } else if (shown_.phase == Phase::first) {
    row_ = {};
    row_.began_s = clock_.began_s();
    row_.first_s = clock_.since_touch_s();
    show(Phase::second, t_s);
  } else if (shown_.choice == 0) {
    shown_.hint = "Press 1 or 2 first.";
  } else {
    const ComparisonRow row = take_answer();
    take(row);
    if (shown_.phase == Phase::second) show(Phase::first, t_s);
    return row;
  }
  return std::nullopt;
}

ComparisonRow ComparisonRun::take_answer() {
  row_.second_s = clock_.since_touch_s();
  row_.second_touching_s = clock_.touching_s();
  row_.trial = trial_;
  row_.condition = condition().name;
  row_.condition_place = static_cast<int>(place_);
  row_.trial_in_condition = staircase_->trials();
  row_.segments = staircase_->segments();
  row_.angle_deg = comparison_angle_deg(*protocol_.discrimination(), row_.segments);
  row_.reference = reference_is_first() ? 1 : 2;
  row_.answer = shown_.choice;
  row_.right = row_.answer == row_.reference;
  Staircase next = *staircase_;
  row_.reversal = next.answer(row_.right);
  return row_;
}

void ComparisonRun::take(const ComparisonRow& row) {
  answers_.emplace_back(row.segments, row.right);
  staircase_->answer(row.right);
  ++trial_;
  if (!staircase_->done()) return;
  ++place_;
  begin_condition();
}

void ComparisonRun::repeat(double t_s) {
  if (!finished()) show(shown_.phase == Phase::training ? Phase::training : Phase::first, t_s);
}

std::string ComparisonRun::what_is_next() const {
  const auto named = [](int segments) {
    return segments == 0 ? std::string("the exact arc") : std::to_string(segments) + " segments";
  };
  const int coarse = staircase_->segments();
  switch (shown_.phase) {
    case Phase::training:
      return "first " + named(reference_is_first() ? 0 : coarse) + ", then " + named(reference_is_first() ? coarse : 0);
    case Phase::first:
      return "then " + named(reference_is_first() ? coarse : 0);
    case Phase::second:
      return "the answer: 1 or 2, and Enter";
    default:
      return {};
  }
}

Result<ComparisonRun> ComparisonRun::start(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed,
                                           const std::vector<ComparisonRow>& done) {
  ComparisonRun run(protocol, participant, seed);
  for (const ComparisonRow& row : done) {
    const std::string where = "trial " + std::to_string(row.trial);
    if (run.finished()) return fail("the experiment was over before it", where, "use the file as it was written");
    const bool same = row.trial == run.trial_ && row.condition == run.condition().name &&
                      row.trial_in_condition == run.staircase_->trials() &&
                      row.segments == run.staircase_->segments() &&
                      row.reference == (run.reference_is_first() ? 1 : 2) && row.right == (row.answer == row.reference);
    if (!same)
      return fail("is not what this protocol and seed show there", where,
                  "use the protocol and the version of the program that it was begun with");
    run.take(row);
  }
  return run;
}

Progress ComparisonRun::progress() const {
  constexpr int kTrialsEach = 42;  // on average, 5.2.4
  const int left = static_cast<int>(order_.size() - place_) * kTrialsEach;
  const int here = staircase_ && !finished() ? staircase_->trials() : 0;
  return {trial_, trial_ + std::max(left - here, finished() ? 0 : 1)};
}

}  // namespace tangent::experiment

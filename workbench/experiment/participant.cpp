#include "workbench/experiment/participant.h"

#include <algorithm>
#include <cmath>

namespace tangent::experiment {
namespace {

constexpr double kExploring = 3.0;  // s, of one stimulus of a comparison

/// Puts moments into a run, one after the other.
template <class Run>
class Actor {
 public:
  explicit Actor(Run& run) : run_(run) {}
  std::optional<typename Run::Row> press(Key key, int digit = 0) { return act(0.2, false, key, digit); }
  void feel(double seconds) {
    act(0.3, true);
    act(seconds, true);
    act(0.1, false);
  }
  std::optional<typename Run::Row> act(double passed, bool touching, Key key = Key::none, int digit = 0,
                                       double from_start_m = 0.0) {
    moment_.t_s += passed;
    moment_.touching = touching;
    moment_.key = key;
    moment_.digit = digit;
    moment_.from_start_m = from_start_m;
    return run_.advance(moment_);
  }

 private:
  Run& run_;
  Moment moment_;
};

std::size_t draw(std::span<const double> shares, SplitMix& random) {
  double at = random.unit();
  for (std::size_t i = 0; i + 1 < shares.size(); ++i)
    if ((at -= shares[i]) < 0.0) return i;
  return shares.size() - 1;
}

/// Takes a run to its end. `feel`: what a stimulus of an interval (0, 1) takes, s; `right`: whether the answer is, of a
/// condition and segments.
template <class Feel, class Right>
Status compare_all(ComparisonRun& run, const Feel& feel, const Right& right,
                   const std::function<void(const ComparisonRow&)>& row) {
  Actor actor(run);
  int comparison = 0, exact_at = 0;
  while (!run.finished()) {
    const Shown shown = run.shown();
    if (shown.phase == Phase::training) {
      actor.press(Key::enter);
      continue;
    }
    const bool first = shown.phase == Phase::first;
    const Result<double> seconds = feel(shown.stimulus, first ? 0 : 1);
    if (!seconds) return tl::unexpected(seconds.error());
    actor.feel(*seconds);
    if (first) {
      exact_at = shown.stimulus.segments == 0 ? 1 : 2;
      comparison = shown.stimulus.segments;
      actor.press(Key::enter);
      continue;
    }
    comparison = std::max(comparison, shown.stimulus.segments);
    actor.press(Key::digit, right(shown.stimulus.condition, comparison) ? exact_at : 3 - exact_at);
    if (const auto made = actor.press(Key::enter)) row(*made);
  }
  return {};
}

/// Takes a session to its end. `answer`: to a stimulus, with the trial's own random numbers.
template <class Answer>
Status name_all(NamingRun& run, const Identification& design, std::uint64_t seed, const Answer& answer,
                const std::function<void(const NamingRow&)>& row) {
  Actor actor(run);
  while (!run.finished()) {
    const Shown shown = run.shown();
    if (shown.phase == Phase::guide) {
      actor.act(0.5, false);
      actor.act(design.hold_s, false);
      continue;
    }
    if (shown.phase != Phase::explore) {
      actor.press(Key::enter);
      continue;
    }
    SplitMix random(seed, static_cast<std::uint64_t>(run.progress().done));
    const Result<FeelingNamer::Named> named = answer(shown.stimulus, random);
    if (!named) return tl::unexpected(named.error());
    actor.act(0.3, true, Key::none, 0, 0.1);
    actor.act(named->touching_s, true, Key::none, 0, 0.1);
    actor.act(0.0, false, Key::none, 0, 0.1);
    actor.act(named->seconds - named->touching_s, false, Key::none, 0, 0.1);
    if (const auto made = actor.act(0.1, false, Key::digit, static_cast<int>(named->answer) + 1, 0.1)) row(*made);
  }
  return {};
}

}  // namespace

void take_part(ComparisonRun& run, const KnownComparer& participant, std::uint64_t seed,
               const std::function<void(const ComparisonRow&)>& row) {
  const auto feel = [](const Stimulus&, int) -> Result<double> { return kExploring; };
  const auto right = [&](const std::string& condition, int segments) {
    Psychometric function = participant.functions.at(condition);
    function.middle *= std::exp(participant.drift * run.trials_in_condition() / 100.0);
    // By the trial's own place, so that one who is interrupted answers as one who is not.
    SplitMix random(seed, static_cast<std::uint64_t>(run.progress().done));
    return random.unit() < function.right(segments);
  };
  static_cast<void>(compare_all(run, feel, right, row));
}

Status take_part(ComparisonRun& run, FeelingComparer& participant, std::uint64_t seed,
                 const std::function<void(const ComparisonRow&)>& row) {
  double exact = 0.0, polygon = 0.0;
  const auto feel = [&](const Stimulus& stimulus, int interval) -> Result<double> {
    SplitMix random(seed, static_cast<std::uint64_t>(2 * run.progress().done + interval));
    const auto felt = participant.feel(stimulus.condition, stimulus.segments, random);
    if (!felt) return tl::unexpected(felt.error());
    (stimulus.segments == 0 ? exact : polygon) = felt->size;
    return felt->seconds;
  };
  return compare_all(
      run, feel, [&](const std::string&, int) { return polygon > exact; }, row);
}

void take_part(NamingRun& run, const Identification& design, const KnownNamer& participant, std::uint64_t seed,
               const std::function<void(const NamingRow&)>& row) {
  const auto answer = [&](const Stimulus& shown, SplitMix& random) -> Result<FeelingNamer::Named> {
    const auto at = std::find(design.objects.begin(), design.objects.end(), shown.object);
    FeelingNamer::Named out;
    out.answer = draw(participant.shares[static_cast<std::size_t>(at - design.objects.begin())], random);
    out.seconds = participant.seconds * -std::log(1.0 - 0.999 * random.unit());
    out.touching_s = out.seconds * participant.touching_share;
    return out;
  };
  static_cast<void>(name_all(run, design, seed, answer, row));
}

Status take_part(NamingRun& run, const Identification& design, FeelingNamer& participant, std::uint64_t seed,
                 const std::function<void(const NamingRow&)>& row) {
  const auto answer = [&](const Stimulus& shown, SplitMix& random) { return participant.name(shown, random); };
  return name_all(run, design, seed, answer, row);
}

}  // namespace tangent::experiment

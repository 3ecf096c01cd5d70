#include "workbench/recording/explain_recording.h"

#include "core/lab/explain/explain_run.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <thread>
#include <tuple>

namespace tangent {
namespace {

constexpr std::size_t kStatesATurn = 8;  // a thread takes so many kept states, about 8 s, at once

constexpr std::size_t kMostLost = 5000;  // ticks of a run without a contact that are solved again for a cure
constexpr std::size_t kMostStatesBack =
    6;  // kept states, about a second each, that a run's first tick is looked for in

/// The ticks without a contact up to the one that a walk is at.
class LostTicks {
 public:
  void add(const TickWalk& walk) {
    const TickRecord& tick = walk.tick().record.tick;
    if (is_converged(walk.output().status)) {
      inputs_.clear();
      return;
    }
    const bool goes_on = !inputs_.empty() && walk.follows() && scene_ == walk.scene() && preset_ == &walk.preset();
    if (!goes_on) {
      inputs_.clear();
      before_ = tick.kept;
      scene_ = walk.scene();
      preset_ = &walk.preset();
      why_first.reset();
    }
    if (inputs_.size() <= kMostLost) inputs_.push_back(tick.input);
  }
  std::size_t ticks() const { return inputs_.size(); }
  bool too_many() const { return inputs_.size() > kMostLost; }
  LostRun run() const { return {before_, inputs_}; }
  /// The first of them is not the first of all: the walk began within the run.
  bool began_before() const { return !inputs_.empty() && was_lost(before_); }

  std::optional<TickExplanation> why_first;  ///< where it was asked for

 private:
  TickState before_;
  std::vector<TickInput> inputs_;
  std::shared_ptr<const ContactScene> scene_;
  const Preset* preset_ = nullptr;
};

ExplainedTick explained(const TickWalk& walk, const ExplainOptions& options) {
  const TickRecord& tick = walk.tick().record.tick;
  return {tick.tick, tick.input.t_s, explain_tick(walk.scene(), walk.preset(), tick.input, tick.kept, options),
          output_digest(walk.output()) == walk.tick().digest};
}

/// A walk that has come to the tick, from `back` kept states before the last one on; `lost` sees every tick.
Result<TickWalk> walk_from(ComputableRecording& opened, std::uint64_t tick, std::size_t back, LostTicks& lost) {
  auto& [recording, states, scenes] = opened;
  const auto after = std::upper_bound(states.begin(), states.end(), tick,
                                      [](std::uint64_t t, const KeptState& state) { return t < state.tick; });
  const auto nearest = static_cast<std::size_t>(after - states.begin());
  Result<TickWalk> walk = TickWalk::start(recording, scenes, states, nearest - std::min(back + 1, nearest), tick);
  while (walk) {
    const Result<bool> any = walk->next();
    if (!any) return tl::unexpected(any.error());
    if (!*any) break;
    lost.add(*walk);
  }
  return walk;
}

/// The same where the tick follows others without a contact.
ExplainedTick explained_run(const TickWalk& walk, const LostTicks& lost, const ExplainOptions& options) {
  if (lost.ticks() < 2 || lost.too_many()) return explained(walk, options);
  ExplainedTick out{walk.tick().record.tick.tick, walk.tick().record.tick.input.t_s,
                    explain_run(walk.scene(), walk.preset(), lost.run(), options),
                    output_digest(walk.output()) == walk.tick().digest};
  // Else something came in between that is no tick, and what is solved again is another run.
  return output_digest(out.why.tick) == output_digest(walk.output()) ? out : explained(walk, options);
}

bool is_worse(const ExplainedTick& a, const ExplainedTick& b) {
  const auto badness = [](const ExplainedTick& e) {
    const TickOutput& out = e.why.tick;
    const bool lost = !is_converged(out.status);
    return std::tuple(lost, lost ? out.error_m : 0.0, out.iterations);
  };
  return badness(a) > badness(b) || (badness(a) == badness(b) && a.tick < b.tick);
}

using ByCause = std::array<CauseInRecording, kTickCauses.size()>;

void add_cause(CauseInRecording& into, const CauseInRecording& part) {
  if (part.ticks == 0) return;
  if (into.ticks == 0 || is_worse(part.worst, into.worst)) into.worst = part.worst;
  into.cause = part.cause;
  into.ticks += part.ticks;
}

/// What the threads share.
struct ExplainWork {
  const std::filesystem::path& path;
  const ExplainRecordingOptions& options;
  const RecordedScenes& scenes;
  const std::vector<KeptState>& states;
  std::uint64_t last_tick, most_a_turn;
  std::atomic<std::size_t> next{0};
  std::atomic<std::uint64_t> done{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  ///< of those below
  ExplainedRecording found;
  ByCause causes;
  Status failure;
};

/// One thread's part.
class Explainer {
 public:
  Explainer(ExplainWork& work, Recording recording) : work_(work), recording_(std::move(recording)) {}

  Status run() {
    for (;;) {
      const std::size_t begin = work_.next.fetch_add(kStatesATurn);
      if (begin >= work_.states.size() || work_.stop) return {};
      if (Status ok = turn(begin); !ok) return ok;
    }
  }
  void hand_in() {
    const std::scoped_lock lock(work_.mutex);
    work_.found.ticks += found_.ticks;
    work_.found.wanted += found_.wanted;
    work_.found.explained += found_.explained;
    for (std::size_t i = 0; i < causes_.size(); ++i) add_cause(work_.causes[i], causes_[i]);
  }

 private:
  Status turn(std::size_t begin) {
    const std::size_t end = begin + kStatesATurn;
    const std::uint64_t last = end < work_.states.size() ? work_.states[end].tick - 1 : work_.last_tick;
    Result<TickWalk> walk = TickWalk::start(recording_, work_.scenes, work_.states, begin, last);
    if (!walk) return tl::unexpected(walk.error());
    lost_ = {};
    std::uint64_t explained_here = 0;
    for (TickOutput before; !work_.stop; before = walk->output()) {
      const Result<bool> any = walk->next();
      if (!any) return tl::unexpected(any.error());
      if (!*any) return {};
      lost_.add(*walk);
      if (++found_.ticks % 1024 == 0) work_.options.progress(work_.done += 1024);
      if (work_.options.cancelled()) work_.stop = true;
      if (!wanted(*walk, before)) continue;
      ++found_.wanted;
      if (explained_here < work_.most_a_turn) explained_here += explain(*walk) ? 1 : 0;
    }
    return {};
  }

  bool wanted(const TickWalk& walk, const TickOutput& before) const {
    const bool raw = !is_smooth(reported_method(walk.preset()));
    if (raw && walk.follows() && normal_jumped(before, walk.output())) return true;
    return wants_explaining(walk.output(), work_.options.explain);
  }

  /// One that follows others without a contact has the cause of the first of them.
  ExplainedTick explained_here(const TickWalk& walk) {
    if (lost_.ticks() < 2 || lost_.too_many() || !lost_.why_first) {
      ExplainedTick e = explained(walk, work_.options.explain);
      if (lost_.ticks() == 1) lost_.why_first = e.why;
      return e;
    }
    const TickRecord& tick = walk.tick().record.tick;
    ExplainedTick e{tick.tick, tick.input.t_s, *lost_.why_first, output_digest(walk.output()) == walk.tick().digest};
    e.why.tick = walk.output();
    e.why.lost_before = lost_.ticks() - 1;
    e.why.cure = {};
    return e;
  }

  bool explain(const TickWalk& walk) {
    const ExplainedTick e = explained_here(walk);
    if (e.why.cause == TickCause::nothing) {
      --found_.wanted;
      return false;
    }
    ++found_.explained;
    add_cause(causes_[static_cast<std::size_t>(e.why.cause)], {e.why.cause, 1, e});
    return true;
  }

  ExplainWork& work_;
  Recording recording_;
  LostTicks lost_;
  ExplainedRecording found_;
  ByCause causes_;
};

void explain_in_thread(ExplainWork& work) {
  Status done;
  if (Result<Recording> recording = Recording::open(work.path)) {
    Explainer explainer(work, std::move(*recording));
    done = explainer.run();
    explainer.hand_in();
  } else {
    done = tl::unexpected(recording.error());
  }
  if (done) return;
  work.stop = true;
  const std::scoped_lock lock(work.mutex);
  if (work.failure) work.failure = done;
}

}  // namespace

Result<ExplainedTick> explain_recorded_tick(const std::filesystem::path& path, std::uint64_t tick,
                                            const ExplainRecordingOptions& options) {
  Result<ComputableRecording> opened = open_computable(path, options.scene);
  if (!opened) return tl::unexpected(opened.error());
  auto& [recording, states, scenes] = *opened;
  const Result<TickWalk> there = walk_to(recording, scenes, states, tick);
  if (!there) return tl::unexpected(there.error());
  if (is_converged(there->output().status) || !was_lost(there->tick().record.tick.kept))
    return explained(*there, options.explain);
  for (std::size_t back = 0;; ++back) {
    LostTicks lost;
    const Result<TickWalk> walk = walk_from(*opened, tick, back, lost);
    if (!walk) return tl::unexpected(walk.error());
    if (!lost.began_before() || lost.too_many() || back == kMostStatesBack)
      return explained_run(*walk, lost, options.explain);
  }
}

Result<ExplainedRecording> explain_recording(const std::filesystem::path& path,
                                             const ExplainRecordingOptions& options) {
  Result<ComputableRecording> opened = open_computable(path, options.scene);
  if (!opened) return tl::unexpected(opened.error());
  auto& [recording, states, scenes] = *opened;
  const std::uint64_t turns = (states.size() + kStatesATurn - 1) / kStatesATurn;
  const std::uint64_t most_a_turn = std::max<std::uint64_t>(1, options.most / std::max<std::uint64_t>(1, turns));
  ExplainWork work{path, options, scenes, states, recording.info().last_tick, most_a_turn, {}, {}, {}, {}, {}, {}, {}};
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::clamp(options.threads, 1u, 64u); ++i)
    threads.emplace_back([&work] { explain_in_thread(work); });
  explain_in_thread(work);
  for (std::thread& thread : threads) thread.join();
  if (!work.failure) return tl::unexpected(work.failure.error());
  for (CauseInRecording& cause : work.causes) {
    if (cause.ticks == 0) continue;
    if (cause.worst.why.lost_before > 0 && !work.stop) {  // its cure has to be looked for from the run's first tick on
      Result<ExplainedTick> worst = explain_recorded_tick(path, cause.worst.tick, options);
      if (!worst) return tl::unexpected(worst.error());
      if (worst->why.cause == cause.cause) cause.worst = std::move(*worst);
    }
    work.found.causes.push_back(cause);
  }
  std::stable_sort(work.found.causes.begin(), work.found.causes.end(),
                   [](const CauseInRecording& a, const CauseInRecording& b) { return a.ticks > b.ticks; });
  work.found.cancelled = work.stop;
  return std::move(work.found);
}

}  // namespace tangent

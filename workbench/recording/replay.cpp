#include "workbench/recording/replay.h"

#include "core/base/text.h"
#include "workbench/recording/byte_stream.h"
#include "workbench/recording/state_bytes.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <thread>

namespace tangent {
namespace {

constexpr std::size_t kStatesAChunk = 8;

/// From one kept state to the tick before a later one.
struct Chunk {
  std::size_t begin = 0, end = 0;  ///< of the kept states
};

/// What all threads read, and what they find.
struct Work {
  const std::filesystem::path& path;
  const ReplayOptions& options;
  std::vector<KeptState> states;
  RecordedScenes scenes;
  std::uint64_t last_tick = 0;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> done{0};
  std::mutex mutex;  ///< of the two below
  ReplayReport report;
  Status failure;
};

std::string text_of(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

/// Adds what differs in a tick to the report.
class Differences {
 public:
  explicit Differences(ReplayReport& report) : report_(report) {}

  void compare(RecordedTick& recorded, const TickOutput& output) {
    RecordedTick computed = recorded;
    computed.record.tick.output = output;
    const std::uint64_t tick = recorded.record.tick.tick;
    bool differs = false;
    for (const WholeColumn& column : whole_columns()) {
      const std::int64_t was = column.get(recorded), is = column.get(computed);
      if (column.of != ColumnOf::output || was == is) continue;
      differs = true;
      if (column.word != nullptr)
        note({tick, std::string(column.name), column.word(was), column.word(is)});
      else
        note({tick, std::string(column.name), std::to_string(was), std::to_string(is)},
             std::abs(static_cast<double>(was - is)));
    }
    for (const RealColumn& column : real_columns()) {
      const double was = column.at(recorded), is = column.at(computed);
      if (column.of != ColumnOf::output || same_bits(was, is)) continue;
      differs = true;
      note({tick, std::string(column.name), text_of(was), text_of(is)}, std::abs(was - is));
    }
    const std::uint64_t digest = output_digest(output);
    if (digest != recorded.digest && !differs) {
      differs = true;
      note({tick, "digest", std::to_string(recorded.digest), std::to_string(digest)});
    }
    if (differs) ++report_.different;
  }

  void note(const TickDifference& found, double by = 0.0) {
    ++report_.changed[found.field];
    double& largest = report_.largest[found.field];
    largest = std::max(largest, by);
    if (!report_.first || found.tick < report_.first->tick) report_.first = found;
  }

 private:
  ReplayReport& report_;
};

/// A thread's own recording and stepper.
class Replayer {
 public:
  Replayer(Work& work, Recording recording) : work_(work), recording_(std::move(recording)), differences_(report_) {}

  Status run() {
    for (;;) {
      const std::size_t begin = work_.next.fetch_add(kStatesAChunk);
      if (begin >= work_.states.size() || work_.stop) return {};
      const Chunk chunk{begin, std::min(begin + kStatesAChunk, work_.states.size())};
      if (Status ok = work_.options.every_second ? sample(chunk) : replay(chunk); !ok) return ok;
    }
  }
  const ReplayReport& report() const { return report_; }

 private:
  Status replay(const Chunk& chunk) {
    const std::uint64_t last = chunk.end < work_.states.size() ? work_.states[chunk.end].tick - 1 : work_.last_tick;
    Result<TickReader> ticks = recording_.ticks(work_.states[chunk.begin].tick, last);
    if (!ticks) return tl::unexpected(ticks.error());
    std::size_t next = chunk.begin;
    bool chained = false;
    std::uint64_t expected = 0;
    for (RecordedTick tick;;) {
      const Result<bool> any = ticks->next(tick);
      if (!any) return tl::unexpected(any.error());
      if (!*any) return {};
      const std::uint64_t number = tick.record.tick.tick;
      const bool kept = next < chunk.end && work_.states[next].tick == number;
      if (!kept && (!chained || number != expected))
        return fail("tick " + std::to_string(number) + " follows a gap, and has no kept state", work_.path.string(),
                    "the file is damaged: copy it from where it was recorded again");
      if (Status ok = step(tick, kept ? &work_.states[next] : nullptr, chained); !ok) return ok;
      next += kept ? 1 : 0;
      chained = true;
      expected = number + 1;
      if (work_.options.cancelled()) work_.stop = true;
      if (work_.stop) return {};
    }
  }

  /// The kept states' ticks alone.
  Status sample(const Chunk& chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      Result<TickReader> ticks = recording_.ticks(work_.states[i].tick, work_.states[i].tick);
      if (!ticks) return tl::unexpected(ticks.error());
      RecordedTick tick;
      const Result<bool> any = ticks->next(tick);
      if (!any) return tl::unexpected(any.error());
      if (!*any) continue;
      if (Status ok = step(tick, &work_.states[i], false); !ok) return ok;
    }
    return {};
  }

  Status step(RecordedTick& tick, const KeptState* kept, bool chained) {
    const auto scene = work_.scenes.find(tick.record.scene_id);
    const auto preset = recording_.presets().find(tick.record.tick.preset_id);
    if (scene == work_.scenes.end() || preset == recording_.presets().end())
      return fail("tick " + std::to_string(tick.record.tick.tick) + " names a scene or preset that is not there",
                  work_.path.string(), "the file is damaged: copy it from where it was recorded again");
    if (!stepper_ || &stepper_->scene() != scene->second.get()) stepper_.emplace(scene->second);
    if (kept != nullptr)
      if (Status ok = take(*kept, chained); !ok) return ok;
    const TickOutput output = stepper_->step(preset->second, tick.record.tick.input, state_);
    ++report_.checked;
    if (output_digest(output) != tick.digest || output_digest(tick.record.tick.output) != tick.digest)
      differences_.compare(tick, output);
    if (report_.checked % 1024 == 0) work_.options.progress(work_.done += 1024);
    return {};
  }

  Status take(const KeptState& kept, bool chained) {
    Result<TickState> state = recording_.state(kept.tick, stepper_->scene());
    if (!state) return tl::unexpected(state.error());
    if (chained && !kept.touched) {
      ++report_.states;
      if (state_bytes(*state) != state_bytes(state_)) differences_.note({kept.tick, "state", "as kept", "another"});
    }
    state_ = *state;
    return {};
  }

  Work& work_;
  Recording recording_;
  ReplayReport report_;
  Differences differences_;
  std::optional<Stepper> stepper_;
  TickState state_;
};

void join(ReplayReport& into, const ReplayReport& part) {
  into.checked += part.checked;
  into.different += part.different;
  into.states += part.states;
  for (const auto& [field, count] : part.changed) into.changed[field] += count;
  for (const auto& [field, by] : part.largest) into.largest[field] = std::max(into.largest[field], by);
  if (part.first && (!into.first || part.first->tick < into.first->tick)) into.first = part.first;
}

void work_on(Work& work) {
  Status done;
  if (Result<Recording> recording = Recording::open(work.path)) {
    Replayer replayer(work, std::move(*recording));
    done = replayer.run();
    const std::scoped_lock lock(work.mutex);
    join(work.report, replayer.report());
  } else {
    done = tl::unexpected(recording.error());
  }
  if (done) return;
  work.stop = true;
  const std::scoped_lock lock(work.mutex);
  if (work.failure) work.failure = done;
}

}  // namespace

Result<ReplayReport> replay(const std::filesystem::path& path, const ReplayOptions& options) {
  Result<ComputableRecording> opened = open_computable(path, options.scene);
  if (!opened) return tl::unexpected(opened.error());
  const std::uint64_t last_tick = opened->recording.info().last_tick;
  Work work{path, options, std::move(opened->states), std::move(opened->scenes), last_tick, {}, {}, {}, {}, {}, {}};
  std::vector<std::thread> threads;
  const unsigned count = std::clamp(options.threads, 1u, 64u);
  for (unsigned i = 1; i < count; ++i) threads.emplace_back([&work] { work_on(work); });
  work_on(work);
  for (std::thread& thread : threads) thread.join();
  if (!work.failure) return tl::unexpected(work.failure.error());
  work.report.cancelled = work.stop;
  return work.report;
}

}  // namespace tangent

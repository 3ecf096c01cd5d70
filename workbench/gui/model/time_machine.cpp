#include "workbench/gui/model/time_machine.h"

#include "workbench/session/background_thread.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace tangent {

namespace {

/// The part in view, up to this many ticks, is solved first where the past is kMuchLonger than that.
constexpr std::size_t kViewTicks = 60 * 1024;
constexpr std::size_t kMuchLonger = 4;
/// A run over the whole past older than this is cancelled for a newer request.
constexpr std::chrono::milliseconds kPatience{50};

std::shared_ptr<const ChannelStore> make_channels(const RecordedRun& run, const ResolvedHistory& numbers) {
  if (run.records.empty()) return std::make_shared<ChannelStore>(kGhostChannelCount, 1);
  const std::uint64_t first = run.records.oldest().tick.tick, end = run.records.newest().tick.tick + 1;
  std::vector<float> rows(kGhostChannelCount * (end - first), std::numeric_limits<float>::quiet_NaN());
  for (const ResolvedTick& tick : numbers.ticks) {
    if (!tick.solved) continue;
    const GhostRow row =
        ghost_row(tick.force_n[0], tick.force_n[1], tick.force_n[2], tick.cld_m, tick.error_m, tick.iterations);
    std::copy(row.begin(), row.end(),
              rows.begin() + static_cast<std::ptrdiff_t>(kGhostChannelCount * (tick.tick - first)));
  }
  auto store = std::make_shared<ChannelStore>(kGhostChannelCount, end - first);
  store->assign(first, rows);
  return store;
}

}  // namespace

/// One run over the past under one preset, or a comparison of two, shared by the worker threads.
struct TimeMachine::Job {
  Job(RecordedRun part, std::optional<Preset> under, bool timed)
      : run(std::move(part)),
        preset(under),
        resolver(std::make_unique<HistoryResolver>(run, under, timed)),
        chunks(resolver->chunk_count()) {}
  Job(const RunPart& part, const Pair& both, bool timed)
      : pair(std::make_unique<PresetComparison>(part.run, part.first, both.before, both.after, timed)),
        chunks(pair->chunk_count()) {}
  void solve_chunk(std::size_t chunk) {
    if (pair)
      pair->solve_chunk(chunk);
    else
      resolver->solve_chunk(chunk);
  }

  const RecordedRun run;
  const std::optional<Preset> preset;  ///< empty: verification, or a comparison
  const std::unique_ptr<HistoryResolver> resolver;
  const std::unique_ptr<PresetComparison> pair;  ///< if so, the resolver is null
  const std::size_t chunks;
  bool whole = false;
  std::uint64_t generation = 0;
  const std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> cancelled{false};
};

TimeMachine::TimeMachine(unsigned threads) {
  for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this](std::stop_token stop) { work(std::move(stop)); });
}

TimeMachine::~TimeMachine() {
  close();
  for (std::jthread& thread : threads_) thread.request_stop();
  wake_.notify_all();
}

void TimeMachine::open(RecordedRun run) {
  close();
  const std::scoped_lock lock(guard_);
  run_ = std::make_shared<const RecordedRun>(std::move(run));
  want_verified_ = true;
  schedule();
}

void TimeMachine::close() {
  const std::scoped_lock lock(guard_);
  cancel_job();
  run_.reset();
  wanted_.reset();
  pair_.reset();
  want_view_ = want_whole_ = want_verified_ = want_pair_ = false;
  ghost_.reset();
  verified_.reset();
  compared_.reset();
  ++generation_;
}

void TimeMachine::request(const Preset& preset, double from_tick, double to_tick) {
  if (!run_) return;
  const std::scoped_lock lock(guard_);
  wanted_ = preset;
  from_ = from_tick;
  to_ = to_tick;
  want_view_ = want_whole_ = true;
  // A run over the part in view is short, so it is finished; runs over the whole past and comparisons are cancelled.
  if (job_ && job_->pair) {
    want_pair_ = true;
    cancel_job();
  } else if (job_ && job_->whole && std::chrono::steady_clock::now() - job_->began > kPatience) {
    if (!job_->preset) want_verified_ = true;
    cancel_job();
  }
  schedule();
}

void TimeMachine::compare(const Preset& before, const Preset& after, const TickRange& range) {
  if (!run_) return;
  const std::scoped_lock lock(guard_);
  if (job_ && job_->pair) cancel_job();
  pair_ = {before, after, range};
  compared_.reset();
  want_pair_ = true;
  schedule();
}

void TimeMachine::cancel_job() {
  if (job_) job_->cancelled = true;
  job_.reset();
}

void TimeMachine::forget_request() {
  const std::scoped_lock lock(guard_);
  if (job_ && (job_->preset || job_->pair)) cancel_job();
  wanted_.reset();
  pair_.reset();
  want_view_ = want_whole_ = want_pair_ = false;
  ghost_.reset();
  compared_.reset();
  ++generation_;
  schedule();
}

bool TimeMachine::busy() const {
  const std::scoped_lock lock(guard_);
  return job_ != nullptr || want_view_ || want_whole_ || want_verified_ || want_pair_;
}

std::shared_ptr<const Ghost> TimeMachine::ghost() const {
  const std::scoped_lock lock(guard_);
  return ghost_;
}

std::shared_ptr<const Ghost> TimeMachine::verified() const {
  const std::scoped_lock lock(guard_);
  return verified_;
}

std::shared_ptr<const PresetsCompared> TimeMachine::compared() const {
  const std::scoped_lock lock(guard_);
  return compared_;
}

/// Null: the range is not in the recording.
std::shared_ptr<TimeMachine::Job> TimeMachine::make_pair_job() const {
  const HistorySnapshot& all = run_->records;
  const std::size_t begin = all.lower_bound(pair_->range.from), end = all.lower_bound(pair_->range.to + 1);
  if (begin >= end) return nullptr;
  auto job = std::make_shared<Job>(part_of(*run_, begin, end), *pair_, !threads_.empty());
  job->generation = generation_;
  return job;
}

std::shared_ptr<TimeMachine::Job> TimeMachine::make_job(std::optional<Preset> preset, std::size_t begin,
                                                        std::size_t end) const {
  RecordedRun part = *run_;
  part.records = run_->records.slice(begin, end);
  auto job = std::make_shared<Job>(std::move(part), std::move(preset), !threads_.empty());
  job->whole = begin == 0 && end == run_->records.size();
  job->generation = generation_;
  return job;
}

/// Takes the most urgent of what is wanted; null: it can't be done, or need not be.
std::shared_ptr<TimeMachine::Job> TimeMachine::next_job() {
  const std::size_t size = run_->records.size();
  if (std::exchange(want_view_, false)) {
    const auto to_record = [&](double tick) {
      return run_->records.lower_bound(static_cast<std::uint64_t>(std::max(0.0, tick)));
    };
    const std::size_t end = to_record(to_), begin = std::max(to_record(from_), end > kViewTicks ? end - kViewTicks : 0);
    return begin >= end || (end - begin) * kMuchLonger > size ? nullptr : make_job(wanted_, begin, end);
  }
  if (std::exchange(want_whole_, false)) return make_job(wanted_, 0, size);
  if (std::exchange(want_verified_, false)) return make_job(std::nullopt, 0, size);
  want_pair_ = false;
  return make_pair_job();
}

/// Starts the next job if none is in progress. Call under the lock.
void TimeMachine::schedule() {
  while (!job_ && run_ && (want_view_ || want_whole_ || want_verified_ || want_pair_)) {
    job_ = next_job();
    if (!job_) continue;
    if (!threads_.empty()) {
      wake_.notify_all();
      return;
    }
    const std::shared_ptr<Job> job = job_;
    for (std::size_t chunk = 0; chunk < job->chunks; ++chunk) job->solve_chunk(chunk);
    publish(*job);
  }
}

void TimeMachine::work(std::stop_token stop) {
  yield_to_servo_and_window();
  while (!stop.stop_requested()) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(guard_);
      wake_.wait(lock, stop,
                 [this] { return job_ != nullptr && job_->next.load() < std::max<std::size_t>(1, job_->chunks); });
      if (stop.stop_requested()) return;
      job = job_;
    }
    work_on(*job);
  }
}

/// The thread that finishes the last chunk publishes the result.
void TimeMachine::work_on(Job& job) {
  for (;;) {
    const std::size_t chunk = job.next.fetch_add(1);
    if (chunk >= std::max<std::size_t>(1, job.chunks) || job.cancelled) return;
    if (job.chunks > 0) job.solve_chunk(chunk);
    if (job.done.fetch_add(1) + 1 < job.chunks) continue;
    if (job.cancelled) return;
    publish(job);
    return;
  }
}

/// With threads, runs outside the lock, so that the window never waits for it; without threads the lock is held.
void TimeMachine::publish(Job& job) {
  std::shared_ptr<const PresetsCompared> compared;
  auto ghost = std::make_shared<Ghost>();
  if (job.pair) {
    compared = std::make_shared<const PresetsCompared>(job.pair->finish());
  } else {
    ghost->numbers = job.resolver->finish();
    ghost->whole = job.whole;
  }
  if (job.preset) {
    ghost->preset = *job.preset;
    ghost->channels = make_channels(job.run, ghost->numbers);
  }
  ghost->numbers.ticks = {};
  const auto put = [&] {
    if (job.generation != generation_ || job_.get() != &job) return;
    if (job.pair)
      compared_ = std::move(compared);
    else
      (job.preset ? ghost_ : verified_) = std::move(ghost);
    job_.reset();
  };
  if (threads_.empty()) {
    put();
    return;
  }
  const std::scoped_lock lock(guard_);
  put();
  schedule();
}

}  // namespace tangent

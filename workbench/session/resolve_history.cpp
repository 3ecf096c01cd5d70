#include "workbench/session/resolve_history.h"

#include "core/tick/render_again.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>

namespace tangent {

namespace {

constexpr std::uint64_t kJoinWithin = 20;  ///< ticks: changes at most this far apart are one entry

std::int64_t thread_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const Vec3& a, const Vec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

/// Accumulates the numbers of a run; a histogram of iterations gives percentiles without sorting.
struct RunCounter {
  RunNumbers numbers;
  double error_sum = 0.0, iteration_sum = 0.0;
  std::vector<std::uint64_t> by_iterations;

  void count(std::int32_t iterations, std::uint64_t times) {
    const auto i = static_cast<std::size_t>(std::max(0, iterations));
    if (i >= by_iterations.size()) by_iterations.resize(std::max<std::size_t>(64, i + 1));
    by_iterations[i] += times;
  }
  void add(TickStatus status, double error_m, std::int32_t iterations) {
    ++numbers.ticks;
    if (!is_converged(status)) ++numbers.unconverged;
    error_sum += error_m;
    iteration_sum += iterations;
    numbers.worst_error_m = std::max(numbers.worst_error_m, error_m);
    numbers.most_iterations = std::max(numbers.most_iterations, iterations);
    count(iterations, 1);
  }
  void add(const RunCounter& other) {
    numbers.ticks += other.numbers.ticks;
    numbers.unconverged += other.numbers.unconverged;
    error_sum += other.error_sum;
    iteration_sum += other.iteration_sum;
    numbers.worst_error_m = std::max(numbers.worst_error_m, other.numbers.worst_error_m);
    numbers.most_iterations = std::max(numbers.most_iterations, other.numbers.most_iterations);
    for (std::size_t i = 0; i < other.by_iterations.size(); ++i) {
      if (other.by_iterations[i] > 0) count(static_cast<std::int32_t>(i), other.by_iterations[i]);
    }
  }
  RunNumbers done() const {
    RunNumbers out = numbers;
    if (out.ticks == 0) return out;
    const auto n = static_cast<double>(out.ticks);
    out.mean_iterations = iteration_sum / n;
    out.mean_error_m = error_sum / n;
    const auto rank = static_cast<std::uint64_t>(std::ceil(0.99 * n));
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < by_iterations.size() && below < rank; ++i) {
      below += by_iterations[i];
      out.p99_iterations = static_cast<std::int32_t>(i);
    }
    return out;
  }
};

void join(ContactChange& into, const ContactChange& next) {
  into.last_tick = next.last_tick;
  into.ticks += next.ticks;
  if (!(next.moved_m > into.moved_m)) return;
  into.worst_tick = next.worst_tick;
  into.moved_m = next.moved_m;
  into.recorded = next.recorded;
  into.resolved = next.resolved;
}

/// Merges the change with the last one if that is near; drops it beyond kMostChanges.
void append(std::vector<ContactChange>& changes, const ContactChange& next) {
  if (!changes.empty() && next.first_tick <= changes.back().last_tick + kJoinWithin)
    join(changes.back(), next);
  else if (changes.size() < ResolvedHistory::kMostChanges)
    changes.push_back(next);
}

/// Where there is a contact: free, touching, or none that could be found.
int kind_of(TickStatus status) { return status == TickStatus::free ? 0 : is_converged(status) ? 1 : 2; }

}  // namespace

bool contact_changed(const TickOutput& recorded, const TickOutput& resolved, double tolerance_m) {
  if (kind_of(recorded.status) != kind_of(resolved.status)) return true;
  const Vec3 d = resolved.contact - recorded.contact;
  return glm::dot(d, d) > 100.0 * tolerance_m * tolerance_m;
}

bool same_bits(const TickOutput& a, const TickOutput& b) {
  return a.status == b.status && a.event == b.event && a.triangle == b.triangle && same(a.u, b.u) && same(a.v, b.v) &&
         same(a.contact, b.contact) && same(a.normal, b.normal) && same(a.penetration_m, b.penetration_m) &&
         same(a.force_n, b.force_n) && same(a.cld_m, b.cld_m) && same(a.error_m, b.error_m) &&
         a.iterations == b.iterations && a.triangle_changes == b.triangle_changes;
}

/// Results of one chunk.
struct HistoryResolver::ChunkSummary {
  RunCounter recorded, resolved;
  std::uint64_t different = 0, changed = 0, taken_over = 0;
  std::vector<ContactChange> changes;
  std::int64_t ns = 0;
  bool done = false;

  void add(const TickOutput& was, const TickOutput& out, const ResolvedTick& tick) {
    recorded.add(was.status, was.error_m, was.iterations);
    resolved.add(out.status, out.error_m, out.iterations);
    if (!tick.same_bits) ++different;
    if (!tick.contact_changed) return;
    ++changed;
    append(changes, {tick.tick, tick.tick, tick.tick, static_cast<double>(tick.moved_m), was.status, out.status, 1});
  }
};

HistoryResolver::HistoryResolver(const RecordedRun& run, std::optional<Preset> preset, bool timed)
    : run_(run), preset_(std::move(preset)), timed_(timed) {
  ticks_.resize(run.records.size());
  summaries_.resize(chunk_count());
}

HistoryResolver::~HistoryResolver() = default;

std::size_t HistoryResolver::chunk_count() const { return (run_.records.size() + kChunk - 1) / kChunk; }

/// Steps through consecutive records, carrying state and stepper from one to the next.
class HistoryResolver::Replay {
 public:
  Replay(const RecordedRun& run, const Preset* wish) : run_(run), wish_(wish) {}

  /// Solves the tick again; empty when its scene or preset is gone. `taken_over`: its contact is the recorded one.
  std::optional<TickOutput> step(const ServoRecord& record, bool& taken_over) {
    const TickRecord& tick = record.tick;
    enter_scene(record);
    const bool follows =
        before_ != nullptr && record.scene_id == before_->scene_id && tick.tick == before_->tick.tick + 1;
    if (!follows) {
      as_recorded_ = true;
      rendered_ = tick.kept.rendered;
    }
    const bool changed = follows && wish_ == nullptr && tick.preset_id != before_->tick.preset_id;
    if (changed) {  // as the servo did
      begin_change(rendered_);
      begin_change(state_.rendered);
    }
    before_ = &record;
    taken_over = false;
    if (!stepper_ || preset(record) == nullptr) {
      as_recorded_ = true;
      return std::nullopt;
    }
    const bool alike = wish_ != nullptr && same_contacts_as(recorded_preset(record));
    if (alike && as_recorded_ && is_converged(tick.output.status)) {
      taken_over = true;
      return render_again(stepper_->scene(), *wish_, tick.input, tick.kept, rendered_, tick.output);
    }
    if (as_recorded_) {
      state_ = tick.kept;
      state_.rendered = rendered_;
    }
    as_recorded_ = as_recorded_ && alike;
    const TickOutput out = stepper_->step(*preset(record), tick.input, state_);
    rendered_ = state_.rendered;
    return out;
  }

  double tolerance_m(const ServoRecord& record) const {
    const Preset* recorded = recorded_preset(record);
    const double own = preset(record)->solver.tolerance_m;
    return recorded != nullptr ? std::max(own, recorded->solver.tolerance_m) : own;
  }

 private:
  const Preset* recorded_preset(const ServoRecord& record) const {
    return record.tick.preset_id < run_.presets.size() ? &run_.presets[record.tick.preset_id] : nullptr;
  }
  const Preset* preset(const ServoRecord& record) const { return wish_ != nullptr ? wish_ : recorded_preset(record); }

  void enter_scene(const ServoRecord& record) {
    if (before_ != nullptr && record.scene_id == before_->scene_id) return;
    const auto scene = run_.scenes.find(record.scene_id);
    stepper_.reset();
    if (scene != run_.scenes.end()) stepper_.emplace(scene->second);
  }

  bool same_contacts_as(const Preset* recorded) {
    if (recorded != compared_) {
      compared_ = recorded;
      alike_ = recorded != nullptr && same_contacts(*wish_, *recorded);
    }
    return alike_;
  }

  const RecordedRun& run_;
  const Preset* wish_;              ///< null: each tick under its recorded preset
  std::optional<Stepper> stepper_;  ///< none: the scene is gone
  const ServoRecord* before_ = nullptr;
  TickState state_;
  RenderedState rendered_;            ///< of the previous tick, as solved here
  bool as_recorded_ = true;           ///< the next tick starts from the recorded state, not from `state_`
  const Preset* compared_ = nullptr;  ///< recorded preset for which `alike_` was computed
  bool alike_ = false;
};

void HistoryResolver::solve_chunk(std::size_t chunk) {
  const std::int64_t began = timed_ ? thread_ns() : 0;
  const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, run_.records.size());
  ChunkSummary& summary = summaries_[chunk];
  Replay replay(run_, preset_ ? &*preset_ : nullptr);
  for (std::size_t i = begin > kLeadIn ? begin - kLeadIn : 0; i < end; ++i) {
    const ServoRecord& record = run_.records[i];
    const TickOutput& was = record.tick.output;
    bool taken_over = false;
    const std::optional<TickOutput> out = replay.step(record, taken_over);
    if (i < begin) continue;
    ticks_[i].tick = record.tick.tick;
    if (!out) continue;
    const Vec3 d = out->contact - was.contact;
    ticks_[i] = {.tick = record.tick.tick,
                 .force_n = {static_cast<float>(out->force_n.x), static_cast<float>(out->force_n.y),
                             static_cast<float>(out->force_n.z)},
                 .cld_m = static_cast<float>(out->cld_m),
                 .error_m = static_cast<float>(out->error_m),
                 .moved_m = static_cast<float>(std::sqrt(glm::dot(d, d))),
                 .iterations = out->iterations,
                 .status = out->status,
                 .contact_changed = contact_changed(was, *out, replay.tolerance_m(record)),
                 .same_bits = same_bits(was, *out),
                 .solved = true};
    summary.add(was, *out, ticks_[i]);
    summary.taken_over += taken_over;
  }
  if (timed_) summary.ns = thread_ns() - began;
  summary.done = true;
}

ResolvedHistory HistoryResolver::finish() {
  ResolvedHistory out;
  RunCounter recorded, resolved;
  std::int64_t ns = 0;
  out.complete = true;
  for (const ChunkSummary& chunk : summaries_) {
    out.complete = out.complete && chunk.done;
    recorded.add(chunk.recorded);
    resolved.add(chunk.resolved);
    out.different_ticks += chunk.different;
    out.changed_ticks += chunk.changed;
    out.taken_over += chunk.taken_over;
    ns += chunk.ns;
    for (const ContactChange& change : chunk.changes) append(out.changes, change);
  }
  out.recorded = recorded.done();
  out.resolved = resolved.done();
  if (out.resolved.ticks > 0 && out.taken_over == 0)
    out.ns_per_tick = static_cast<double>(ns) / static_cast<double>(out.resolved.ticks);
  out.ticks = std::move(ticks_);
  return out;
}

}  // namespace tangent

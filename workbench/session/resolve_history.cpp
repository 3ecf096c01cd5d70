#include "workbench/session/resolve_history.h"

#include "core/contact/plane_contact.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ctime>

namespace tangent {

namespace {

constexpr std::uint64_t kJoinWithin = 20;  ///< ticks: changes nearer than this to each other are one entry

std::int64_t thread_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const Vec3& a, const Vec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

/// Adds up a run; iterations by how often they occur, for percentiles without sorting.
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
    if (status == TickStatus::unconverged) ++numbers.unconverged;
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

/// Joined to the last one if it is near. Past kMostChanges it is left out.
void append(std::vector<ContactChange>& changes, const ContactChange& next) {
  if (!changes.empty() && next.first_tick <= changes.back().last_tick + kJoinWithin) join(changes.back(), next);
  else if (changes.size() < ResolvedHistory::kMostChanges) changes.push_back(next);
}

bool is_robust(const Preset& preset) { return preset.solver.method == Method::robust; }

bool same_place(const TrackedPlane& a, const TrackedPlane& b, double tolerance_m) {
  const Vec3 d = a.point - b.point;
  return a.feature == Feature::face && b.feature == Feature::face && a.triangle == b.triangle && glm::dot(d, d) < 4.0 * tolerance_m * tolerance_m;
}

/// What the search for deeper places depends on besides the poses and the place of the contact.
bool same_search(const Preset& a, const Preset& b) {
  return a.finger == b.finger && a.solver.normal_form == b.solver.normal_form && a.solver.tolerance_m == b.solver.tolerance_m &&
         a.solver.switch_hysteresis_m == b.solver.switch_hysteresis_m;
}

/// The recorded tick looked for deeper places, found none, and spent no plane on it: it took one plane in all, and the
/// kept one did not do. `next`: the record after it, whose kept state holds what the search said.
bool searched_for_nothing(const ServoRecord& record, const ServoRecord& next, const Preset& preset, const Vec3& mesh_origin) {
  const TickRecord& tick = record.tick;
  const Clearance &before = tick.kept.clearance, &after = next.tick.kept.clearance;
  if (next.tick.tick != tick.tick + 1 || next.scene_id != record.scene_id || after.margin_m < 0.0) return false;
  if (same(before.centre, after.centre) && same(before.margin_m, after.margin_m) && same(before.height_m, after.height_m)) return false;
  if (tick.output.event != TickEvent::none || tick.output.status == TickStatus::unconverged || tick.output.iterations != 1) return false;
  const FingerPose local{tick.input.finger.position - mesh_origin, tick.input.finger.orientation};
  return contact_on_plane(preset.finger, local, tick.kept.plane.point, tick.kept.plane.normal).error_m > preset.solver.tolerance_m;
}

/// A step that takes over what the recorded tick's search for deeper places said, where the contact stands in the same
/// place before and after: half of the work of an ordinary tick is that search, and it does not depend on gains.
TickOutput step_sharing_search(Stepper& stepper, const Preset& preset, const ServoRecord& record, const ServoRecord& next, TickState& state) {
  const double tolerance_m = preset.solver.tolerance_m;
  if (!same_place(state.plane, record.tick.kept.plane, tolerance_m)) return stepper.step(preset, record.tick.input, state);
  const TickState before = state;
  state.clearance = next.tick.kept.clearance;
  const TickOutput out = stepper.step(preset, record.tick.input, state);
  if (same_place(state.plane, next.tick.kept.plane, tolerance_m)) return out;
  state = before;
  return stepper.step(preset, record.tick.input, state);
}

/// Where there is a contact: free, touching, or none that could be found.
int kind_of(TickStatus status) { return status == TickStatus::free ? 0 : status == TickStatus::unconverged ? 2 : 1; }

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

/// What a chunk amounts to.
struct HistoryResolver::ChunkSummary {
  RunCounter recorded, resolved;
  std::uint64_t different = 0, changed = 0;
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

const Preset* HistoryResolver::preset_of(const ServoRecord& record) const {
  if (preset_) return &*preset_;
  return record.tick.preset_id < run_.presets.size() ? &run_.presets[record.tick.preset_id] : nullptr;
}

void HistoryResolver::solve_chunk(std::size_t chunk) {
  const std::int64_t began = timed_ ? thread_ns() : 0;
  const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, run_.records.size());
  std::optional<Stepper> stepper;
  TickState state;
  const ServoRecord* before = nullptr;
  ChunkSummary& summary = summaries_[chunk];
  const Preset* compared = nullptr;   ///< recorded preset that shares_search was found for
  bool shares_search = false;
  for (std::size_t i = begin > kLeadIn ? begin - kLeadIn : 0; i < end; ++i) {
    const ServoRecord& record = run_.records[i];
    if (before == nullptr || record.scene_id != before->scene_id) {
      const auto scene = run_.scenes.find(record.scene_id);
      stepper.reset();
      if (scene != run_.scenes.end()) stepper.emplace(scene->second);
    }
    const bool follows = before != nullptr && record.scene_id == before->scene_id && record.tick.tick == before->tick.tick + 1;
    if (!follows) state = record.tick.kept;
    before = &record;
    const Preset* preset = preset_of(record);
    if (!stepper || preset == nullptr) {
      if (i >= begin) ticks_[i] = ResolvedTick{.tick = record.tick.tick};
      continue;
    }
    const TickOutput& was = record.tick.output;
    const Preset* recorded = record.tick.preset_id < run_.presets.size() ? &run_.presets[record.tick.preset_id] : preset;
    if (recorded != compared) {
      compared = recorded;
      shares_search = is_robust(*preset) && is_robust(*recorded) && same_search(*preset, *recorded);
    }
    const bool shares = shares_search && i + 1 < run_.records.size() &&
                        searched_for_nothing(record, run_.records[i + 1], *preset, stepper->scene().mesh().origin());
    const TickOutput out = shares ? step_sharing_search(*stepper, *preset, record, run_.records[i + 1], state)
                                  : stepper->step(*preset, record.tick.input, state);
    if (i < begin) continue;
    const Vec3 d = out.contact - was.contact;
    ticks_[i] = {.tick = record.tick.tick,
                 .force_n = {static_cast<float>(out.force_n.x), static_cast<float>(out.force_n.y), static_cast<float>(out.force_n.z)},
                 .cld_m = static_cast<float>(out.cld_m),
                 .error_m = static_cast<float>(out.error_m),
                 .moved_m = static_cast<float>(std::sqrt(glm::dot(d, d))),
                 .iterations = out.iterations,
                 .status = out.status,
                 .contact_changed = contact_changed(was, out, std::max(preset->solver.tolerance_m, recorded->solver.tolerance_m)),
                 .same_bits = same_bits(was, out),
                 .solved = true};
    summary.add(was, out, ticks_[i]);
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
    ns += chunk.ns;
    for (const ContactChange& change : chunk.changes) append(out.changes, change);
  }
  out.recorded = recorded.done();
  out.resolved = resolved.done();
  if (out.resolved.ticks > 0) out.ns_per_tick = static_cast<double>(ns) / static_cast<double>(out.resolved.ticks);
  out.ticks = std::move(ticks_);
  return out;
}

}  // namespace tangent

#include "workbench/session/resolve_history.h"

#include "workbench/session/replay_ticks.h"
#include "workbench/session/run_counter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tangent {

namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const Vec3& a, const Vec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

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
    append_change(changes,
                  {tick.tick, tick.tick, tick.tick, static_cast<double>(tick.moved_m), was.status, out.status, 1});
  }
};

HistoryResolver::HistoryResolver(const RecordedRun& run, std::optional<Preset> preset, bool timed, std::size_t first)
    : run_(run), preset_(std::move(preset)), timed_(timed), first_(first) {
  ticks_.resize(run.records.size());
  summaries_.resize(chunk_count());
}

HistoryResolver::~HistoryResolver() = default;

std::size_t HistoryResolver::chunk_count() const { return (run_.records.size() + kChunk - 1) / kChunk; }

void HistoryResolver::solve_chunk(std::size_t chunk) {
  const std::int64_t began = timed_ ? processor_ns() : 0;
  const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, run_.records.size());
  ChunkSummary& summary = summaries_[chunk];
  ReplayTicks replay(run_, preset_ ? &*preset_ : nullptr);
  for (std::size_t i = begin > kLeadIn ? begin - kLeadIn : 0; i < end; ++i) {
    const ServoRecord& record = run_.records[i];
    const TickOutput& was = record.tick.output;
    bool taken_over = false;
    const std::optional<TickOutput> out = replay.step(record, taken_over);
    if (i < std::max(begin, first_)) continue;
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
  if (timed_) summary.ns = processor_ns() - began;
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
    for (const ContactChange& change : chunk.changes) append_change(out.changes, change);
  }
  out.recorded = recorded.done();
  out.resolved = resolved.done();
  if (out.resolved.ticks > 0 && out.taken_over == 0)
    out.ns_per_tick = static_cast<double>(ns) / static_cast<double>(out.resolved.ticks);
  out.ticks = std::move(ticks_);
  return out;
}

}  // namespace tangent

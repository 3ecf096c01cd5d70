#include "workbench/recording/compare_recordings.h"

#include "workbench/recording/compared_ticks.h"
#include "workbench/session/two_threads.h"

#include <cmath>

namespace tangent {
namespace {

/// From so many ticks on two threads share them: a spectrum loses a window where they meet.
constexpr std::uint64_t kDividedTicks = 1 << 14;

/// Goes over two streams; `shift`: of the second's numbers.
Status compare_pairs(ComparedTicks& a, ComparedTicks& b, const Alignment& alignment, PairCounter& counter,
                     const std::function<bool()>& cancelled) {
  ComparedTick of_a, of_b;
  Result<bool> any_a = a.next(of_a), any_b = b.next(of_b);
  while (any_a && any_b && *any_a && *any_b) {
    const std::uint64_t wanted = alignment.in_b(of_a.tick);
    if (wanted == of_b.tick) counter.add(of_a, of_b);
    if (wanted != of_b.tick) counter.add_single();
    const bool a_next = wanted <= of_b.tick, b_next = of_b.tick <= wanted;
    if (a_next) any_a = a.next(of_a);
    if (b_next) any_b = b.next(of_b);
    if ((of_a.tick & 1023u) == 0 && cancelled()) return {};
  }
  for (; any_a && any_b && *any_a && !cancelled(); any_a = a.next(of_a)) counter.add_single();
  for (; any_a && any_b && *any_b && !cancelled(); any_b = b.next(of_b)) counter.add_single();
  if (!any_a) return tl::unexpected(any_a.error());
  if (!any_b) return tl::unexpected(any_b.error());
  return {};
}

struct Part {
  Alignment range;  ///< shift and ticks of the part
  PairCounter counter;
  Status status{};

  void compare(const std::filesystem::path& a, const std::filesystem::path& b,
               const CompareRecordingsOptions& options) {
    auto of_a = recorded_ticks(a, range.first, range.last);
    auto of_b = recorded_ticks(b, range.in_b(range.first), range.in_b(range.last));
    if (!of_a)
      status = tl::unexpected(of_a.error());
    else if (!of_b)
      status = tl::unexpected(of_b.error());
    else
      status = compare_pairs(**of_a, **of_b, range, counter, options.cancelled);
  }
};

}  // namespace

const char* to_string(CompareOutcome outcome) {
  constexpr std::array kNames{"same", "different", "not aligned", "undecided"};
  return kNames[static_cast<std::size_t>(outcome)];
}

const QuantityDifference* RecordingsCompared::worst() const {
  const QuantityDifference* found = nullptr;
  const auto by = [](const QuantityDifference& d) { return d.at_most / std::max(1e-12, d.tolerance); };
  for (const QuantityDifference& d : quantities)
    if (d.judged() && (!found || by(d) > by(*found))) found = &d;
  return found;
}

Result<RecordingsCompared> compare_fully(const std::filesystem::path& a, const std::filesystem::path& b,
                                         const CompareRecordingsOptions& options) {
  Result<OpenedPair> pair = open_pair(a, b, options);
  if (!pair) return tl::unexpected(pair.error());
  const Alignment& alignment = pair->alignment;
  if (!alignment.aligned()) return not_aligned(alignment);
  Part early{alignment, PairCounter(alignment, options)}, late{alignment, PairCounter(alignment, options)};
  if (alignment.ticks() >= kDividedTicks) early.range.last = alignment.first + (alignment.ticks() - 1) / 2;
  late.range.first = early.range.last + 1;
  const bool both = late.range.first <= late.range.last;
  run_on_two_threads([&] { early.compare(a, b, options); },
                     [&] {
                       if (both) late.compare(a, b, options);
                     });
  for (const Part* part : {&early, &late})
    if (!part->status) return tl::unexpected(part->status.error());
  early.counter.join(late.counter);
  RecordingsCompared out = early.counter.done();
  out.cancelled = options.cancelled();
  return out;
}

Result<RecordingsCompared> compare_under(const std::filesystem::path& path, const OtherPreset& how,
                                         const CompareRecordingsOptions& options) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Alignment alignment;
  alignment.by = AlignBy::tick;
  alignment.first = recording->info().first_tick;
  alignment.last = recording->info().last_tick;
  if (const double rate = recording->info().rate_hz(); rate > 0.0) alignment.rate_hz = rate;
  if (recording->info().ticks == 0) alignment.why_not = "the recording has no ticks";
  alignment = narrowed(alignment, options);
  if (!alignment.aligned()) return not_aligned(alignment);
  auto was = recorded_ticks(path, alignment.first, alignment.last);
  if (!was) return tl::unexpected(was.error());
  auto is = solved_ticks(path, how, {alignment.first, alignment.last}, options.cancelled);
  if (!is) return tl::unexpected(is.error());
  PairCounter counter(alignment, options);
  if (Status ok = compare_pairs(**was, **is, alignment, counter, options.cancelled); !ok)
    return tl::unexpected(ok.error());
  RecordingsCompared out = counter.done();
  out.cancelled = options.cancelled();
  return out;
}

}  // namespace tangent

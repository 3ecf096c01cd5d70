#include "workbench/recording/alignment.h"

#include "workbench/recording/tick_values.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kSameRate = 0.01;  // rates that differ by less are one; a servo on a clock keeps its rate to 0.01 %

std::string hz_text(double hz) { return std::to_string(std::llround(hz)) + " Hz"; }

/// By the pyramid where it has the ticks, and tick by tick in the rows that may hold it, and after them.
Result<std::optional<std::uint64_t>> first_touch(const Recording& recording) {
  Result<Database> database = Database::open(recording.path());
  if (!database) return tl::unexpected(database.error());
  const auto look = [&](std::uint64_t first, std::uint64_t last) {
    return database->text_of("SELECT tick FROM tick_rows WHERE " + between_sql("tick", first, last) +
                             " AND status IN (" + std::to_string(static_cast<int>(TickStatus::face)) + "," +
                             std::to_string(static_cast<int>(TickStatus::edge)) + "," +
                             std::to_string(static_cast<int>(TickStatus::vertex)) + ") ORDER BY tick LIMIT 1");
  };
  Result<Statement> rows =
      database->prepare("SELECT first_tick, max_penetration_m > 0 FROM overview WHERE level=0 ORDER BY first_tick");
  if (!rows) return tl::unexpected(rows.error());
  std::uint64_t seen = recording.info().first_tick;
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    const auto first = static_cast<std::uint64_t>(rows->whole(0));
    seen = std::max(seen, first + kOverviewTicks);
    if (rows->whole(1) == 0) continue;
    const Result<std::string> tick = look(first, first + kOverviewTicks - 1);
    if (!tick) return tl::unexpected(tick.error());
    if (!tick->empty()) return std::stoull(*tick);
  }
  const Result<std::string> tick = look(seen, recording.info().last_tick);
  if (!tick) return tl::unexpected(tick.error());
  return tick->empty() ? std::nullopt : std::optional<std::uint64_t>(std::stoull(*tick));
}

Result<std::optional<std::uint64_t>> bookmark(const Recording& recording, const std::string& note) {
  Result<Database> database = Database::open(recording.path());
  if (!database) return tl::unexpected(database.error());
  const std::string with = note.empty() ? "" : " AND text=" + sql_text(note);
  const Result<std::string> tick =
      database->text_of("SELECT tick FROM events WHERE kind='bookmark' AND typeof(tick)='integer' AND tick>=0" + with +
                        " ORDER BY tick LIMIT 1");
  if (!tick) return tl::unexpected(tick.error());
  return tick->empty() ? std::nullopt : std::optional<std::uint64_t>(std::stoull(*tick));
}

/// Two ticks that go together.
struct Pair {
  std::uint64_t a = 0, b = 0;
};

Result<Pair> by_time(Recording& a, Recording& b) {
  const double t_s = std::max(a.info().first_s, b.info().first_s);
  // A little earlier, so that times that differ by rounding are one.
  const double slack = 0.25 / std::max(1.0, a.info().rate_hz());
  const Result<std::uint64_t> in_a = a.tick_at(t_s - slack), in_b = b.tick_at(t_s - slack);
  if (!in_a) return tl::unexpected(in_a.error());
  if (!in_b) return tl::unexpected(in_b.error());
  return Pair{*in_a, *in_b};
}

using Found = Result<std::optional<std::uint64_t>>;

/// The pair of two places, or why there is none.
Result<Pair> pair_of(const Found& a, const Found& b, const std::string& what, Alignment& out) {
  if (!a) return tl::unexpected(a.error());
  if (!b) return tl::unexpected(b.error());
  if (*a && *b) return Pair{**a, **b};
  out.why_not = std::string(!*a && !*b ? "neither" : !*a ? "the first" : "the second") + " has " + what;
  return Pair{};
}

Result<Pair> find_pair(Recording& a, Recording& b, const std::string& note, Alignment& out) {
  switch (out.by) {
    case AlignBy::time:
      return by_time(a, b);
    case AlignBy::contact:
      return pair_of(first_touch(a), first_touch(b), "a tick that touches", out);
    case AlignBy::bookmark:
      return pair_of(bookmark(a, note), bookmark(b, note), note.empty() ? "a bookmark" : "a bookmark \"" + note + "\"",
                     out);
    default:
      return Pair{};
  }
}

}  // namespace

Result<Alignment> align(Recording& a, Recording& b, AlignBy by, const std::string& note) {
  Alignment out;
  out.by = by;
  if (a.info().ticks == 0 || b.info().ticks == 0) {
    out.why_not = std::string(a.info().ticks == 0 ? "the first" : "the second") + " has no ticks";
    return out;
  }
  const double rate_a = a.info().rate_hz(), rate_b = b.info().rate_hz();
  if (rate_a > 0.0) out.rate_hz = rate_a;
  if (rate_a > 0.0 && rate_b > 0.0 && std::abs(rate_a - rate_b) > kSameRate * rate_a) {
    out.why_not = "one runs at " + hz_text(rate_a) + ", the other at " + hz_text(rate_b);
    return out;
  }
  const Result<Pair> pair = find_pair(a, b, note, out);
  if (!pair) return tl::unexpected(pair.error());
  if (!out.aligned()) return out;
  out.shift = static_cast<std::int64_t>(pair->b) - static_cast<std::int64_t>(pair->a);
  const auto in_a = [&](std::uint64_t tick_of_b) { return static_cast<std::int64_t>(tick_of_b) - out.shift; };
  const std::int64_t first = std::max(static_cast<std::int64_t>(a.info().first_tick), in_a(b.info().first_tick));
  const std::int64_t last = std::min(static_cast<std::int64_t>(a.info().last_tick), in_a(b.info().last_tick));
  if (last < first) {
    out.why_not =
        "aligned by " + std::string(kAlignByNames[static_cast<std::size_t>(by)]) + " they have no tick in common";
    return out;
  }
  out.first = static_cast<std::uint64_t>(first);
  out.last = static_cast<std::uint64_t>(last);
  return out;
}

}  // namespace tangent

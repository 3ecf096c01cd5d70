#include "workbench/sweep/sweep_run.h"

#include <chrono>

namespace tangent::sweep {
namespace {

using Clock = std::chrono::steady_clock;
/// What a crash can cost, beside the cells that are being solved.
constexpr auto kKeepEvery = std::chrono::milliseconds(500);

/// Counts what comes in, and says when it is time to put it on the disk.
class Tally {
 public:
  Tally(std::uint64_t cells, std::uint64_t before, const SweepOptions& options) : options_(options) {
    outcome_.cells = cells;
    outcome_.before = before;
  }

  /// True: keep it now.
  bool add(const CellResult& result) {
    ++outcome_.solved;
    if (!result.failed.empty()) ++outcome_.failed;
    outcome_.ticks += result.numbers.ticks;
    options_.progress({outcome_.before + outcome_.solved, outcome_.cells});
    const auto now = Clock::now();
    if (now - kept_ < kKeepEvery) return false;
    kept_ = now;
    return true;
  }

  /// `failures`: of the whole file.
  SweepOutcome done(Failures failures) {
    outcome_.failures = std::move(failures);
    outcome_.seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    outcome_.stopped = outcome_.before + outcome_.solved < outcome_.cells;
    return outcome_;
  }

 private:
  const SweepOptions& options_;
  SweepOutcome outcome_;
  Clock::time_point began_ = Clock::now(), kept_ = began_;
};

std::uint64_t count(const std::vector<bool>& done) {
  return static_cast<std::uint64_t>(std::count(done.begin(), done.end(), true));
}

/// A line of a shard into the results. True: it is time to put them on the disk.
Result<bool> merge_line(const ShardLine& line, ResultsFile& file, Tally& tally) {
  if (const auto* const time = std::get_if<CellTime>(&line)) {
    if (file.has_time(time->cell)) return false;
    if (Status ok = file.add(*time); !ok) return tl::unexpected(ok.error());
    return false;
  }
  const CellResult& result = std::get<CellResult>(line);
  const bool is_new = !file.done()[result.cell];
  if (Status ok = file.add(result); !ok) return tl::unexpected(ok.error());
  return is_new && tally.add(result);
}

}  // namespace

Status check_shard(const PlanFolder& folder, std::uint64_t shard) {
  if (shard < folder.shards) return {};
  return fail(std::to_string(shard) + " is no shard of " + std::to_string(folder.shards), "--shard",
              folder.shards == 1 ? "allowed: 0" : "allowed: 0 to " + std::to_string(folder.shards - 1));
}

Result<SweepOutcome> run_sweep(const Cells& cells, ResultsFile& file, const SweepOptions& options) {
  const std::vector<bool> before = file.done();
  Tally tally(cells.size(), count(before), options);
  Inputs inputs(cells.plan(), {options.note, options.stop});
  const auto keep = [&](const CellResult& result) -> Status {
    if (Status ok = file.add(result); !ok) return ok;
    return tally.add(result) ? file.commit() : Status{};
  };
  if (Status ok = run_cells(cells, inputs, 0, cells.size(), before, keep, {options.threads, options.stop}); !ok)
    return tl::unexpected(ok.error());
  if (Status ok = file.commit(); !ok) return tl::unexpected(ok.error());
  return file.failures().map([&](Failures failures) { return tally.done(std::move(failures)); });
}

Result<std::uint64_t> time_sweep(const Cells& cells, ResultsFile& file, std::size_t rounds, std::size_t ticks,
                                 const SweepOptions& options) {
  Inputs inputs(cells.plan());
  std::uint64_t timed = 0;
  for (std::uint64_t i = 0; i < cells.size() && !options.stop(); ++i) {
    if (file.has_time(i)) continue;
    const auto time = time_cell(cells, inputs, i, {rounds, ticks, options.stop});
    if (!time) continue;  // its row says why
    if (!*time) break;
    if (Status ok = file.add(**time); !ok) return tl::unexpected(ok.error());
    if (Status ok = file.commit(); !ok) return tl::unexpected(ok.error());
    ++timed;
    options.progress({i + 1, cells.size()});
  }
  return timed;
}

Result<std::uint64_t> time_shard(const PlanFolder& folder, std::uint64_t shard, std::size_t rounds,
                                 const SweepOptions& options) {
  if (Status ok = check_shard(folder, shard); !ok) return tl::unexpected(ok.error());
  const Result<Cells> cells = Cells::of(folder.plan);
  if (!cells) return tl::unexpected(cells.error());
  const ShardName name = folder.shard(shard);
  Result<ShardWriter> file = ShardWriter::open(folder.shard_file(shard), name);
  if (!file) return tl::unexpected(file.error());
  Inputs inputs(folder.plan);
  TimeCells how;
  how.rounds = rounds;
  how.stop = options.stop;
  std::uint64_t timed = 0;
  for (std::uint64_t i = 0; i < name.end - name.first && !options.stop(); ++i) {
    if (!file->done()[i] || file->timed()[i]) continue;
    const auto time = time_cell(*cells, inputs, name.first + i, how);
    if (!time) continue;  // its line says why
    if (!*time) break;
    if (Status ok = file->add(**time); !ok) return tl::unexpected(ok.error());
    ++timed;
    options.progress({i + 1, name.end - name.first});
  }
  if (Status ok = file->flush(); !ok) return tl::unexpected(ok.error());
  return timed;
}

Result<SweepOutcome> run_shard(const PlanFolder& folder, std::uint64_t shard, const SweepOptions& options) {
  if (Status ok = check_shard(folder, shard); !ok) return tl::unexpected(ok.error());
  const Result<Cells> cells = Cells::of(folder.plan);
  if (!cells) return tl::unexpected(cells.error());
  const ShardName name = folder.shard(shard);
  Result<ShardWriter> file = ShardWriter::open(folder.shard_file(shard), name);
  if (!file) return tl::unexpected(file.error());
  Tally tally(name.end - name.first, count(file->done()), options);
  Inputs inputs(folder.plan, {options.note, options.stop});
  const auto keep = [&](const CellResult& result) -> Status {
    if (Status ok = file->add(result); !ok) return ok;
    return tally.add(result) ? file->flush() : Status{};
  };
  if (Status ok = run_cells(*cells, inputs, name.first, name.end, file->done(), keep, {options.threads, options.stop});
      !ok)
    return tl::unexpected(ok.error());
  if (Status ok = file->flush(); !ok) return tl::unexpected(ok.error());
  return tally.done(file->failures());
}

namespace {

/// One shard into the results. False: stopped.
class ShardMerge {
 public:
  ShardMerge(const PlanFolder& folder, ResultsFile& file, Tally& tally, const SweepOptions& options)
      : folder_(folder), file_(file), tally_(tally), options_(options) {}

  Status merge(std::uint64_t shard) {
    const std::filesystem::path path = folder_.shard_file(shard);
    const ShardName name = folder_.shard(shard);
    Result<ShardReader> reader = ShardReader::open(path, name);
    if (!reader) return tl::unexpected(reader.error());
    std::vector<bool> wants_time(name.end - name.first, false);
    ShardLine line;
    for (;;) {
      const Result<bool> more = reader->next(line);
      if (!more) return tl::unexpected(more.error());
      if (!*more) break;
      if (const auto* const time = std::get_if<CellTime>(&line)) {
        any_time_ = true;
        wants_time[time->cell - name.first] = false;
      } else if (const auto& result = std::get<CellResult>(line); result.failed.empty()) {
        wants_time[result.cell - name.first] = true;
      }
      const Result<bool> keep = merge_line(line, file_, tally_);
      if (!keep) return tl::unexpected(keep.error());
      if (*keep)
        if (Status ok = file_.commit(); !ok) return tl::unexpected(ok.error());
    }
    for (std::uint64_t cell = name.first; cell < name.end; ++cell) {
      if (!file_.done()[cell])
        return fail("is not finished: it lacks cell " + std::to_string(cell), path.string(),
                    "run that shard again: it goes on from what is there");
    }
    count_lacking(shard, name.first, wants_time);
    return {};
  }

  /// Every shard, unless it is stopped.
  Status merge_all() {
    for (std::uint64_t shard = 0; shard < folder_.shards && !options_.stop(); ++shard)
      if (Status ok = merge(shard); !ok) return ok;
    return {};
  }

  /// None where nobody asked for times and no cell has one.
  LackingTimes lacking() const { return folder_.times > 0 || any_time_ ? lacking_ : LackingTimes{}; }

 private:
  void count_lacking(std::uint64_t shard, std::uint64_t first, const std::vector<bool>& wants_time) {
    std::uint64_t lacks = 0;
    for (std::uint64_t i = 0; i < wants_time.size(); ++i) lacks += wants_time[i] && !file_.has_time(first + i) ? 1 : 0;
    if (lacks == 0) return;
    if (lacking_.shards++ == 0) {
      lacking_.first_shard = shard;
      lacking_.first_cells = lacks;
    }
    lacking_.cells += lacks;
  }

  const PlanFolder& folder_;
  ResultsFile& file_;
  Tally& tally_;
  const SweepOptions& options_;
  LackingTimes lacking_;
  bool any_time_ = false;
};

/// SQLite's own companions, too.
void remove_results(const std::filesystem::path& out) {
  std::error_code ignored;
  for (const char* const ending : {"", "-wal", "-shm", "-journal"})
    std::filesystem::remove(std::filesystem::path(out) += ending, ignored);
}

Result<MergeOutcome> merge_into(const PlanFolder& folder, const Cells& cells, const std::filesystem::path& out,
                                const SweepOptions& options) {
  Result<ResultsFile> file = ResultsFile::open(out, cells, folder.digest);
  if (!file) return tl::unexpected(file.error());
  Tally tally(cells.size(), count(file->done()), options);
  ShardMerge merge(folder, *file, tally, options);
  if (Status ok = merge.merge_all(); !ok) return tl::unexpected(ok.error());
  const Result<Failures> failures = file->failures();
  if (!failures) return tl::unexpected(failures.error());
  if (Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  MergeOutcome merged{tally.done(*failures), merge.lacking()};
  merged.ticks = 0;  // nothing was solved here
  return merged;
}

}  // namespace

Result<MergeOutcome> merge_shards(const PlanFolder& folder, const std::filesystem::path& out,
                                  const SweepOptions& options) {
  const Result<Cells> cells = Cells::of(folder.plan);
  if (!cells) return tl::unexpected(cells.error());
  // All of them are looked at before anything is written.
  for (std::uint64_t shard = 0; shard < folder.shards; ++shard) {
    const Result<ShardReader> reader = ShardReader::open(folder.shard_file(shard), folder.shard(shard));
    if (!reader) return tl::unexpected(reader.error());
  }
  std::error_code error;
  const bool there = std::filesystem::exists(out, error);
  Result<MergeOutcome> outcome = merge_into(folder, *cells, out, options);
  if (!outcome && !there) remove_results(out);
  return outcome;
}

}  // namespace tangent::sweep

// workbench sweep: many presets on many meshes and motions; in one process, or divided for a cluster.
#include "workbench/cli/command.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/refuse.h"
#include "workbench/cli/sweep_options.h"
#include "workbench/cli/text_format.h"
#include "workbench/sweep/ignored_keys.h"
#include "workbench/sweep/plan_digest.h"
#include "workbench/sweep/sweep_estimate.h"
#include "workbench/sweep/sweep_run.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <thread>

namespace tangent {
namespace {

/// From this many cells on, they are solved with --yes only.
constexpr std::uint64_t kManyCells = 1'000'000;
constexpr std::size_t kTimedTicks = 2000;
constexpr std::array<std::string_view, 1> kAgainNames{"failed"};

struct SweepCommandOptions {
  SweepPlanOptions plan;
  std::filesystem::path out;
  double threads = 0.0;  ///< 0: as many as there are cores
  double times = 0.0;    ///< rounds of timing
  bool dry_run = false, yes = false;
  bool again = false;            ///< cells that failed before
  std::filesystem::path folder;  ///< of plan, run and merge
  double shards = 1.0, shard = 0.0;
  double job_minutes = 30.0;  ///< that a job of a cluster takes, about
};

sweep::SweepOptions run_options(const SweepCommandOptions& options, Progress& progress) {
  sweep::SweepOptions out;
  out.threads = options.threads > 0.0 ? static_cast<unsigned>(options.threads)
                                      : std::max(1u, std::thread::hardware_concurrency());
  out.stop = [] { return InterruptGuard::requested(); };
  out.note = [](const std::string& note) { print_message("sweep", note); };
  out.progress = [&progress](const sweep::SweepProgress& p) { progress.update(p.done, p.planned); };
  return out;
}

std::string outcome_text(const sweep::SweepOutcome& o, const std::string& where) {
  const auto whole = [](std::uint64_t n) { return std::to_string(n); };
  std::string text = whole(o.before + o.solved) + " of " + count_text(o.cells, "cell", "cells") + " in " + where;
  if (o.before > 0) text += " (" + whole(o.before) + " were there)";
  if (o.solved > o.failed && o.ticks > 0)
    text += format("; %s solved in %.1f s, %.3g ticks/s", whole(o.solved - o.failed).c_str(), o.seconds,
                   static_cast<double>(o.ticks) / std::max(1e-9, o.seconds));
  if (o.failed > 0) text += (o.solved > o.failed ? ", " : "; ") + whole(o.failed) + " failed";
  return text + "\n";
}

/// What to do when the meshes and motions of failed cells are mended.
constexpr const char* kAgain = "the same command with --again failed solves them";
constexpr const char* kAgainMerged = "merge all shards, and sweep --plan, --out and --again failed solve them";

/// Every mesh and motion that could not be had, and what to do when they are mended.
void print_failures(const sweep::SweepOutcome& outcome, const std::string& where, const std::string& mended) {
  const sweep::Failures& failures = outcome.failures;
  if (failures.cells == 0 || failures.reasons.empty()) return;
  const std::string all = where + ": " + count_text(failures.cells, "cell has", "cells have") + " no numbers";
  const std::string others = failures.cells < outcome.cells ? ", the others have" : "";
  if (failures.reasons.size() == 1) {
    const sweep::Failures::Reason& only = failures.reasons.front();
    print_message("sweep", all + (others.empty() ? "," : others + ";") + " the first, cell " +
                               std::to_string(only.first) + ": " + only.why + "; then " + mended);
    return;
  }
  for (const sweep::Failures::Reason& reason : failures.reasons)
    print_message("sweep", where + ": " + count_text(reason.cells, "cell has", "cells have") +
                               " no numbers, the first, cell " + std::to_string(reason.first) + ": " + reason.why);
  print_message("sweep", all + others + "; mend what they lack, then " + mended);
}

/// What is said at the end, and the exit code.
int finish(const sweep::SweepOutcome& outcome, const std::string& where, const std::string& mended = kAgain) {
  std::fputs(outcome_text(outcome, where).c_str(), stdout);
  if (outcome.stopped) print_message("sweep", "interrupted; the same command goes on from there");
  print_failures(outcome, where, mended);
  return outcome.stopped || outcome.failures.cells > 0 ? kFailed : kDone;
}

/// Keys that are swept for nothing: the sweep goes on all the same.
void warn_of_ignored(const sweep::Cells& cells) {
  for (const std::string& text : sweep::ignored_key_texts(cells)) print_message("sweep", text);
}

/// Wrong usage where the options say it, a failure where a plan's file does.
Result<sweep::Cells> cells_of(const Result<sweep::Plan>& plan) {
  if (!plan) return tl::unexpected(plan.error());
  Result<sweep::Cells> cells = sweep::Cells::of(*plan);
  if (cells) warn_of_ignored(*cells);
  return cells;
}

Status refuse_many(const sweep::Cells& cells, const SweepCommandOptions& options) {
  if (cells.size() < kManyCells || options.yes || options.dry_run) return {};
  return fail(std::to_string(cells.size()) + " cells", "sweep", "look at them with --dry-run, or say --yes");
}

Result<int> print_estimate(const sweep::Cells& cells, unsigned threads) {
  const Result<sweep::SweepEstimate> e = sweep::estimate(cells);
  if (!e) return tl::unexpected(e.error());
  std::fputs(format("%s: %s x %s x %s x %s\n"
                    "%.3g ticks in all, about %.0f s on %s (%.0f ns a tick, by %zu ticks of the first cell)\n"
                    "about %.0f MB of memory for the first mesh and motion, %.0f MB of results\n",
                    count_text(cells.size(), "cell", "cells").c_str(),
                    count_text(cells.plan().meshes.size(), "mesh", "meshes").c_str(),
                    count_text(cells.plan().poses.size(), "motion", "motions").c_str(),
                    count_text(cells.plan().fingers.size(), "finger", "fingers").c_str(),
                    count_text(cells.per_group(), "preset", "presets").c_str(), e->ticks, e->seconds / threads,
                    count_text(threads, "thread", "threads").c_str(), e->ns_a_tick, e->tried_ticks,
                    e->memory_bytes / 1e6, e->result_bytes / 1e6)
                 .c_str(),
             stdout);
  return kDone;
}

Result<int> time_cells(const sweep::Cells& cells, sweep::ResultsFile& file, const SweepCommandOptions& options) {
  Progress progress("cells timed", cells.size());
  const auto timed = sweep::time_sweep(cells, file, static_cast<std::size_t>(options.times), kTimedTicks,
                                       run_options(options, progress));
  if (!timed) return tl::unexpected(timed.error());
  std::fputs(
      (count_text(*timed, "cell", "cells") + " timed, each against the first of its mesh, motion and finger\n").c_str(),
      stdout);
  return InterruptGuard::requested() ? kFailed : kDone;
}

Result<int> sweep_here(const SweepCommandOptions& options) {
  const InterruptGuard guard;
  const Result<sweep::Plan> plan = sweep_plan(options.plan);
  const Result<sweep::Cells> cells = cells_of(plan);
  if (!cells) return tl::unexpected(cells.error());
  if (Status ok = refuse_many(*cells, options); !ok) return tl::unexpected(ok.error());
  Progress progress("cells", cells->size());
  const sweep::SweepOptions run = run_options(options, progress);
  if (options.dry_run) return print_estimate(*cells, run.threads);
  Result<sweep::ResultsFile> file =
      sweep::ResultsFile::open(options.out, *cells, sweep::plan_digest(*plan),
                               options.again ? sweep::FailedCells::again : sweep::FailedCells::keep);
  if (!file) return tl::unexpected(file.error());
  const Result<sweep::SweepOutcome> outcome = sweep::run_sweep(*cells, *file, run);
  if (!outcome) return tl::unexpected(outcome.error());
  int code = finish(*outcome, options.out.string());
  if (options.times >= 2.0 && !outcome->stopped) {
    const Result<int> timed = time_cells(*cells, *file, options);
    if (!timed) return timed;
    code = std::max(code, *timed);
  }
  if (Status ok = file->finish(); !ok) return tl::unexpected(ok.error());
  return code;
}

Result<int> divide(const SweepCommandOptions& options) {
  const Result<sweep::Plan> plan = sweep::read_plan(options.plan.plan);
  const Result<sweep::Cells> cells = cells_of(plan);
  if (!cells) return tl::unexpected(cells.error());
  const auto shards = static_cast<std::uint64_t>(options.shards);
  refuse_failed("--shards", sweep::check_shards(shards, *cells));
  const std::string dir = options.folder.string();
  if (std::error_code error; std::filesystem::exists(options.folder / "plan.json", error)) {
    const Result<std::size_t> put_back = sweep::put_back_inputs(options.folder, *plan, shards);
    if (!put_back) return tl::unexpected(put_back.error());
    std::fputs((dir + ": divided before; " + count_text(*put_back, "mesh or motion", "meshes and motions") +
                " put back, shards stay\n")
                   .c_str(),
               stdout);
    return kDone;
  }
  const Result<sweep::SweepEstimate> estimate = sweep::estimate(*cells);
  if (!estimate) return tl::unexpected(estimate.error());
  sweep::JobScripts scripts = sweep::bundled(estimate->seconds, shards, 60.0 * options.job_minutes);
  scripts.times = static_cast<std::size_t>(options.times);
  if (Status ok = sweep::write_plan_folder(options.folder, *plan, shards, scripts); !ok)
    return tl::unexpected(ok.error());
  std::fputs(format("%s: %s in %s, about %.0f s each; %s a job in %s/slurm.sh\n", dir.c_str(),
                    count_text(cells->size(), "cell", "cells").c_str(), count_text(shards, "shard", "shards").c_str(),
                    estimate->seconds / static_cast<double>(shards),
                    count_text(scripts.shards_a_job, "shard", "shards").c_str(), dir.c_str())
                 .c_str(),
             stdout);
  return kDone;
}

Result<int> run_one_shard(const SweepCommandOptions& options) {
  const InterruptGuard guard;
  const Result<sweep::PlanFolder> folder = sweep::open_plan_folder(options.folder);
  if (!folder) return tl::unexpected(folder.error());
  const auto shard = static_cast<std::uint64_t>(options.shard);
  refuse_failed("--shard", sweep::check_shard(*folder, shard));
  Progress progress("cells", 0);
  const Result<sweep::SweepOutcome> outcome = sweep::run_shard(*folder, shard, run_options(options, progress));
  if (!outcome) return tl::unexpected(outcome.error());
  const int code = finish(*outcome, folder->shard_file(shard).string(), kAgainMerged);
  if (options.times < 2.0 || outcome->stopped) return code;
  const auto timed =
      sweep::time_shard(*folder, shard, static_cast<std::size_t>(options.times), run_options(options, progress));
  if (!timed) return tl::unexpected(timed.error());
  std::fputs((count_text(*timed, "cell", "cells") + " timed on " + sweep::machine_name() + "\n").c_str(), stdout);
  return InterruptGuard::requested() ? static_cast<int>(kFailed) : code;
}

Result<int> merge(const SweepCommandOptions& options) {
  const InterruptGuard guard;
  const Result<sweep::PlanFolder> folder = sweep::open_plan_folder(options.folder);
  if (!folder) return tl::unexpected(folder.error());
  Progress progress("cells", folder->cells);
  const auto outcome = sweep::merge_shards(*folder, options.out, run_options(options, progress));
  if (!outcome) return tl::unexpected(outcome.error());
  const int code = finish(*outcome, options.out.string(), kAgainMerged);
  const sweep::LackingTimes& lacking = outcome->lacking;
  if (lacking.cells == 0) return code;
  const std::string more = lacking.shards > 1 ? ", and " + count_text(lacking.shards - 1, "shard more", "shards more") +
                                                    ", " + std::to_string(lacking.cells) + " in all"
                                              : "";
  print_message("sweep", folder->shard_file(lacking.first_shard).string() + ": lacks the times of " +
                             count_text(lacking.first_cells, "cell", "cells") + more + "; run \"sweep run " +
                             folder->folder.string() + " --shard " + std::to_string(lacking.first_shard) + " --times " +
                             std::to_string(folder->times > 0 ? folder->times : 6) + "\" again, then merge again");
  return kFailed;
}

using Work = Result<int> (*)(const SweepCommandOptions&);

void run_as(CLI::App& command, const std::shared_ptr<SweepCommandOptions>& options, CommandResult& result, Work work) {
  on_run(command, [options, &result, work] {
    const Result<int> code = work(*options);
    if (!code) print_message("sweep", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

void add_threads_option(CLI::App& app, SweepCommandOptions& options) {
  add_number_option(app, "--threads", {.min = 1, .max = 1024, .whole = true},
                    "Threads (default: one a core). The numbers are the same with any",
                    [&](double value) { options.threads = value; });
}

void add_times_option(CLI::App& app, SweepCommandOptions& options) {
  add_number_option(app, "--times", {.min = 2, .max = 1000, .whole = true},
                    "Afterwards time every cell against the first of its group, in so many rounds of A, B, B, A",
                    [&](double value) { options.times = value; });
}

void add_divided_commands(CLI::App& sweep, const std::shared_ptr<SweepCommandOptions>& options, CommandResult& result) {
  CLI::App* plan = add_command(sweep, "plan", "Divide a plan into shards, for many machines that share a folder");
  add_text_option(*plan, "PLAN", options->plan.plan, "A plan file", "PLAN.toml", Needed::yes);
  add_text_option(*plan, "--out", options->folder, "Folder to make", "DIR", Needed::yes);
  add_number_option(*plan, "--shards", {.min = 1, .max = 1e6, .whole = true}, "Parts to divide it into",
                    [o = options.get()](double value) { o->shards = value; });
  add_number_option(*plan, "--job-minutes", {.min = 0.01, .max = 10000, .unit = "min"},
                    "What a job of slurm.sh takes, about (default 30): so many shards are put into one",
                    [o = options.get()](double value) { o->job_minutes = value; });
  add_times_option(*plan, *options);
  run_as(*plan, options, result, divide);

  CLI::App* run = add_command(sweep, "run", "Solve one shard; again: goes on from what is there");
  add_text_option(*run, "DIR", options->folder, "Folder of a divided plan", "DIR", Needed::yes);
  add_number_option(*run, "--shard", {.min = 0, .max = 1e6, .whole = true}, "Which, from 0 (default 0)",
                    [o = options.get()](double value) { o->shard = value; });
  add_threads_option(*run, *options);
  add_times_option(*run, *options);
  run_as(*run, options, result, run_one_shard);

  CLI::App* join = add_command(sweep, "merge", "Put all shards together into one results file");
  add_text_option(*join, "DIR", options->folder, "Folder of a divided plan", "DIR", Needed::yes);
  add_text_option(*join, "--out", options->out, "Results to write", "F.sqlite", Needed::yes);
  run_as(*join, options, result, merge);
}

}  // namespace

void add_sweep_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(
      app, "sweep", "Try many presets on many meshes and motions",
      "Ctrl-C keeps the cells that are done; the same command goes on. The page is workbench/sweep/README.md.");
  command->require_subcommand(0, 1);
  auto options = std::make_shared<SweepCommandOptions>();
  add_divided_commands(*command, options, result);
  add_sweep_plan_options(*command, options->plan);
  add_text_option(*command, "--out", options->out, "Results to write, or to go on with", "F.sqlite");
  add_threads_option(*command, *options);
  add_times_option(*command, *options);
  add_choice_option(
      *command, "--again", kAgainNames,
      "Solve these again, too, of results that are there: failed, cells whose mesh or motion could not be "
      "read, and which may have been mended since",
      [options = options.get()](int) { options->again = true; });
  add_flag(*command, "--dry-run", options->dry_run, "Say how many cells it is, how long and how large, and end");
  add_flag(*command, "--yes", options->yes, "Solve a million cells and more");
  on_run(*command, [command, options, &result] {
    if (!command->get_subcommands().empty()) return;  // plan, run or merge has done it
    if (options->plan.plan.empty() && options->plan.meshes.empty())
      refuse_option("MESH", "is missing: name meshes, or a plan with --plan");
    if (options->out.empty() && !options->dry_run) refuse_option("--out", "is missing: name a file for the results");
    for (const std::string& mesh : options->plan.meshes) refuse_same_file("--out", options->out, "MESH", mesh);
    for (const std::string& poses : options->plan.poses) refuse_same_file("--out", options->out, "--poses", poses);
    const Result<int> code = sweep_here(*options);
    if (!code) print_message("sweep", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

}  // namespace tangent

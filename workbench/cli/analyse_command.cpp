// workbench analyse: what the answers of an experiment say.
#include "workbench/analysis/write_analysis.h"
#include "workbench/analysis/write_planning.h"
#include "workbench/cli/command.h"
#include "workbench/cli/command_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/stopwatch.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

namespace tangent {
namespace {

void print_check(const analysis::CheckRow& row) {
  std::printf("%-72s %8.3f (%.3f to %.3f)%s%s", row.what.c_str(), row.found, row.low, row.high,
              row.unit.empty() ? "" : " ", row.unit.c_str());
  if (std::isfinite(row.expected)) std::printf(", should be %.3f", row.expected);
  std::printf("; of %llu, %.2f s\n", static_cast<unsigned long long>(row.count), row.seconds);
}

struct AnalyseCommandOptions {
  std::vector<std::filesystem::path> data;
  std::filesystem::path participants;
  analysis::LoadOptions load;
  analysis::AnalysisOptions analysis;
  bool power = false, check = false;
  int count = 0;  ///< 0: by default
};

/// Before there are answers: what a protocol's can say.
Status run_planning(const AnalyseCommandOptions& options) {
  const InterruptGuard guard;
  const Result<experiment::Protocol> protocol = experiment::read_protocol(options.data.front());
  if (!protocol) return tl::unexpected(protocol.error());
  const analysis::PlanningFiles files{options.analysis.folder, options.analysis.command, protocol->name};
  const Stopwatch watch;
  Result<std::filesystem::path> page;
  if (options.power) {
    const auto table =
        analysis::power_table(*protocol, options.count > 0 ? options.count : 2000, InterruptGuard::requested);
    if (!table)
      return fail(table.error().what, options.data.front().string() + " " + table.error().where, table.error().remedy);
    for (const analysis::PowerRow& row : table->rows)
      std::printf("%-20s difference %5.2f, %2d participants: found in %5.1f %%, theory %5.1f %%\n", row.test.c_str(),
                  row.difference, row.participants, 100.0 * row.found, 100.0 * row.theory);
    if (!InterruptGuard::requested()) page = analysis::write_power(*table, files);
  } else {
    const auto rows =
        analysis::check_analysis(*protocol, options.count > 0 ? options.count : 10000, InterruptGuard::requested);
    for (const analysis::CheckRow& row : rows) print_check(row);
    if (!InterruptGuard::requested()) page = analysis::write_check(rows, files);
  }
  if (InterruptGuard::requested()) return fail("stopped, nothing is written", options.analysis.folder.string());
  if (!page) return tl::unexpected(page.error());
  std::printf("%s: simulated, %.1f s\n", page->c_str(), watch.seconds());
  return {};
}

Status run_analyse(AnalyseCommandOptions& options) {
  const InterruptGuard guard;
  options.analysis.stop = InterruptGuard::requested;
  const Result<analysis::Answers> answers = analysis::load_answers(options.data, options.load);
  if (!answers) return tl::unexpected(answers.error());
  if (!options.participants.empty()) {
    auto experience = analysis::read_experience(options.participants, answers->found);
    if (!experience) return tl::unexpected(experience.error());
    options.analysis.experienced = std::move(*experience);
  }
  for (const std::string& note : answers->left_out) print_message("analyse", note);
  options.analysis.warn = [](const std::string& warning) { print_message("analyse", warning); };
  const auto page = analysis::write_analysis(*answers, options.analysis);
  if (!page) return tl::unexpected(page.error());
  std::printf("%s: %s compared arcs, %zu named objects%s\n", page->c_str(),
              analysis::counted(answers->comparisons.size(), "participant").c_str(), answers->namings.size(),
              answers->simulated ? "; simulated" : "");
  return {};
}

}  // namespace

void add_analyse_command(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      add_command(app, "analyse", "Thresholds, confusions, tests and figures of an experiment's answers");
  auto options = std::make_shared<AnalyseCommandOptions>();
  AnalyseCommandOptions* o = options.get();
  add_paths_option(*command, "DATA", o->data,
                   "Folders of `workbench experiment --out`, or single files; with --power or --check a protocol",
                   "DATA...");
  add_text_option(*command, "--out", o->analysis.folder, "Folder for analysis.html, figures and tables", "DIR",
                  Needed::yes);
  add_text_option(*command, "--participants", o->participants,
                  "participants.tsv with participant_id and experience (yes, no)", "F.tsv");
  add_number_option(*command, "--repeats", {.min = 20, .max = 100000, .whole = true},
                    "Staircases simulated to calibrate the intervals of thresholds (default 4000)",
                    [o](double n) { o->analysis.repeats = static_cast<int>(n); });
  add_flag(*command, "--pilots", o->load.pilots, "Analyse pilot runs, too");
  add_flag(*command, "--edited", o->load.edited, "Analyse files that were changed by hand, and say so");
  add_flag(*command, "--power", o->power, "How many participants a difference needs, under the protocol DATA");
  add_flag(*command, "--check", o->check,
           "Simulated participants through the protocol DATA and its analysis: do its intervals hold?");
  exclude_each_other(*command, "--power", "--check");
  add_number_option(*command, "--count", {.min = 10, .max = 1e6, .whole = true},
                    "Groups for each difference of --power (default 2000), participants of --check (default 10000)",
                    [o](double n) { o->count = static_cast<int>(n); });
  on_run(*command, [options, command, &result] {
    if ((options->power || options->check) && options->data.size() != 1)
      refuse_option(options->power ? "--power" : "--check",
                    "takes one protocol, and no answers: give a file of presets/experiments, or one like it");
    options->analysis.command = command_text("analyse", *command);
    const Status status = options->power || options->check ? run_planning(*options) : run_analyse(*options);
    if (!status) print_message("analyse", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent

// workbench analyse: what the answers of an experiment say.
#include "workbench/analysis/write_analysis.h"
#include "workbench/cli/command.h"
#include "workbench/cli/command_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct AnalyseCommandOptions {
  std::vector<std::filesystem::path> data;
  std::filesystem::path participants;
  analysis::LoadOptions load;
  analysis::AnalysisOptions analysis;
};

Status run_analyse(AnalyseCommandOptions& options) {
  const InterruptGuard guard;
  options.analysis.stop = InterruptGuard::requested;
  if (!options.participants.empty()) {
    auto experience = analysis::read_experience(options.participants);
    if (!experience) return tl::unexpected(experience.error());
    options.analysis.experienced = std::move(*experience);
  }
  const Result<analysis::Answers> answers = analysis::load_answers(options.data, options.load);
  if (!answers) return tl::unexpected(answers.error());
  for (const std::string& note : answers->left_out) print_message("analyse", note);
  const auto page = analysis::write_analysis(*answers, options.analysis);
  if (!page) return tl::unexpected(page.error());
  std::printf("%s: %zu participants compared arcs, %zu named objects%s\n", page->c_str(), answers->comparisons.size(),
              answers->namings.size(), answers->simulated ? "; simulated" : "");
  return {};
}

}  // namespace

void add_analyse_command(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      add_command(app, "analyse", "Thresholds, confusions, tests and figures of an experiment's answers");
  auto options = std::make_shared<AnalyseCommandOptions>();
  AnalyseCommandOptions* o = options.get();
  add_paths_option(*command, "DATA", o->data, "Folders of `workbench experiment --out`, or single files", "DATA...");
  add_text_option(*command, "--out", o->analysis.folder, "Folder for analysis.html, figures and tables", "DIR",
                  Needed::yes);
  add_text_option(*command, "--participants", o->participants,
                  "participants.tsv with participant_id and experience (yes, no)", "F.tsv");
  add_number_option(*command, "--repeats", {.min = 20, .max = 100000, .whole = true},
                    "Times each staircase is run again for its interval (default 1000)",
                    [o](double n) { o->analysis.repeats = static_cast<int>(n); });
  add_flag(*command, "--pilots", o->load.pilots, "Analyse pilot runs, too");
  add_flag(*command, "--edited", o->load.edited, "Analyse files that were changed by hand, and say so");
  on_run(*command, [options, command, &result] {
    options->analysis.command = command_text("analyse", *command);
    const Status status = run_analyse(*options);
    if (!status) print_message("analyse", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent

// workbench report: recordings as one page.
#include "workbench/cli/report_command.h"

#include "core/io/scene_file.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/report/report.h"
#include "workbench/session/file_origin.h"
#include "workbench/session/two_threads.h"

#include <cstdio>
#include <memory>

#include <unistd.h>

namespace tangent {
namespace {

struct ReportCommandOptions {
  ReportOptions report;
  MeshOptions mesh;
};

/// The mesh of recordings that were made without theirs.
Status load_given_mesh(const MeshOptions& mesh, GatherOptions& gather) {
  if (mesh.file.empty()) return {};
  Result<SceneFile> file = read_scene(mesh.file, {mesh.metres_per_unit, mesh.build, {}}, run_on_two_threads);
  if (!file) return tl::unexpected(file.error());
  gather.scene = file->scene;
  gather.source = file->source ? SceneSource{file->source, mesh.build, nullptr} : source_of_planar(*file->scene);
  return {};
}

std::string typed_command(const CLI::App& command) {
  std::string text = "workbench report";
  for (const GivenOption& option : given_options(command))
    text += (option.name.empty() ? "" : " " + option.name) + " " + shell_word(option.value);
  return text;
}

Status run_report(ReportCommandOptions& options) {
  const InterruptGuard guard;
  GatherOptions& gather = options.report.gather;
  gather.cancelled = [] { return InterruptGuard::requested(); };
  if (::isatty(STDERR_FILENO) == 1)
    options.report.progress = [](const std::string& line) { std::fprintf(stderr, "%s ...\n", line.c_str()); };
  if (Status loaded = load_given_mesh(options.mesh, gather); !loaded) return loaded;
  const Result<std::filesystem::path> page = write_report(options.report);
  if (!page) return tl::unexpected(page.error());
  std::printf("%s: %zu recording%s\n", page->c_str(), options.report.recordings.size(),
              options.report.recordings.size() == 1 ? "" : "s");
  return {};
}

}  // namespace

void add_report_command_with(CLI::App& app, CommandResult& result, DrawTick draw) {
  CLI::App* command = add_command(app, "report", kReportCommandText);
  auto options = std::make_shared<ReportCommandOptions>();
  ReportCommandOptions* o = options.get();
  o->report.gather.draw = std::move(draw);
  add_paths_option(*command, "RECORDING", o->report.recordings, "Recordings, one after the other", "F.sqlite...");
  add_text_option(*command, "--out", o->report.folder, "Folder for report.html; made if it isn't there", "DIR",
                  Needed::yes);
  add_number_option(*command, "--ticks", {.min = 1, .max = 10'000'000, .whole = true},
                    "Ticks of the motion that every method solves, spread over it (default 20000)",
                    [o](double n) { o->report.gather.most_ticks = static_cast<std::uint64_t>(n); });
  add_number_option(*command, "--rounds", {.min = 1, .max = 1000, .whole = true},
                    "Rounds in which all methods are timed in turns (default 12, fewer where they take over 20 s)",
                    [o](double n) { o->report.gather.methods.rounds = static_cast<int>(n); });
  add_replaced_mesh_options(*command, o->mesh);
  on_run(*command, [options, command, &result] {
    options->report.command = typed_command(*command);
    const Status status = run_report(*options);
    if (!status) print_message("report", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

void add_report_command(CLI::App& app, CommandResult& result) { add_report_command_with(app, result, {}); }

}  // namespace tangent

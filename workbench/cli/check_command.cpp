// workbench check: measures again what presets say was measured with them; with --attach, measures and writes it.
#include "core/io/atomic_file.h"
#include "workbench/cli/check_report.h"
#include "workbench/cli/command.h"
#include "workbench/cli/command_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/evidence/attach_evidence.h"
#include "workbench/evidence/made_mesh.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 2> kMadeMotions{"around", "strokes"};  // the first of MotionKind

struct CheckCommandOptions {
  std::vector<std::filesystem::path> presets;
  std::filesystem::path json, poses, recording;
  MeshOptions mesh;
  MotionKind path = MotionKind::around;
  bool attach = false, path_given = false;
  std::string command;
};

bool not_interrupted() { return !InterruptGuard::requested(); }

/// 1 tells more than 3: a preset that can't be checked may hold.
int exit_code_of(const std::vector<CheckedFile>& files) {
  int code = kDone;
  for (const CheckedFile& file : files) {
    if (file.check.outcome == CheckOutcome::changed) return kFailed;
    if (file.check.outcome == CheckOutcome::impossible) code = kCantTell;
  }
  return code;
}

Result<int> run_check(const CheckCommandOptions& options) {
  const InterruptGuard interrupt;
  std::vector<CheckedFile> files;
  for (const std::filesystem::path& preset : options.presets) {
    auto check = check_preset_file(preset, {.folder = {}, .timed = false, .keep_going = not_interrupted});
    if (!check) break;
    files.push_back({preset, std::move(*check)});
    print_check(files.back());
  }
  if (!options.json.empty()) {
    const std::string text =
        check_json(files).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (Status ok = write_file_atomic(options.json, text); !ok) return tl::unexpected(ok.error());
  }
  if (files.size() == options.presets.size()) return exit_code_of(files);
  print_message("check", "interrupted after " + std::to_string(files.size()) + " of " +
                             std::to_string(options.presets.size()) + " presets");
  return kFailed;
}

PresetEvidence asked_evidence(const CheckCommandOptions& options, const std::filesystem::path& folder) {
  PresetEvidence asked;
  asked.command = options.command;
  if (!options.mesh.file.empty()) {
    const bool made = made_from(options.mesh.file.string()).has_value();
    asked.mesh.source = made ? options.mesh.file.string() : seen_from(folder, options.mesh.file);
  }
  asked.mesh.metres_per_unit = options.mesh.metres_per_unit;
  asked.mesh.options = options.mesh.build;
  const bool poses = !options.poses.empty(), recording = !options.recording.empty();
  asked.motion.kind = poses ? MotionKind::poses : recording ? MotionKind::recording : options.path;
  if (poses || recording) asked.motion.file = seen_from(folder, poses ? options.poses : options.recording);
  return asked;
}

Result<int> run_attach(const CheckCommandOptions& options) {
  const InterruptGuard interrupt;
  const std::filesystem::path& path = options.presets.front();
  Result<PresetFile> file = read_preset(path);
  if (!file) return tl::unexpected(file.error());
  const auto attached = attach_evidence(*file, asked_evidence(options, path.parent_path()),
                                        {.folder = path.parent_path(), .timed = true, .keep_going = not_interrupted});
  if (!attached) return tl::unexpected(attached.error());
  if (!*attached) {
    print_message("check", "interrupted; " + path.string() + " is as it was");
    return kFailed;
  }
  if (Status ok = write_preset(**attached, path); !ok) return tl::unexpected(ok.error());
  const EvidenceNumbers& n = (*attached)->about.measured->numbers;
  std::printf("%s written: %.0f ticks on %s\n", path.string().c_str(), n.ticks, (*attached)->about.mesh_name.c_str());
  return kDone;
}

void check_usage(const CheckCommandOptions& options) {
  const bool motion = !options.poses.empty() || !options.recording.empty() || options.path_given;
  if (!options.attach) {
    if (motion) refuse_option("--poses, --recording and --path", "are options of --attach");
    if (!options.mesh.file.empty()) refuse_option("--mesh", "is an option of --attach");
    return;
  }
  if (options.presets.size() != 1) refuse_option("--attach", "takes one preset");
  if (!options.json.empty()) refuse_option("--json", "reports a check; leave it out with --attach");
  if (options.mesh.file.empty() && options.recording.empty())
    refuse_option("--attach", "needs --mesh, or a --recording, which has its own");
}

}  // namespace

void add_check_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(
      app, "check", "Measure again what presets say was measured with them",
      "Exit codes: 0 all hold, 1 one has changed, or the work failed, 2 wrong usage, 3 one can't be checked.");
  auto options = std::make_shared<CheckCommandOptions>();
  add_paths_option(*command, "PRESET", options->presets, "Presets with evidence, [about.measured]", "F.toml...");
  add_text_option(*command, "--json", options->json, "The same report as JSON", "F.json");
  add_flag(*command, "--attach", options->attach,
           "Measure the preset on --mesh and write that into it as its evidence");
  add_replaced_mesh_options(*command, options->mesh,
                            "With --attach: a mesh, or how one is made: \"make octagon --rounding-mm 1.5\"");
  add_text_option(*command, "--poses", options->poses, "With --attach: the motion, t_s,x_m,y_m,z_m[,qw,qx,qy,qz]",
                  "F.csv");
  add_text_option(*command, "--recording", options->recording, "With --attach: the motion, and without --mesh the mesh",
                  "F.sqlite");
  add_choice_option(*command, "--path", kMadeMotions, "With --attach: a motion that the program makes; default around",
                    [options = options.get()](int kind) {
                      options->path = static_cast<MotionKind>(kind);
                      options->path_given = true;
                    });
  exclude_each_other(*command, "--poses", "--recording");
  exclude_each_other(*command, "--poses", "--path");
  exclude_each_other(*command, "--recording", "--path");
  on_run(*command, [command, options, &result] {
    check_usage(*options);
    options->command = command_text("check", *command);
    const Result<int> code = options->attach ? run_attach(*options) : run_check(*options);
    if (!code) print_message("check", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

}  // namespace tangent

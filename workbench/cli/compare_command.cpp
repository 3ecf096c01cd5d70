// workbench compare: two recordings, aligned, or one under two presets: what differs beyond a tolerance.
#include "core/io/atomic_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/compare_report.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/other_preset.h"
#include "workbench/cli/stopwatch.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct CompareCommandOptions {
  std::filesystem::path first, second, json, figures;
  PresetOptions preset;
  MeshOptions mesh;
  CompareRecordingsOptions wanted;
  bool coarse = false;
};

Result<RecordingsCompared> compare_with_preset(const CompareCommandOptions& options) {
  OtherPreset how;
  auto other = other_preset(options.preset);
  if (!other) return tl::unexpected(other.error());
  how.other = std::move(*other);
  if (!options.mesh.file.empty()) {
    auto scene = load_contact_scene(options.mesh, {});
    if (!scene) return tl::unexpected(scene.error());
    how.mesh = std::move(*scene);
  }
  std::puts("The second is the first's motion under the other values: same motion assumed.");
  return compare_under(options.first, how, options.wanted);
}

Result<int> run_compare(CompareCommandOptions& options) {
  const InterruptGuard guard;
  options.wanted.cancelled = [] { return InterruptGuard::requested(); };
  const Stopwatch watch;
  const Result<RecordingsCompared> compared = options.second.empty() ? compare_with_preset(options)
                                              : options.coarse
                                                  ? compare_coarsely(options.first, options.second, options.wanted)
                                                  : compare_fully(options.first, options.second, options.wanted);
  if (!compared) return tl::unexpected(compared.error());
  print_compared(*compared, watch.seconds());
  if (!options.json.empty()) {
    const std::string text =
        compared_json(*compared).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (Status ok = write_file_atomic(options.json, text); !ok) return tl::unexpected(ok.error());
  }
  if (!options.figures.empty() && compared->alignment.aligned())
    if (Status ok = write_comparison_figures(*compared, options.first, options.figures); !ok)
      return tl::unexpected(ok.error());
  if (compared->cancelled) print_message("compare", "interrupted: the table is of the ticks until then");
  return compared->outcome == CompareOutcome::same && !compared->cancelled ? kDone : kFailed;
}

void check_compare_usage(const CompareCommandOptions& options) {
  const bool otherwise = has_values(options.preset) || !options.mesh.file.empty();
  if (options.second.empty() && !otherwise)
    refuse_option("RECORDING2",
                  "is missing: give a second recording, or a preset or values for the first one's motion");
  if (!options.second.empty() && otherwise)
    refuse_option("RECORDING2", "can't be given with values for the first one's motion");
  if (options.second.empty() && options.coarse) refuse_option("--coarse", "needs a second recording");
}

void add_alignment(CLI::App& command, const std::shared_ptr<CompareCommandOptions>& options) {
  add_choice_option(command, "--align", kAlignByNames,
                    "Ticks go together by time (default), by number, from the first contact, or from a bookmark on",
                    [options](int i) { options->wanted.by = static_cast<AlignBy>(i); });
  add_text_option(command, "--bookmark", options->wanted.note, "Note of the bookmarks (default: the first of each)",
                  "NOTE");
}

void add_tolerances(CLI::App& command, const std::shared_ptr<CompareCommandOptions>& options) {
  CompareTolerance& tolerance = options->wanted.tolerance;
  add_number_option(command, "--force-tolerance-n", {.min = 0, .max = 1000, .unit = "N"},
                    "Difference of forces that counts as none (default 0.01)",
                    [options, &tolerance](double v) { tolerance.force_n = v; });
  add_number_option(command, "--length-tolerance-um", {.min = 0, .max = 1e6, .unit = "um"},
                    "The same of display, contact and penetration (default 10)",
                    [options, &tolerance](double v) { tolerance.length_m = 1e-6 * v; });
  add_number_option(command, "--finger-tolerance-mm", {.min = 0, .max = 1e6, .unit = "mm"},
                    "Ticks whose fingers are further apart are not compared (default 1)",
                    [options, &tolerance](double v) { tolerance.finger_m = 1e-3 * v; });
}

}  // namespace

void add_compare_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "compare", "Compare two recordings, or one under two presets",
                                  "Exit codes: 0 the same within the tolerances, 1 different, not aligned, or the work "
                                  "failed, 2 wrong usage.");
  auto options = std::make_shared<CompareCommandOptions>();
  add_text_option(*command, "RECORDING", options->first, "A recording", "A.sqlite", Needed::yes);
  add_text_option(*command, "RECORDING2", options->second, "Another one", "B.sqlite");
  add_alignment(*command, options);
  add_tolerances(*command, options);
  add_flag(*command, "--coarse", options->coarse, "By minima and maxima of 256 ticks: bounds, in a moment");
  add_text_option(*command, "--figures", options->figures, "Curves of both and their difference, as SVG and CSV",
                  "DIR");
  add_text_option(*command, "--json", options->json, "The same as JSON", "F.json");
  add_replaced_mesh_options(*command, options->mesh);
  add_preset_options(*command, options->preset);
  on_run(*command, [options, &result] {
    check_compare_usage(*options);
    const Result<int> code = run_compare(*options);
    if (!code) print_message("compare", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

}  // namespace tangent

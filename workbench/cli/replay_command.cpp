// workbench replay: computes a recording again. As it was: the same bits, or the first that differ. Under another
// preset, method or mesh: what that changes.
#include "core/io/atomic_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/other_preset.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/replay_report.h"
#include "workbench/cli/stopwatch.h"
#include "workbench/recording/compare.h"
#include "workbench/recording/replay.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <mutex>

namespace tangent {
namespace {

struct ReplayCommandOptions {
  std::filesystem::path recording, json, figures;
  MeshOptions mesh;
  PresetOptions preset;
  bool every_second = false;
};

Status write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  return path.empty() ? Status{}
                      : write_file_atomic(
                            path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

// --- As it was -----------------------------------------------------------------------------------------

Result<int> replay_as_it_was(const ReplayCommandOptions& options) {
  ReplayOptions wanted;
  wanted.every_second = options.every_second;
  if (!options.mesh.file.empty()) {
    auto scene = load_contact_scene(options.mesh, {});
    if (!scene) return tl::unexpected(scene.error());
    wanted.scene = std::move(*scene);
  }
  Result<Recording> recording = Recording::open(options.recording);
  if (!recording) return tl::unexpected(recording.error());
  Progress progress("ticks", recording->info().ticks);
  std::mutex mutex;
  wanted.cancelled = [] { return InterruptGuard::requested(); };
  wanted.progress = [&](std::uint64_t done) {
    const std::scoped_lock lock(mutex);
    progress.update(done);
  };
  const Stopwatch watch;
  const Result<ReplayReport> report = replay(options.recording, wanted);
  if (!report) return tl::unexpected(report.error());
  print_replay(*report, recording->info(), watch.seconds(), options.every_second);
  if (Status ok = write_json(options.json, replay_json(*report, recording->info())); !ok)
    return tl::unexpected(ok.error());
  if (report->cancelled) print_message("replay", "interrupted");
  return report->same() && !report->cancelled ? kDone : kFailed;
}

// --- Under something else ------------------------------------------------------------------------------

/// Curves of the recording, and of its motion under the other values.
Status draw_curves(const ReplayCommandOptions& options, const std::shared_ptr<const ContactScene>& mesh) {
  auto other = other_preset(options.preset);
  if (!other) return tl::unexpected(other.error());
  CompareRecordingsOptions wanted;
  wanted.cancelled = [] { return InterruptGuard::requested(); };
  const Result<RecordingsCompared> compared =
      compare_under(options.recording, {std::move(*other), nullptr, mesh}, wanted);
  if (!compared) return tl::unexpected(compared.error());
  return write_comparison_figures(*compared, options.recording, options.figures);
}

Result<int> replay_otherwise(const ReplayCommandOptions& options) {
  CompareOptions wanted;
  wanted.cancelled = [] { return InterruptGuard::requested(); };
  auto other = other_preset(options.preset);
  if (!other) return tl::unexpected(other.error());
  wanted.preset = *other;
  if (!options.mesh.file.empty()) {
    auto scene = load_contact_scene(options.mesh, {});
    if (!scene) return tl::unexpected(scene.error());
    wanted.mesh = std::move(*scene);
  }
  const Result<Comparison> comparison = compare(options.recording, wanted);
  if (!comparison) return tl::unexpected(comparison.error());
  print_comparison(*comparison);
  if (Status ok = write_json(options.json, comparison_json(*comparison)); !ok) return tl::unexpected(ok.error());
  if (!options.figures.empty() && !comparison->cancelled)
    if (Status ok = draw_curves(options, wanted.mesh); !ok) return tl::unexpected(ok.error());
  if (comparison->cancelled) print_message("replay", "interrupted: the table is of the ticks until then");
  return comparison->cancelled ? kFailed : kDone;
}

/// Whether --mesh is another mesh than the recorded one, or stands in for one that was recorded without its bytes.
Result<bool> is_other_mesh(const ReplayCommandOptions& options) {
  if (options.mesh.file.empty()) return false;
  Result<Recording> recording = Recording::open(options.recording);
  if (!recording) return tl::unexpected(recording.error());
  auto scene = load_contact_scene(options.mesh, {});
  if (!scene) return tl::unexpected(scene.error());
  const std::string hash = scene_hash(**scene);
  for (const RecordedScene& recorded : recording->scenes())
    if (recorded.hash == hash) return false;
  return true;
}

Result<int> run_replay(const ReplayCommandOptions& options) {
  const InterruptGuard guard;
  if (has_values(options.preset)) return replay_otherwise(options);
  const Result<bool> other = is_other_mesh(options);
  if (!other) return tl::unexpected(other.error());
  return *other ? replay_otherwise(options) : replay_as_it_was(options);
}

}  // namespace

void add_replay_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "replay", "Compute a recording again: the same bits, or what differs");
  auto options = std::make_shared<ReplayCommandOptions>();
  add_text_option(*command, "RECORDING", options->recording, "A recording", "F.sqlite", Needed::yes);
  add_flag(*command, "--every-second", options->every_second, "Only a tick a second, for a quick look");
  add_text_option(*command, "--figures", options->figures,
                  "Under other values: curves of both and their difference, as SVG and CSV", "DIR");
  add_text_option(*command, "--json", options->json, "The same report as JSON", "F.json");
  add_replaced_mesh_options(*command, options->mesh);
  add_preset_options(*command, options->preset);
  on_run(*command, [options, &result] {
    const Result<int> code = run_replay(*options);
    if (!code) print_message("replay", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

}  // namespace tangent

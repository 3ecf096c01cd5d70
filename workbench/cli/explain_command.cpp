// workbench explain: why a recorded tick did what it did; without --tick, of all ticks that want explaining.
#include "core/io/atomic_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/explain_lines.h"
#include "workbench/cli/explanation_json.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/progress.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

namespace tangent {
namespace {

struct ExplainCommandOptions {
  std::filesystem::path recording, json;
  MeshOptions mesh;
  std::optional<std::uint64_t> tick;
  ExplainRecordingOptions wanted;
};

unsigned long long shown(std::uint64_t n) { return n; }

Status write_report(const std::filesystem::path& path, nlohmann::ordered_json json) {
  if (path.empty()) return {};
  return write_file_atomic(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void print_tick(const ExplainedTick& e) {
  const TickOutput& out = e.why.tick;
  std::printf("Tick %llu at %.6g s: %s, event %s, %s.\n%s: %s\n", shown(e.tick), e.t_s, to_string(out.status),
              to_string(out.event), iterations_count(out).c_str(), to_string(e.why.cause),
              explanation_text(e.why).c_str());
  if (!e.same_bits)
    std::puts(
        "Computed again it differs from what was recorded; what is explained is the tick as it is computed here.");
}

Result<int> explain_one(const ExplainCommandOptions& options) {
  const Result<ExplainedTick> e = explain_recorded_tick(options.recording, *options.tick, options.wanted);
  if (!e) return tl::unexpected(e.error());
  print_tick(*e);
  nlohmann::ordered_json json = explained_tick_json(*e);
  json["format"] = 1;
  if (Status ok = write_report(options.json, std::move(json)); !ok) return tl::unexpected(ok.error());
  return kDone;
}

void print_recording(const ExplainedRecording& found) {
  std::printf("%llu of %llu ticks want explaining", shown(found.wanted), shown(found.ticks));
  if (found.explained < found.wanted) std::printf("; %llu of them were explained", shown(found.explained));
  std::puts(".");
  for (const CauseInRecording& cause : found.causes) {
    std::printf("%-20s %8llu   %s\n", to_string(cause.cause), shown(cause.ticks), sentence_of(cause.cause));
    std::printf("    worst: tick %llu at %.6g s, %s, event %s, %s. %s\n", shown(cause.worst.tick), cause.worst.t_s,
                to_string(cause.worst.why.tick.status), to_string(cause.worst.why.tick.event),
                iterations_count(cause.worst.why.tick).c_str(), explanation_text(cause.worst.why).c_str());
  }
}

Result<int> explain_all(ExplainCommandOptions& options) {
  const Result<Recording> recording = Recording::open(options.recording);
  if (!recording) return tl::unexpected(recording.error());
  Progress progress("ticks", recording->info().ticks);
  std::mutex mutex;
  options.wanted.cancelled = [] { return InterruptGuard::requested(); };
  options.wanted.progress = [&](std::uint64_t done) {
    const std::scoped_lock lock(mutex);
    progress.update(done);
  };
  const Result<ExplainedRecording> found = explain_recording(options.recording, options.wanted);
  if (!found) return tl::unexpected(found.error());
  print_recording(*found);
  if (Status ok = write_report(options.json, explained_recording_json(*found)); !ok) return tl::unexpected(ok.error());
  if (found->cancelled) print_message("explain", "interrupted: the table is of the ticks until then");
  return found->cancelled ? kFailed : kDone;
}

Result<int> run_explain(ExplainCommandOptions& options) {
  const InterruptGuard guard;
  if (!options.mesh.file.empty()) {
    auto scene = load_contact_scene(options.mesh, {});
    if (!scene) return tl::unexpected(scene.error());
    options.wanted.scene = std::move(*scene);
  }
  return options.tick ? explain_one(options) : explain_all(options);
}

}  // namespace

void add_explain_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "explain", "Say why a recorded tick did what it did, and what cures it");
  auto options = std::make_shared<ExplainCommandOptions>();
  add_text_option(*command, "RECORDING", options->recording, "A recording", "F.sqlite", Needed::yes);
  constexpr NumberRange kTicks{.min = 0, .max = 9e15, .whole = true};
  add_number_option(*command, "--tick", kTicks, "This tick (default: all that want explaining, by cause)",
                    [options](double v) { options->tick = static_cast<std::uint64_t>(v); });
  constexpr NumberRange kPlanes{.min = 1, .max = 10'000, .whole = true};
  add_number_option(*command, "--many-planes", kPlanes,
                    "A tick of more iterations, each a tangent plane computed, wants explaining (default 8)",
                    [options](double v) { options->wanted.explain.many_planes = static_cast<int>(v); });
  constexpr NumberRange kMost{.min = 1, .max = 1e9, .whole = true};
  add_number_option(*command, "--most", kMost,
                    "Ticks to explain at most (default 20,000); over that only the first of each 8 s",
                    [options](double v) { options->wanted.most = static_cast<std::uint64_t>(v); });
  add_text_option(*command, "--json", options->json, "The same as JSON", "F.json");
  add_replaced_mesh_options(*command, options->mesh);
  on_run(*command, [options, &result] {
    const Result<int> code = run_explain(*options);
    if (!code) print_message("explain", code.error().message());
    result.exit_code = code ? *code : static_cast<int>(kFailed);
  });
}

}  // namespace tangent

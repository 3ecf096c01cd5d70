// workbench bench: speed against error, for every method.
#include "core/io/atomic_file.h"
#include "workbench/bench/measure.h"
#include "workbench/bench/report_json.h"
#include "workbench/cli/bench_curves.h"
#include "workbench/cli/bench_plot.h"
#include "workbench/cli/bench_text.h"
#include "workbench/cli/command.h"
#include "workbench/cli/command_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/nearest_names.h"
#include "workbench/cli/option.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include <unistd.h>

namespace tangent {
namespace {

using namespace bench;

enum class Suite { paper, strokes, hard, mean, scale, all };
constexpr std::array<std::string_view, 6> kSuites{"paper", "strokes", "hard",
                                                  "mean",  "scale",   "all"};  // order of Suite

struct BenchOptions {
  Suite suite = Suite::paper;
  std::filesystem::path json, plot, meshes, poses;
  std::string only;
  std::uint32_t most_triangles = 6'000'000;
  MeasureOptions measure;
  BenchCurvesOptions own;  ///< of a mesh and motion of one's own
  bool no_peers = false;

  bool is_own() const { return !own.mesh.file.empty(); }
};

bool wants(const BenchOptions& options, Suite suite) { return options.suite == suite || options.suite == Suite::all; }

/// Shows the scene being measured ("hard: torus_inner_saddle") on standard error, if that is a terminal.
class SceneLine {
 public:
  SceneLine(std::string_view suite, std::string_view scene) : shown_(::isatty(STDERR_FILENO) == 1) {
    if (shown_)
      std::fprintf(stderr, "\r\033[K%.*s: %.*s", static_cast<int>(suite.size()), suite.data(),
                   static_cast<int>(scene.size()), scene.data());
  }
  SceneLine(const SceneLine&) = delete;
  SceneLine& operator=(const SceneLine&) = delete;
  ~SceneLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }

 private:
  bool shown_;
};

void keep(BenchReport& report, SceneReport scene) {
  std::fputs(scene_text(scene).c_str(), stdout);
  std::fflush(stdout);
  report.scenes.push_back(std::move(scene));
}

Status run_cases(const std::string& suite, const std::vector<BenchCase>& cases, const BenchOptions& options,
                 const TickClock& clock, BenchReport& report) {
  for (const BenchCase& c : cases) {
    if (InterruptGuard::requested()) return {};
    if (c.name.find(options.only) == std::string::npos) continue;
    std::optional<SceneReport> scene;
    {
      const SceneLine line(suite, c.name);
      Result<std::optional<SceneReport>> measured = measure_case(suite, c, options.measure, clock);
      if (!measured) return tl::unexpected(measured.error());
      scene = std::move(*measured);
    }
    if (scene) keep(report, std::move(*scene));
  }
  return {};
}

/// The plot's panels: a smooth object, sharp turns, and a saddle, where no single gain suits both directions.
Status run_work_precision(const BenchOptions& options, const TickClock& clock, BenchReport& report) {
  std::vector<BenchCase> cases = paper_cases();
  for (BenchCase& c : hard_cases()) cases.push_back(std::move(c));
  for (const std::string_view name : {"icosphere_320", "cube_rounded", "torus_inner_saddle"}) {
    for (const BenchCase& c : cases) {
      if (c.name != name || InterruptGuard::requested()) continue;
      const SceneLine line("work against precision", name);
      Result<std::optional<WorkPrecisionReport>> curves = measure_work_precision(c, options.measure, clock);
      if (!curves) return tl::unexpected(curves.error());
      if (*curves) report.work_precision.push_back(std::move(**curves));
    }
  }
  return {};
}

Status run_suites(const BenchOptions& options, const TickClock& clock, BenchReport& report) {
  Status status;
  if (wants(options, Suite::paper)) status = run_cases("paper", paper_cases(), options, clock, report);
  if (status && wants(options, Suite::strokes)) status = run_cases("strokes", stroke_cases(), options, clock, report);
  if (status && wants(options, Suite::hard)) status = run_cases("hard", hard_cases(), options, clock, report);
  if (status && wants(options, Suite::mean)) status = run_cases("mean", mean_cases(), options, clock, report);
  if (status && !options.poses.empty()) {
    const Result<std::vector<BenchCase>> cases = shared_cases(options.meshes, options.poses);
    if (!cases) return tl::unexpected(cases.error());
    status = run_cases("shared", *cases, options, clock, report);
  }
  if (status && wants(options, Suite::scale)) {
    status = measure_scale(options.most_triangles, options.measure, clock,
                           [&](SceneReport scene) { keep(report, std::move(scene)); });
  }
  if (status && !options.plot.empty()) status = run_work_precision(options, clock, report);
  return status;
}

/// Checks before the work starts that the file can be written.
Status probe(const std::filesystem::path& path) {
  if (path.empty()) return {};
  if (const Result<AtomicFile> file = AtomicFile::create(path); !file) return tl::unexpected(file.error());
  return {};
}

Status write_results(const BenchOptions& options, const BenchReport& report) {
  if (!options.json.empty()) {
    if (Status status = write_file_atomic(options.json, report_json(report).dump(2) + "\n"); !status) return status;
  }
  if (options.plot.empty() || report.work_precision.empty()) return {};
  const std::string command = "workbench bench --ticks " + std::to_string(options.measure.ticks) + " --repeats " +
                              std::to_string(options.measure.repeats) + " --plot " + shell_word(options.plot.string());
  return write_drawing(work_precision_figure(report.work_precision), {.command = command}, options.plot);
}

/// Ends the parsing where --only names no scene: nothing would be measured.
Status check_only(const BenchOptions& options) {
  if (options.only.empty()) return {};
  if (options.suite == Suite::scale) refuse_option("--only", "chooses among the scenes of the other suites");
  std::vector<std::string> names;
  const auto add = [&](const std::vector<BenchCase>& cases) {
    for (const BenchCase& c : cases) names.push_back(c.name);
  };
  if (wants(options, Suite::paper)) add(paper_cases());
  if (wants(options, Suite::strokes)) add(stroke_cases());
  if (wants(options, Suite::hard)) add(hard_cases());
  if (wants(options, Suite::mean)) add(mean_cases());
  if (!options.poses.empty()) {
    const Result<std::vector<BenchCase>> shared = shared_cases(options.meshes, options.poses);
    if (!shared) return tl::unexpected(shared.error());
    add(*shared);
  }
  if (std::none_of(names.begin(), names.end(), [&](const auto& name) { return name.find(options.only) != name.npos; }))
    refuse_option("--only", "no scene has '" + options.only + "' in its name; the nearest are " +
                                nearest_names(options.only, names) + " (another --suite has others)");
  return {};
}

Status run_bench(BenchOptions options, bool& interrupted) {
  if (Status ok = check_only(options); !ok) return ok;
  for (const auto& path : {options.json, options.plot}) {
    if (Status status = probe(path); !status) return status;
  }
  const InterruptGuard guard;
  options.measure.stop = [] { return InterruptGuard::requested(); };
  const TickClock clock;
  BenchReport report;
  report.clock_overhead_ns = clock.overhead_ns();
  report.repeats = options.measure.repeats;
  std::fputs(report_legend(report).c_str(), stdout);
  const Status status = run_suites(options, clock, report);
  report.interrupted = interrupted = InterruptGuard::requested();
  std::fputs(summary_text(report).c_str(), stdout);
  // Also writes what was measured before a failure.
  const Status written = write_results(options, report);
  if (interrupted)
    print_message("bench",
                  "interrupted after " + std::to_string(report.scenes.size()) + " scenes; what was measured is kept");
  return status ? written : status;
}

Status run_own(BenchOptions options, bool& interrupted) {
  options.own.poses = options.poses;
  options.own.json = options.json;
  options.own.plot = options.plot;
  options.own.curves.peers = !options.no_peers;
  const InterruptGuard guard;
  const Status status = run_bench_curves(std::move(options.own), interrupted);
  if (interrupted && status) print_message("bench", "interrupted; the rounds until then are kept");
  return status;
}

/// --mesh and what belongs to it.
void add_own_options(CLI::App& command, BenchOptions& o) {
  BenchCurvesOptions& own = o.own;
  add_replaced_mesh_options(command, own.mesh, "Speed against error on this mesh, in place of the suites");
  add_preset_options(command, own.preset);
  add_list_option(command, "--methods", own.methods, "With --mesh: these methods (default: all)", "A,B");
  add_text_option(command, "--csv", own.csv, "With --mesh: the table", "F.csv");
  add_flag(command, "--no-peers", o.no_peers, "With --mesh: without other libraries");
  add_number_option(command, "--rounds", {.min = 1, .max = 1000, .whole = true},
                    "With --mesh: rounds, each there and back (default 9)",
                    [&own](double n) { own.curves.rounds = static_cast<int>(n); });
  add_number_option(command, "--seconds", {.min = 0, .max = 86400},
                    "With --mesh: no round begins later, but for the first six (default 60)",
                    [&own](double s) { own.curves.most_s = s; });
  add_number_option(command, "--seed", {.min = 0, .max = 1e9, .whole = true},
                    "With --mesh: of the order within rounds (default 1)",
                    [&own](double n) { own.curves.seed = static_cast<std::uint64_t>(n); });
}

/// Options that would have no effect.
void refuse_idle(const CLI::App& command, const BenchOptions& o) {
  if (o.is_own()) {
    for (const char* const name : {"--suite", "--repeats", "--max-triangles"})
      if (command.count(name) > 0) refuse_option(name, "is of the suites; leave it out with --mesh");
    for (const PresetOverride& over : o.own.preset.overrides)
      if (over.key == find_preset_key("solver", "method"))
        refuse_option(over.by, "is one method; with --mesh all are measured, or those of --methods");
    return;
  }
  for (const char* const name : {"--rounds", "--seconds", "--seed", "--no-peers"})
    if (command.count(name) > 0) refuse_option(name, "requires --mesh F");
}

/// Ends the parsing where files or options contradict each other.
void check_options(const BenchOptions& o) {
  if (!o.json.empty() && o.json == o.plot) refuse_option("--plot", "names the same file as --json");
  if (!o.own.csv.empty() && (o.own.csv == o.json || o.own.csv == o.plot))
    refuse_option("--csv", "names the same file as another option");
  if (!o.plot.empty() && o.plot.extension() != ".svg" && o.plot.extension() != ".pdf")
    refuse_option("--plot", "ends in neither .svg nor .pdf");
  if (o.is_own() && !o.meshes.empty()) refuse_option("--meshes", "excludes --mesh");
  if (o.is_own() && !o.only.empty()) refuse_option("--only", "chooses among the suites' scenes, not with --mesh");
  if (o.is_own()) return;
  const PresetOptions& preset = o.own.preset;
  if (!preset.overrides.empty()) refuse_option(preset.overrides.front().by, "requires --mesh F");
  if (!preset.file.empty() || preset.condition >= 0)
    refuse_option(preset.file.empty() ? "--condition" : "--preset", "requires --mesh F");
  if (!o.own.methods.empty()) refuse_option("--methods", "requires --mesh F");
  if (o.meshes.empty() != o.poses.empty())
    refuse_option(o.meshes.empty() ? "--poses" : "--meshes",
                  o.meshes.empty() ? "requires --meshes DIR or --mesh F" : "requires --poses DIR");
  if (!o.own.csv.empty()) refuse_option("--csv", "requires --mesh F");
}

}  // namespace

void add_bench_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "bench", "Measure speed against error, for every method");
  auto options = std::make_shared<BenchOptions>();
  BenchOptions* o = options.get();
  add_choice_option(
      *command, "--suite", kSuites,
      "Scenes: the paper's objects explored all over (default), the same in the strokes of its participants, "
      "hard cases, balls against Embree's mean, 1k to 5M triangles, or all",
      [o](int i) { o->suite = static_cast<Suite>(i); });
  add_number_option(*command, "--ticks", {.min = 1, .max = 10'000'000, .whole = true},
                    "Ticks of each scene (default 10000; with --poses F.csv all)",
                    [o](double n) { o->measure.ticks = o->own.ticks = static_cast<int>(n); });
  add_number_option(*command, "--repeats", {.min = 1, .max = 100, .whole = true},
                    "Passes; a tick's time is the least of them (default 3)",
                    [o](double n) { o->measure.repeats = static_cast<int>(n); });
  add_number_option(*command, "--max-triangles", {.min = 1280, .max = 6e6, .whole = true},
                    "Largest mesh of the scale suite (default all)",
                    [o](double n) { o->most_triangles = static_cast<std::uint32_t>(n); });
  add_text_option(*command, "--only", options->only, "Only scenes whose name contains this", "TEXT");
  add_text_option(*command, "--json", options->json, "Everything measured", "F.json");
  add_text_option(
      *command, "--plot", options->plot,
      "Time against error as the tolerance sweeps from 1e-3 to 1e-9 mm; with --mesh also the iteration limit", "F.svg");
  add_text_option(*command, "--meshes", options->meshes, "Folder of more meshes: NAME.obj, fitted to 80 mm", "DIR");
  add_text_option(*command, "--poses", options->poses,
                  "Poses on them: NAME-rXXX.csv, finger radius XXX mm; with --mesh one file of poses (default: the "
                  "simulated hand explores)",
                  "DIR|F.csv");
  add_own_options(*command, *options);
  on_run(*command, [options, command, &result] {
    check_options(*options);
    refuse_idle(*command, *options);
    options->own.command = command_text("bench", *command);
    bool interrupted = false;
    const Status status = options->is_own() ? run_own(*options, interrupted) : run_bench(*options, interrupted);
    if (!status) print_message("bench", status.error().message());
    result.exit_code = status && !interrupted ? kDone : kFailed;
  });
}

}  // namespace tangent

// workbench tune: measures gains for the paper's iteration on a mesh and writes a preset.
#include "core/io/atomic_file.h"
#include "core/lab/audit/finger_size.h"
#include "core/lab/gains/gain_tuning.h"
#include "core/lab/measure/distribution.h"
#include "core/lab/measure/touch_count.h"
#include "workbench/cli/command.h"
#include "workbench/cli/command_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/preset_options.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/refuse.h"
#include "workbench/cli/stopwatch.h"
#include "workbench/cli/text_format.h"
#include "workbench/cli/tune_front.h"
#include "workbench/cli/tune_grounds.h"
#include "workbench/cli/tune_report.h"
#include "workbench/evidence/run_evidence.h"
#include "workbench/session/exploration_poses.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct TuneOptions {
  MeshOptions mesh;
  PresetOptions preset;
  std::filesystem::path out;
  TuneGroundOptions grounds;
  ExplorationKind path = ExplorationKind::around;
  TuneFrontOptions front;
  std::string command;  ///< as typed, with every option by its long name
};

bool names_method(const PresetOverride& o) { return o.key == find_preset_key("solver", "method"); }

/// The paper's method unless the options name another.
Result<PresetFile> load_base(const PresetOptions& options) {
  Result<PresetFile> base = load_preset(options);
  if (!base) return base;
  if (std::none_of(options.overrides.begin(), options.overrides.end(), names_method))
    base->preset.solver.method = Method::paper;
  return base;
}

/// Length scale of the ideal G_k: the finger's reach, or a 20th of the mesh for a point finger.
double gain_length(const ContactScene& scene, const Finger& finger) {
  const double reach = finger.reach_m();
  const double length = reach > 0.0 ? reach : 0.05 * glm::length(scene.mesh().bounds().size());
  return std::clamp(length, 1e-3, 1.0);
}

Result<std::vector<TickInput>> find_poses(const TuneOptions& options, const ContactScene& scene, TuneReport& report) {
  if (!options.grounds.poses.empty()) {
    const std::string& name = options.grounds.poses.front();
    report.poses = std::filesystem::path(name).filename().string();
    return sweep::motion_of(scene, name, report.preset.preset.finger);
  }
  Result<ExplorationPoses> explored =
      exploration_poses(scene, report.preset.preset.finger, options.path, ExplorationPace::varied);
  if (!explored) return tl::unexpected(explored.error());
  constexpr double kSlow = 1.0 - kExplorationSpeedSwing, kFast = 1.0 + kExplorationSpeedSwing;
  const double mm = explored->press_m * 1e3;
  report.poses = format("%s, %g to %g m/s, %g to %g mm deep, %.3g of %.3g m",
                        options.path == ExplorationKind::around ? "exploration path" : "strokes",
                        kExplorationSpeed * kSlow, kExplorationSpeed * kFast, mm * (1.0 - kExplorationPressSwing),
                        mm * (1.0 + kExplorationPressSwing), explored->way_m, explored->length_m);
  return std::move(explored->poses);
}

MethodRun run_method(const std::shared_ptr<const ContactScene>& scene, Preset preset, Method method,
                     std::span<const TickInput> poses) {
  preset.solver.method = method;
  Stepper stepper(scene);
  MethodRun run{method, score_run(stepper, preset, poses), 0.0, {}};
  std::vector<double> times;
  times.reserve(poses.size());
  TickState state;
  for (const TickInput& input : poses) {
    const Stopwatch watch;
    const TickOutput output = stepper.step(preset, input, state);
    times.push_back(watch.nanoseconds());
    if (output.triangle != kNone) run.grounds.add(ground_of(scene->mesh(), preset, output), output.iterations);
  }
  run.median_ns = distribution(std::move(times)).p50;
  return run;
}

GainTuning tune(const std::shared_ptr<const ContactScene>& scene, const Preset& base, std::span<const TickInput> poses,
                const TuneKept& kept) {
  const GainGrid grid = make_gain_grid(gain_length(*scene, base.finger));
  Progress progress("gains tried", grid.coarse.size());
  GainMemory memory;
  if (sweep::TuningFile* const file = kept.file(); file != nullptr)
    memory = {[file](const Gains& gains) { return file->score(gains); },
              [file](const Gains& gains, const RunScore& score) { file->keep(gains, score); }};
  const auto keep_going = [&](std::size_t done, std::size_t planned) {
    progress.update(done, planned);
    return !InterruptGuard::requested() && !kept.failed();
  };
  return tune_gains(scene, base, poses, grid, keep_going, memory);
}

/// What the preset was measured with, so that "workbench check" can measure it again. Where that can't be named (the
/// mesh came through a pipe) a message says so, and the preset is written without.
void name_evidence(const TuneOptions& options, TuneReport& report) {
  const std::filesystem::path folder = options.out.parent_path();
  PresetEvidence asked;
  asked.command = options.command;
  asked.mesh = {seen_from(folder, options.mesh.file), {}, options.mesh.metres_per_unit, options.mesh.build};
  asked.motion.kind = options.path == ExplorationKind::around ? MotionKind::around : MotionKind::strokes;
  if (!options.grounds.poses.empty()) {
    const std::string& name = options.grounds.poses.front();
    const auto made = sweep::made_motion(name);
    const bool recording = std::filesystem::path(name).extension() == ".sqlite";
    asked.motion.kind = made        ? static_cast<MotionKind>(made->kind)
                        : recording ? MotionKind::recording
                                    : MotionKind::poses;
    if (!made) asked.motion.file = seen_from(folder, name);
  }
  asked.values = report.preset.preset;
  asked.values.controller = {};  // no tick reads it
  auto evidence = measure_evidence(std::move(asked), {.folder = folder, .timed = true});
  if (evidence) {
    report.preset.about.measured = std::move(*evidence);
  } else {
    report.preset.about.measured.reset();
    print_message("tune", "the preset names no evidence: " + evidence.error().message());
  }
}

/// What was found, for a person; empty: interrupted before anything was tried.
struct Found {
  std::string text;
  std::string note;         ///< of the preset; empty: as describe_measurement has it
  std::string until;        ///< of an interrupted search: "the best of ..."; empty: it was not
  bool incomplete = false;  ///< a mesh or motion that was asked for could not be had
};

Result<Found> find_gains(const std::shared_ptr<const ContactScene>& scene, std::span<const TickInput> poses,
                         TuneReport& report, TuneKept& kept) {
  Preset& preset = report.preset.preset;
  if (Status ok = kept.open(sweep::tuning_digest(preset, *scene, poses)); !ok) return tl::unexpected(ok.error());
  report.tuning = tune(scene, preset, poses, kept);
  if (Status ok = kept.status(); !ok) return tl::unexpected(ok.error());
  if (report.tuning.best.empty()) return Found{};
  preset.solver = with_gains(preset.solver, report.tuning.best.front().gains);
  const Method own = preset.solver.method;
  report.own = run_method(scene, preset, own, poses);
  for (const Method method : {Method::paper, Method::newton, Method::robust})
    if (method != own) report.others.push_back(run_method(scene, preset, method, poses));
  Found out{tune_text(report), {}, {}, false};
  if (report.tuning.stopped) out.until = std::to_string(report.tuning.tried) + " gains tried so far";
  return out;
}

Result<Found> find_on_front(const TuneOptions& options, const std::shared_ptr<const ContactScene>& scene,
                            const std::vector<TickInput>& poses, TuneReport& report, TuneKept& kept) {
  Preset& preset = report.preset.preset;
  TuneGrounds grounds = tune_grounds(options.grounds, options.mesh, preset,
                                     {scene, std::make_shared<const std::vector<TickInput>>(poses)},
                                     std::string(kExplorationNames[static_cast<std::size_t>(options.path)]));
  for (const std::string& note : grounds.notes) print_message("tune", note);
  for (const std::string& failed : grounds.failed) print_message("tune", failed + "; the others go on");
  for (const std::string& text : tune_ignored(preset, gain_length(*scene, preset.finger), options.front))
    print_message("tune", text);
  Result<TunedFront> tuned =
      tune_front(std::move(grounds.all), preset, gain_length(*scene, preset.finger), options.front, kept);
  if (!tuned) return tl::unexpected(tuned.error());
  preset = tuned->preset;
  report.own = run_method(scene, preset, preset.solver.method, poses);
  Found out{tuned->text, "Of a front:", tuned->stopped ? "presets tried so far" : "", !grounds.failed.empty()};
  for (const sweep::Objective& objective : options.front.objectives) out.note += " " + std::string(objective.name());
  for (const sweep::Constraint& constraint : options.front.constraints) out.note += ", " + constraint.text();
  return out;
}

Status run_tune(const TuneOptions& options, bool& incomplete) {
  const InterruptGuard interrupt;
  TuneReport report;
  report.command = options.command;
  Result<PresetFile> base = load_base(options.preset);
  if (!base) return tl::unexpected(base.error());
  report.preset = std::move(*base);
  const Preset& preset = report.preset.preset;
  // Checks before the work starts that the files can be written.
  if (const Result<AtomicFile> probe = AtomicFile::create(options.out); !probe) return tl::unexpected(probe.error());
  Result<LoadedMesh> loaded = load_mesh(options.mesh);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto scene = ContactScene::build(std::move(loaded->mesh));
  if (!scene) return tl::unexpected(scene.error());
  report.mesh = &(*scene)->mesh();
  const Result<std::vector<TickInput>> poses = find_poses(options, **scene, report);
  if (!poses) return tl::unexpected(poses.error());

  const TouchCount touches = count_until_touched(*scene, preset, *poses, [] { return InterruptGuard::requested(); });
  if (std::string note = touches.note(); !note.empty() && !InterruptGuard::requested())
    return fail(std::move(note), options.grounds.poses.empty() ? std::string() : options.grounds.poses.front(),
                "no gains can be told apart on such a motion");
  // Before the seconds that it takes, and again in the report.
  if (const std::string note = finger_size_note(longest_side_m(*report.mesh), preset.finger); !note.empty())
    print_message("tune", note);
  TuneKept kept(options.out);
  const Result<Found> found = options.front.objectives.empty() ? find_gains(*scene, *poses, report, kept)
                                                               : find_on_front(options, *scene, *poses, report, kept);
  if (!found) return tl::unexpected(found.error());
  const bool interrupted = found->text.empty() || !found->until.empty();
  incomplete = interrupted || found->incomplete;
  if (found->text.empty()) {
    print_message("tune", "interrupted before any gains were tried; nothing is written");
    return {};
  }
  report.preset.about.name = options.out.stem().string();
  name_evidence(options, report);
  describe_measurement(report);
  if (!found->note.empty()) report.preset.about.note = found->note;
  if (const Status status = write_preset(report.preset, options.out); !status) return status;
  if (!interrupted) kept.remove();
  std::fputs((found->text + options.out.string() + " written\n").c_str(), stdout);
  if (interrupted)
    print_message("tune", "interrupted; " + options.out.string() + " holds the best of the " + found->until +
                              "; the same command goes on from there");
  return {};
}

template <class Value>
void refuse_twice(const std::string& option, const std::vector<Value>& values) {
  for (auto at = values.begin(); at != values.end(); ++at)
    if (std::find(values.begin(), at, *at) != at) refuse_option(option, "has one value twice; leave one of them out");
}

void check_usage(const TuneOptions& options) {
  for (const PresetOverride& o : options.preset.overrides) {
    if (o.key->tuned) refuse_option(o.by, "is what tune finds; leave it out");
    if (!names_method(o) || is_smooth(static_cast<Method>(o.value))) continue;
    std::vector<std::string_view> allowed;
    for (std::size_t i = 0; i < kMethodNames.size(); ++i)
      if (is_smooth(static_cast<Method>(i))) allowed.push_back(kMethodNames[i]);
    refuse_option(o.by, o.key->value_text(o.value) + " has no gains; allowed: " + choices_text(allowed));
  }
  refuse_same_file("--out", options.out, "MESH", options.mesh.file);
  for (const std::string& mesh : options.grounds.meshes) refuse_same_file("--out", options.out, "--also-mesh", mesh);
  for (const std::string& poses : options.grounds.poses) {
    refuse_failed("--poses", sweep::check_made_motion(poses));
    if (!sweep::is_made(poses)) refuse_same_file("--out", options.out, "--poses", poses);
  }
  refuse_twice("--poses", options.grounds.poses);
  refuse_twice("--also-mesh", options.grounds.meshes);
  refuse_twice("--also-radius-mm", options.grounds.radii_m);
  if (options.front.objectives.empty() && options.grounds.several())
    refuse_option("--objective", "is missing: several meshes, motions and fingers belong to objectives");
  for (const sweep::Range& range : options.front.ranges)
    if (!options.grounds.radii_m.empty() && range.key->table == "finger")
      refuse_option("--also-radius-mm", "contradicts --range " + range.key->full_name());
}

}  // namespace

void add_tune_command(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      add_command(app, "tune", "Find the gains of the paper's iteration by measuring on a mesh",
                  "The gains are those of the paper's iteration (Eq. 1), whatever --method the preset is to use "
                  "(default paper). Ctrl-C keeps the best so far.");
  auto options = std::make_shared<TuneOptions>();
  add_mesh_options(*command, options->mesh);
  add_tune_ground_options(*command, options->grounds);
  add_choice_option(
      *command, "--path", kExplorationNames,
      "How the mesh is explored, at 0.05 to 0.15 m/s, 0.4 to 1.6 mm deep: all over (around, the default), "
      "or left and right over its top, then forward and back, as the paper's participants (strokes)",
      [options = options.get()](int kind) { options->path = static_cast<ExplorationKind>(kind); });
  add_text_option(*command, "--out", options->out, "Preset to write", "preset.toml", Needed::yes);
  exclude_each_other(*command, "--path", "--poses");
  add_tune_front_options(*command, options->front);
  add_preset_options(*command, options->preset);
  on_run(*command, [command, options, &result] {
    check_usage(*options);
    check_tune_front(options->front);
    options->command = command_text("tune", *command);
    bool incomplete = false;
    const Status status = run_tune(*options, incomplete);
    if (!status) print_message("tune", status.error().message());
    result.exit_code = status && !incomplete ? kDone : kFailed;
  });
}

}  // namespace tangent

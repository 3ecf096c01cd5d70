// workbench solve: steps every pose of a file, one tick each, and writes ticks.csv.
#include "core/io/atomic_file.h"
#include "core/io/pose_file.h"
#include "core/io/scene_file.h"
#include "core/io/ticks_file.h"
#include "core/lab/measure/touch_count.h"
#include "workbench/cli/command.h"
#include "workbench/cli/explain_lines.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/preset_options.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/solve_recording.h"
#include "workbench/cli/solve_report.h"
#include "workbench/cli/stopwatch.h"
#include "workbench/session/csv_metadata.h"
#include "workbench/session/kept_memory.h"
#include "workbench/session/two_threads.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace tangent {
namespace {

struct SolveOptions {
  MeshOptions mesh;
  PresetOptions preset;
  std::filesystem::path poses, ticks, summary, iterations, record;
  bool explain = false, many_given = false;
  ExplainOptions explained;
};

/// The output files of a run, being written.
struct SolveOutputs {
  TicksFile ticks;
  std::optional<IterationsFile> iterations;
  std::optional<RecordingFile> recording;
  std::optional<ExplainLines> explanations;
};

/// Checks before the work starts that the files can be written.
Status probe_outputs(const SolveOptions& options) {
  for (const std::filesystem::path& path : {options.ticks, options.summary, options.iterations}) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    // Not for a pipe: opening and closing it would signal the end of the data to its reader.
    if (path.empty() || std::filesystem::is_fifo(status)) continue;
    if (const Result<AtomicFile> file = AtomicFile::create(path); !file) return tl::unexpected(file.error());
  }
  return {};
}

Result<SolveOutputs> create_outputs(const SolveOptions& options) {
  Result<TicksFile> ticks = TicksFile::create(options.ticks);
  if (!ticks) return tl::unexpected(ticks.error());
  SolveOutputs outputs{std::move(*ticks), std::nullopt, std::nullopt, std::nullopt};
  if (options.iterations.empty()) return outputs;
  Result<IterationsFile> iterations = IterationsFile::create(options.iterations);
  if (!iterations) return tl::unexpected(iterations.error());
  outputs.iterations.emplace(std::move(*iterations));
  return outputs;
}

/// Has what the next tick will search built before its time is taken.
class BuildAhead {
 public:
  BuildAhead(const ContactScene& scene, const Preset& preset)
      : scene_(scene), reach_m_(preset.finger.reach_m()), waits_(scene.unbuilt_parts() > 0) {}
  /// Before the first tick, which searches for a start and not ahead.
  void first(const TickInput& input) {
    constexpr double kLess_m = -4e-3;  // on a ball of 5.2M triangles the tick then comes to none that is missing
    if (waits_) scene_.build_near(input.finger.position, reach_m_, run_on_two_threads, kLess_m);
  }
  void before(const TickInput& input) {
    constexpr double kShare = 0.1;             // of the finger's reach
    constexpr double kSearchedAhead_m = 8e-3;  // by searches, once they found it cheap (kMostAhead)
    if (!waits_ || glm::length(input.finger.position - last_) < kShare * reach_m_) return;
    last_ = input.finger.position;
    scene_.build_near(last_, reach_m_, run_on_two_threads, std::exchange(ahead_m_, kSearchedAhead_m));
  }

 private:
  const ContactScene& scene_;
  double reach_m_;
  bool waits_;
  double ahead_m_ = 0.0;
  Vec3 last_{1e300};
};

/// Steps the poses in turn until they end or Ctrl-C. Precondition: an InterruptGuard.
Status step_all(BuildAhead& ahead, Stepper& stepper, const std::vector<TickInput>& poses, SolveOutputs& outputs,
                SolveReport& report) {
  Progress progress("ticks", poses.size());
  // Too large for the stack.
  const auto trace = outputs.iterations ? std::make_unique<IterationTrace>() : nullptr;
  TickState state;
  TickRow row;
  TickRecording recording(outputs.recording);
  report.statistics.reserve(poses.size());
  for (const TickInput& input : poses) {
    if (InterruptGuard::requested()) {
      report.interrupted = true;
      break;
    }
    if (trace) trace->clear();
    if (row.tick > 0) ahead.before(input);
    recording.keep(state);
    const TickState before = state;
    const Stopwatch watch;
    row.output = stepper.step(report.preset.preset, input, state, trace.get());
    row.solve_ns = watch.nanoseconds();
    row.t_s = input.t_s;
    if (Status status = outputs.ticks.append(row); !status) return status;
    if (Status status = recording.append(row, input); !status) return status;
    if (trace) {
      if (Status status = outputs.iterations->append(row.tick, *trace); !status) return status;
    }
    report.statistics.add(report.preset.preset, input, row.output, row.solve_ns);
    if (outputs.explanations) outputs.explanations->after(row.tick, input, before, row.output);
    progress.update(++row.tick);
  }
  return recording.flush();
}

Status commit(SolveOutputs& outputs, const SolveOptions& options, const SolveReport& report) {
  if (Status status = outputs.ticks.commit(); !status) return status;
  if (outputs.iterations) {
    if (Status status = outputs.iterations->commit(); !status) return status;
  }
  if (outputs.recording) {
    if (Status status = outputs.recording->close(); !status) return status;
  }
  if (options.summary.empty()) return {};
  return write_file_atomic(options.summary, solve_json(report).dump(2) + "\n");
}

/// The command that this process runs, as one types it.
std::string command_of_process() {
  std::ifstream words("/proc/self/cmdline", std::ios::binary);
  std::string word, text = "workbench";
  std::getline(words, word, '\0');  // the program
  while (std::getline(words, word, '\0')) text += " " + shell_word(word);
  return text;
}

/// Beside the ticks: what they are, and where they come from.
Status write_origin(const SolveOptions& options, const SolveReport& report, std::uint64_t mesh_hash) {
  FileOrigin origin{.preset = report.preset_name, .command = command_of_process()};
  if (report.mesh != nullptr) {
    origin.mesh = mesh_fact(report.mesh->name(), report.mesh->triangle_count(), mesh_hash);
    origin.unit = unit_fact(options.mesh.metres_per_unit);
  }
  return write_csv_metadata(options.ticks, kTicksHeader, origin);
}

/// In 2D only a point or a sphere (circle) is a valid finger.
Status check_shape(const ContactScene& scene, const Preset& preset) {
  const FingerShape shape = preset.finger.shape;
  if (scene.planar() == nullptr || shape == FingerShape::point || shape == FingerShape::sphere) return {};
  return fail("a 2D scene takes point and sphere fingers only", "finger.shape", "choose finger.shape point or sphere");
}

class WaitFor {
 public:
  explicit WaitFor(const std::future<std::uint64_t>& result) : result_(result) {}
  WaitFor(const WaitFor&) = delete;
  WaitFor& operator=(const WaitFor&) = delete;
  ~WaitFor() { now(); }
  void now() const {
    if (result_.valid()) result_.wait();
  }

 private:
  const std::future<std::uint64_t>& result_;
};

/// Where no tick found a contact: whether there was one to find.
std::string touch_note(const std::shared_ptr<const ContactScene>& scene, const SolveReport& report,
                       std::span<const TickInput> poses) {
  if (report.statistics.touched() || report.interrupted) return {};
  const auto stop = [] { return InterruptGuard::requested(); };
  const TouchCount count = count_until_touched(scene, report.preset.preset, poses, stop);
  return stop() ? std::string() : count.note();
}

Status solve(const SolveOptions& options, bool& interrupted) {
  SolveReport report;
  const Stopwatch loading;
  std::optional<KeptMemory> kept(std::in_place, memory_to_open(options.mesh.file));
  Result<PresetFile> preset = load_preset(options.preset);
  if (!preset) return tl::unexpected(preset.error());
  if (Status status = probe_outputs(options); !status) return status;
  const Result<std::vector<TickInput>> poses = read_poses(options.poses);
  if (!poses) return tl::unexpected(poses.error());
  std::future<std::uint64_t> mesh_hash;  // on millions of triangles it takes a quarter of the time of all else
  const BesideContent hashing{[&](const MeshContent& content) {
                                mesh_hash = std::async(std::launch::async, [content] { return content.hash(); });
                              },
                              [&] { mesh_hash.wait(); }};
  Result<SceneFile> file =
      read_scene(options.mesh.file, {options.mesh.metres_per_unit, options.mesh.build, parts_for(preset->preset)},
                 run_on_two_threads, hashing);
  if (!file) return tl::unexpected(file.error());
  const WaitFor hashed(mesh_hash);                   // before the mesh ends
  if (options.record.empty()) file->source.reset();  // as large as the mesh
  const auto* const scene = &file->scene;
  if (Status status = check_shape(**scene, preset->preset); !status) return status;
  report.load_seconds = loading.seconds();

  report.mesh = (*scene)->has_mesh() ? &(*scene)->mesh() : nullptr;
  report.planar = (*scene)->planar();
  report.preset = std::move(*preset);
  report.preset_name = options.preset.file.empty() ? "built-in values" : options.preset.file.string();
  report.poses_name = options.poses.string();
  report.poses = poses->size();
  const Stopwatch solving;
  Stepper stepper(*scene);
  const InterruptGuard interrupt;  // until the last file is in place
  Result<SolveOutputs> outputs = create_outputs(options);
  if (!outputs) return tl::unexpected(outputs.error());
  if (!options.record.empty()) {
    Result<RecordingFile> recording =
        create_recording(options.record, *file, {options.mesh, options.poses, report.preset.preset});
    if (!recording) return tl::unexpected(recording.error());
    outputs->recording.emplace(std::move(*recording));
  }
  if (options.explain) outputs->explanations.emplace(*scene, report.preset.preset, options.explained);
  BuildAhead ahead(**scene, report.preset.preset);
  ahead.first(poses->front());
  kept.reset();
  hashed.now();  // ticks are timed
  if (Status status = step_all(ahead, stepper, *poses, *outputs, report); !status) return status;
  interrupted = report.interrupted;
  report.solve_seconds = solving.seconds();
  report.scene_bytes = (*scene)->memory_bytes();
  report.touch_note = touch_note(*scene, report, *poses);
  if (outputs->explanations) report.causes = outputs->explanations->counts();
  if (Status status = commit(*outputs, options, report); !status) return status;
  if (Status status = write_origin(options, report, mesh_hash.valid() ? mesh_hash.get() : 0); !status) return status;
  std::fputs(solve_text(report).c_str(), stdout);
  if (!report.touch_note.empty()) print_message("solve", report.touch_note);
  if (interrupted) {
    print_message("solve", "interrupted after " + std::to_string(report.statistics.ticks()) + " of " +
                               std::to_string(report.poses) + " poses; " + options.ticks.string() + " holds those");
  }
  return {};
}

/// Two outputs in one file, or an output over an input, would lose data.
void refuse_shared_paths(const SolveOptions& options) {
  const std::pair<const char*, const std::filesystem::path*> files[]{
      {"MESH", &options.mesh.file}, {"--poses", &options.poses},     {"--preset", &options.preset.file},
      {"--out", &options.ticks},    {"--summary", &options.summary}, {"--iterations", &options.iterations},
      {"--record", &options.record}};
  constexpr std::size_t kInputs = 3;
  for (std::size_t i = kInputs; i < std::size(files); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].second->empty() || files[j].second->empty()) continue;
      std::error_code error;
      const bool same = *files[i].second == *files[j].second ||
                        (std::filesystem::is_regular_file(*files[i].second, error) &&
                         std::filesystem::equivalent(*files[i].second, *files[j].second, error));
      if (same) refuse_option(files[i].first, std::string("names the same file as ") + files[j].first);
    }
  }
}

}  // namespace

void add_solve_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "solve", "Solve every pose of a file on a mesh: one line a tick");
  auto options = std::make_shared<SolveOptions>();
  add_mesh_options(*command, options->mesh);
  add_text_option(*command, "--poses", options->poses, "Finger poses: t_s,x_m,y_m,z_m[,qw,qx,qy,qz]", "F.csv",
                  Needed::yes);
  add_text_option(*command, "--out", options->ticks, "Ticks: contact, force, display, iterations, time", "F.csv",
                  Needed::yes);
  add_text_option(*command, "--summary", options->summary, "Counts and percentiles of the run", "F.json");
  add_text_option(*command, "--iterations", options->iterations, "Every tangent plane of every tick", "F.csv");
  add_text_option(*command, "--record", options->record,
                  "A recording, to be replayed; a file that is there is not written over", "F.sqlite");
  add_flag(*command, "--explain", options->explain,
           "Say for every tick that did not converge, had an event or took many iterations why, and what cures it");
  add_number_option(
      *command, "--many-planes", {.min = 0, .max = 10000, .whole = true},
      "With --explain: ticks of more iterations, each a tangent plane computed, are explained, too; default 8",
      [options](double planes) {
        options->many_given = true;
        options->explained.many_planes = static_cast<int>(planes);
      });
  add_preset_options(*command, options->preset);
  on_run(*command, [options, &result] {
    refuse_shared_paths(*options);
    if (options->many_given && !options->explain) refuse_option("--many-planes", "is an option of --explain");
    bool interrupted = false;
    const Status status = solve(*options, interrupted);
    if (!status) print_message("solve", status.error().message());
    result.exit_code = status && !interrupted ? kDone : kFailed;
  });
}

}  // namespace tangent

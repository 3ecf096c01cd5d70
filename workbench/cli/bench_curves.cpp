#include "workbench/cli/bench_curves.h"

#include "core/finger/plane_contact.h"
#include "core/io/atomic_file.h"
#include "core/io/pose_file.h"
#include "core/io/scene_file.h"
#include "core/lab/measure/touch_count.h"
#include "workbench/bench/case_paths.h"
#include "workbench/bench/speed_curves_report.h"
#include "workbench/cli/bench_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/method_list.h"
#include "workbench/cli/progress.h"
#include "workbench/session/two_threads.h"

#include <cstdio>
#include <utility>

namespace tangent {
namespace {

using namespace bench;

Result<std::vector<TickInput>> motion_of(const BenchCurvesOptions& options, const ContactScene& scene,
                                         const Preset& preset) {
  constexpr int kTicks = 10'000;
  constexpr double kSpeed_m_per_s = 0.1, kPress_m = 1e-3;
  if (options.poses.empty())
    return explore(scene, preset.finger, kSpeed_m_per_s, kPress_m, options.ticks > 0 ? options.ticks : kTicks);
  Result<std::vector<TickInput>> poses = read_poses(options.poses);
  if (poses && options.ticks > 0 && poses->size() > static_cast<std::size_t>(options.ticks))
    poses->resize(static_cast<std::size_t>(options.ticks));
  return poses;
}

/// The scene with all that any method reads, and the motion over it.
Result<MotionPart> motion_part(const BenchCurvesOptions& options, const Preset& preset) {
  const Result<SceneFile> file =
      read_scene(options.mesh.file, {options.mesh.metres_per_unit, options.mesh.build, {}}, run_on_two_threads);
  if (!file) return tl::unexpected(file.error());
  if (file->scene->planar() != nullptr)
    return fail("a 2D scene has no curves of speed against error", options.mesh.file.string(), "give a 3D mesh");
  Result<std::vector<TickInput>> poses = motion_of(options, *file->scene, preset);
  if (!poses) return tl::unexpected(poses.error());
  if (poses->empty()) return fail("has no poses", options.poses.string(), "give at least one");
  return MotionPart{file->scene, preset, std::move(*poses)};
}

Status write_files(const BenchCurvesOptions& options, const SpeedCurves& curves, const FileOrigin& origin) {
  if (!options.csv.empty()) {
    if (Status status = write_file_atomic(options.csv, curves_csv(curves, origin)); !status) return status;
  }
  if (!options.json.empty()) {
    if (Status status = write_file_atomic(options.json, curves_json(curves, origin).dump(2) + "\n"); !status)
      return status;
  }
  if (options.plot.empty()) return {};
  return write_drawing(curves_figure(curves), origin, options.plot);
}

Status probe_files(const BenchCurvesOptions& options) {
  for (const std::filesystem::path& path : {options.csv, options.json, options.plot}) {
    if (path.empty()) continue;
    if (const Result<AtomicFile> file = AtomicFile::create(path); !file) return tl::unexpected(file.error());
  }
  return {};
}

}  // namespace

Status run_bench_curves(BenchCurvesOptions options, bool& interrupted) {
  if (const std::vector<Method> methods = methods_named(options.methods); !methods.empty())
    options.curves.methods = methods;
  const Result<PresetFile> preset = load_preset(options.preset);
  if (!preset) return tl::unexpected(preset.error());
  if (Status status = probe_files(options); !status) return status;
  const Result<MotionPart> part = motion_part(options, preset->preset);
  if (!part) return tl::unexpected(part.error());
  const auto stop = [] { return InterruptGuard::requested(); };
  const TouchCount touches = count_until_touched(part->scene, preset->preset, part->poses, stop);
  if (const std::string note = touches.note(); !note.empty() && !stop()) print_message("bench", note);
  const TickClock clock;
  Progress progress("passes", 1);
  options.curves.stop = stop;
  options.curves.progress = [&](std::size_t done, std::size_t planned) { progress.update(done, planned); };
  const auto curves = measure_speed_curves(std::span(&*part, 1), clock, options.curves);
  interrupted = InterruptGuard::requested();
  if (!curves) return fail("interrupted before the first round", {}, "nothing is measured");
  const ContactMesh& mesh = part->scene->mesh();
  std::fputs(curves_text(*curves).c_str(), stdout);
  return write_files(options, *curves,
                     {.mesh = mesh_fact(mesh.name(), mesh.triangle_count(), mesh.content_hash()),
                      .preset = options.preset.file.empty() ? "built-in values" : options.preset.file.string(),
                      .unit = unit_fact(options.mesh.metres_per_unit),
                      .command = options.command + (options.command.find("--seed") == std::string::npos
                                                        ? " --seed " + std::to_string(curves->seed)
                                                        : "")});
}

}  // namespace tangent

// The program without a subcommand: the built-in scene, solved.
#include "workbench/cli/builtin_scene.h"
#include "workbench/cli/command.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/solve_report.h"
#include "workbench/cli/stopwatch.h"

#include <cstdio>

namespace tangent {

int run_without_command() {
  constexpr int kTicks = 20000;
  SolveReport report;
  const Stopwatch loading;
  const Result<std::shared_ptr<const ContactScene>> scene = builtin_scene();
  if (!scene) {
    print_message("", scene.error().message());
    return kFailed;
  }
  const std::vector<TickInput> poses = builtin_poses(report.preset.preset.finger.radius_m, kTicks);
  report.mesh = &(*scene)->mesh();
  report.poses = poses.size();
  report.load_seconds = loading.seconds();
  const Stopwatch solving;
  Stepper stepper(*scene);
  TickState state;
  for (const TickInput& input : poses) {
    const Stopwatch watch;
    const TickOutput output = stepper.step(report.preset.preset, input, state);
    report.statistics.add(report.preset.preset, input, output, watch.nanoseconds());
  }
  report.solve_seconds = solving.seconds();
  report.scene_bytes = (*scene)->memory_bytes();
  std::fputs(
      ("The built-in scene, 0.1 m/s, 1 mm deep (workbench --help lists what else there is)\n" + solve_text(report))
          .c_str(),
      stdout);
  return kDone;
}

}  // namespace tangent

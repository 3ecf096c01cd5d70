// Solves a file of finger poses on a mesh: solve_poses MESH PRESET POSES TICKS [MM]. Both CSV files are those of
// `workbench solve`, and so are the values, bit for bit. MM: the mesh's longest side becomes this long.
#include <tangent/tangent.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

tangent::Status solve(const std::string& mesh, const std::string& preset_file, const std::string& poses_file,
                      const std::string& ticks_file, const tangent::SceneOptions& options) {
  const auto scene = tangent::load_scene(mesh, options);
  if (!scene) return tl::unexpected(scene.error());
  const auto preset = tangent::read_preset(preset_file);
  if (!preset) return tl::unexpected(preset.error());
  const auto poses = tangent::read_poses(poses_file);
  if (!poses) return tl::unexpected(poses.error());
  auto file = tangent::TicksFile::create(ticks_file);
  if (!file) return tl::unexpected(file.error());

  tangent::Stepper stepper(*scene);
  tangent::TickState state;  // of one finger, from pose to pose
  tangent::TickRow row;
  double all_ns = 0.0;
  for (const tangent::TickInput& pose : *poses) {
    const Clock::time_point began = Clock::now();
    row.output = stepper.step(*preset, pose, state);
    row.solve_ns = std::chrono::duration<double, std::nano>(Clock::now() - began).count();
    row.t_s = pose.t_s;
    if (const tangent::Status written = file->append(row); !written) return written;
    all_ns += row.solve_ns;
    ++row.tick;
  }
  if (const tangent::Status done = file->commit(); !done) return done;  // now it is there, whole
  std::printf("%zu poses, %.0f ns each\n", poses->size(), all_ns / static_cast<double>(poses->size()));
  return {};
}

}  // namespace

int main(int count, char** words) {
  if (count < 5) {
    std::fprintf(stderr, "solve_poses MESH PRESET POSES TICKS [MM]\n");
    return 2;
  }
  tangent::SceneOptions options;  // a mesh in millimetres, every part built
  if (count > 5) options.mesh.fit_m = std::atof(words[5]) / 1e3;
  const tangent::Status done = solve(words[1], words[2], words[3], words[4], options);
  if (!done) std::fprintf(stderr, "solve_poses: %s\n", done.error().message().c_str());
  return done ? 0 : 1;
}

#include "core/io/atomic_file.h"
#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "workbench/bench/case_paths.h"
#include "workbench/bench/measure.h"
#include "workbench/session/own_folder.h"
#include "workbench/session/two_threads.h"

#include <cstring>

namespace tangent::bench {
namespace {

constexpr double kBallRadius = 0.040, kBallSpeed = 0.020, kBallPress = 1e-3;

double seconds_since(std::int64_t start) { return 1e-9 * static_cast<double>(TickClock::now() - start); }

/// Binary little-endian PLY without normals, so that reading it includes computing them.
Status write_ply(const PolygonMesh& mesh, const std::filesystem::path& path) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(mesh.face_count()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto append = [&text](const void* data, std::size_t size) {
    text.append(static_cast<const char*>(data), size);
  };
  for (const Vec3& p : mesh.positions) append(&p.x, 3 * sizeof(double));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    text.push_back(static_cast<char>(mesh.face(f).size()));
    append(mesh.face(f).data(), mesh.face(f).size_bytes());
    if (text.size() < 1u << 20) continue;
    if (Status status = file->write(text); !status) return status;
    text.clear();
  }
  if (Status status = file->write(text); !status) return status;
  return file->commit();
}

Result<ScenePtr> load_icosphere(int subdivisions, LoadReport& load) {
  const Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return tl::unexpected(folder.error());
  const std::filesystem::path file = folder->path() / "ball.ply";
  std::int64_t start = TickClock::now();
  {
    const PolygonMesh generated = make_icosphere(kBallRadius, subdivisions);
    load.generate_s = seconds_since(start);
    if (Status status = write_ply(generated, file); !status) return tl::unexpected(status.error());
  }
  start = TickClock::now();
  Result<PolygonMesh> source = read_mesh(file, 1.0);
  if (!source) return tl::unexpected(source.error());
  load.read_s = seconds_since(start);
  start = TickClock::now();
  Result<ContactMesh> mesh = ContactMesh::build(*source, {}, run_on_two_threads);
  if (!mesh) return tl::unexpected(mesh.error());
  load.mesh_s = seconds_since(start);
  start = TickClock::now();
  Result<ScenePtr> scene = ContactScene::build(std::move(*mesh), {}, run_on_two_threads);
  load.structures_s = seconds_since(start);
  return scene;
}

/// Jumps to another place of the ball every tick: the cost of finding a contact. There are too many places for one pass
/// to warm the caches for the next.
RunStatistics measure_reseeding(const ScenePtr& scene, const Preset& preset, const MeasureOptions& options,
                                const TickClock& clock) {
  const Vec3 origin = scene->mesh().origin();
  const double distance = kBallRadius + preset.finger.radius_m - kBallPress;
  std::vector<TickInput> poses = random_in_cube(Vec3(0.0), 1.0, std::min(options.ticks, 4000));
  for (TickInput& pose : poses) pose.finger.position = origin + distance * unit(pose.finger.position);
  const TimedRun run = timed_run(scene, preset, poses, options.repeats, clock, options.stop);
  return run_statistics(std::span(poses).first(run.outputs.size()), run.outputs, run.ns);
}

}  // namespace

Status measure_scale(std::uint32_t most_triangles, const MeasureOptions& options, const TickClock& clock,
                     const std::function<void(SceneReport)>& done) {
  MeasureOptions once = options;
  once.repeats = 1;
  for (int subdivisions = 3; subdivisions <= 9; ++subdivisions) {
    const std::uint32_t triangles = 20u << (2 * subdivisions);
    if (triangles > most_triangles || options.stop()) return {};
    BenchCase c;
    c.name = "icosphere_" + std::to_string(triangles);
    c.what = "radius 40 mm, finger 20 mm at 20 mm/s, read from a PLY file";
    c.preset.finger.radius_m = 0.020;
    LoadReport load;
    const Result<ScenePtr> scene = load_icosphere(subdivisions, load);
    if (!scene) return tl::unexpected(scene.error());
    const auto poses = around_ball((*scene)->mesh().origin(), kBallRadius + c.preset.finger.radius_m - kBallPress,
                                   kBallSpeed, options.ticks);
    std::optional<SceneReport> report = measure_scene("scale", c, *scene, poses, once, clock);
    if (!report) return {};
    report->load = load;
    report->reseeding = measure_reseeding(*scene, c.preset, options, clock);
    if (options.stop()) return {};
    done(std::move(*report));
  }
  return {};
}

}  // namespace tangent::bench

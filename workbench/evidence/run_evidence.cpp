#include "workbench/evidence/run_evidence.h"

#include "core/io/file_name.h"
#include "core/io/pose_file.h"
#include "core/io/scene_file.h"
#include "workbench/evidence/made_mesh.h"
#include "workbench/evidence/measure_motion.h"
#include "workbench/recording/build_identity.h"
#include "workbench/recording/byte_stream.h"
#include "workbench/recording/recording.h"
#include "workbench/session/exploration_poses.h"

#include <system_error>
#include <vector>

namespace tangent {
namespace {

using ScenePointer = std::shared_ptr<const ContactScene>;
using Motion = std::vector<TickInput>;

/// A path that the evidence names, for one more reading: pipes and devices are none of those.
Result<std::filesystem::path> readable_again(const std::string& named, const EvidenceOptions& options) {
  const std::filesystem::path path = options.folder / file_named(named);
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return path;
  const bool there = std::filesystem::exists(path, error);
  return fail(there ? "is no file that can be read again" : "is not there", file_name_text(path),
              "put it back, or attach the evidence again");
}

Result<ScenePointer> made_scene(const MadeMesh& made, const ContactMeshOptions& options) {
  const Result<PolygonMesh> source = generate_mesh(made.object, made.options);
  if (!source) return tl::unexpected(source.error());
  Result<ContactMesh> mesh = ContactMesh::build(*source, options);
  if (!mesh) return tl::unexpected(mesh.error());
  return ContactScene::build(std::move(*mesh));
}

/// Scene of a recording at one of its ticks.
Result<ScenePointer> recorded_scene(const PresetEvidence& evidence, const EvidenceOptions& options) {
  const auto path = readable_again(evidence.motion.file, options);
  if (!path) return tl::unexpected(path.error());
  Result<Recording> recording = Recording::open(*path);
  if (!recording) return tl::unexpected(recording.error());
  if (recording->scenes().size() != 1)
    return fail("has " + std::to_string(recording->scenes().size()) + " meshes, evidence has one",
                file_name_text(*path), "record with one mesh");
  return recording->scene(recording->scenes().front().id);
}

Result<ScenePointer> find_scene(const PresetEvidence& evidence, const EvidenceOptions& options) {
  const EvidenceMesh& mesh = evidence.mesh;
  if (mesh.source.empty()) return recorded_scene(evidence, options);
  if (const auto made = made_from(mesh.source)) return made_scene(*made, mesh.options);
  const auto path = readable_again(mesh.source, options);
  if (!path) return tl::unexpected(path.error());
  return load_scene(*path, {mesh.metres_per_unit, mesh.options, {}});
}

Result<Motion> made_motion(const PresetEvidence& evidence, const ContactScene& scene) {
  if (scene.planar() != nullptr)
    return fail("the program makes no motion over a 2D scene", "about.measured", "name a pose file");
  if (evidence.motion.version != kExplorationVersion)
    return fail("this program makes version " + std::to_string(kExplorationVersion) + " of the motion",
                "about.measured", "check with the program that measured, or attach the evidence again");
  const bool around = evidence.motion.kind == MotionKind::around;
  auto explored =
      exploration_poses(scene, evidence.values.finger, around ? ExplorationKind::around : ExplorationKind::strokes,
                        ExplorationPace::varied);
  if (!explored) return tl::unexpected(explored.error());
  return std::move(explored->poses);
}

Result<Motion> recorded_motion(const EvidenceMotion& named, const EvidenceOptions& options) {
  const auto path = readable_again(named.file, options);
  if (!path) return tl::unexpected(path.error());
  Result<Recording> recording = Recording::open(*path);
  if (!recording) return tl::unexpected(recording.error());
  constexpr double kMostTicks = 1e15;  // a double counts them
  if (named.last_tick < named.first_tick || named.last_tick > kMostTicks)
    return fail("its ticks go from first to last", "about.measured", "attach the evidence again");
  Result<TickReader> ticks =
      recording->ticks(static_cast<std::uint64_t>(named.first_tick), static_cast<std::uint64_t>(named.last_tick));
  if (!ticks) return tl::unexpected(ticks.error());
  Motion motion;
  RecordedTick tick;
  while (options.keep_going()) {
    const Result<bool> more = ticks->next(tick);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    motion.push_back(tick.record.tick.input);
    motion.back().unready = false;  // here every part of the mesh is built
  }
  if (motion.empty()) return fail("has none of the ticks", file_name_text(*path), "attach the evidence again");
  return motion;
}

Result<Motion> find_motion(const PresetEvidence& evidence, const ContactScene& scene, const EvidenceOptions& options) {
  switch (evidence.motion.kind) {
    case MotionKind::poses: {
      const auto path = readable_again(evidence.motion.file, options);
      if (!path) return tl::unexpected(path.error());
      return read_poses(*path);
    }
    case MotionKind::recording:
      return recorded_motion(evidence.motion, options);
    default:
      return made_motion(evidence, scene);
  }
}

/// The last tick of a recording, where the evidence names none.
Status fill_ticks(EvidenceMotion& motion, const EvidenceOptions& options) {
  if (motion.kind != MotionKind::recording || motion.last_tick > 0.0) return {};
  const auto path = readable_again(motion.file, options);
  if (!path) return tl::unexpected(path.error());
  const Result<Recording> recording = Recording::open(*path);
  if (!recording) return tl::unexpected(recording.error());
  motion.first_tick = static_cast<double>(recording->info().first_tick);
  motion.last_tick = static_cast<double>(recording->info().last_tick);
  return {};
}

/// Names the mesh by the command that its file says made it, if that gives the mesh.
void prefer_made(EvidenceMesh& mesh, const EvidenceOptions& options) {
  if (mesh.source.empty() || made_from(mesh.source)) return;
  const std::string command = made_text_of(options.folder / file_named(mesh.source));
  const auto made = made_from(command);
  if (!made) return;
  const Result<ScenePointer> scene = made_scene(*made, mesh.options);
  const Result<ScenePointer> file =
      load_scene(options.folder / file_named(mesh.source), {mesh.metres_per_unit, mesh.options, {}});
  if (!scene || !file || scene_hash(**scene) != scene_hash(**file)) return;
  mesh.source = command;
  mesh.metres_per_unit = EvidenceMesh().metres_per_unit;
}

}  // namespace

std::string motion_digest(std::span<const TickInput> motion) {
  ByteWriter writer;
  for (const TickInput& input : motion) {
    writer.all(input.t_s, input.finger.position, input.finger.orientation);
    if (input.velocity) writer(*input.velocity);
  }
  return hex_text(hash_of(writer.take()));
}

std::string evidence_build() {
  std::string build = build_identity();
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma")) build += ", fma";
#endif
  return build;
}

std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto whole = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const std::filesystem::path from = whole(folder.empty() ? "." : folder);
  return file_name_text(whole(file).lexically_proximate(from));
}

Result<std::optional<EvidenceRun>> run_evidence(const PresetEvidence& evidence, const Preset& preset,
                                                const EvidenceOptions& options) {
  const Result<ScenePointer> scene = find_scene(evidence, options);
  if (!scene) return tl::unexpected(scene.error());
  if (!options.keep_going()) return std::optional<EvidenceRun>();
  const Result<Motion> motion = find_motion(evidence, **scene, options);
  if (!motion) return tl::unexpected(motion.error());
  const auto numbers = measure_motion(*scene, preset, *motion, options.timed, options.keep_going);
  if (!numbers) return std::optional<EvidenceRun>();
  return std::optional(EvidenceRun{scene_hash(**scene), motion_digest(*motion), *numbers});
}

Result<std::optional<PresetEvidence>> measure_evidence(PresetEvidence asked, const EvidenceOptions& options) {
  const bool made = asked.motion.kind == MotionKind::around || asked.motion.kind == MotionKind::strokes;
  if (made) asked.motion.version = kExplorationVersion;
  if (Status status = fill_ticks(asked.motion, options); !status) return tl::unexpected(status.error());
  prefer_made(asked.mesh, options);
  const auto run = run_evidence(asked, asked.values, options);
  if (!run) return tl::unexpected(run.error());
  if (!*run) return std::optional<PresetEvidence>();
  asked.program_version = TANGENT_VERSION;
  asked.build = evidence_build();
  asked.mesh.hash = (*run)->mesh_hash;
  asked.motion.digest = (*run)->motion_digest;
  asked.numbers = (*run)->numbers;
  return std::optional(std::move(asked));
}

}  // namespace tangent

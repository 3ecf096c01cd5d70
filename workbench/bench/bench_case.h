// One benchmark scene: a mesh, a finger and its path over the mesh, named after what it shows.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/tick/step.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tangent::bench {

using ScenePtr = std::shared_ptr<const ContactScene>;

struct BenchCase {
  std::string name;
  std::string what;  ///< one line: what it is, or what is hard about it
  std::function<Result<PolygonMesh>()> mesh;
  ContactMeshOptions options;
  Preset preset;           ///< finger and tolerance; the method is set by whoever runs it
  bool own_gains = false;  ///< `paper` runs with the preset's gains; otherwise with the best G_k found for the case
  /// One pose a millisecond, `ticks` of them; the same arguments give the same poses.
  std::function<Result<std::vector<TickInput>>(const ContactScene&, const Finger&, int ticks)> poses;
};

/// The paper's objects, rounded by 1.5 mm and sharp, and the icosphere of 320 triangles; a 20 mm sphere finger pressed
/// about 1 mm deep moves at 0.1 m/s.
std::vector<BenchCase> paper_cases();

/// The paper's seven objects, rounded, stroked as its participants did (stroke_path.h) at 0.1 m/s, 1 mm deep, by a 20
/// mm finger with G_o 1 and G_k 19 mm, the height of its centre over the surface.
std::vector<BenchCase> stroke_cases();

/// Generated hard cases.
std::vector<BenchCase> hard_cases();

/// Balls of 40 mm with 1,280, 20,480 and 327,680 triangles, a point, a 5 mm and a 20 mm sphere 1 mm deep at 0.1 m/s:
/// where the mean of a tick is compared with that of a bounded nearest-point query.
std::vector<BenchCase> mean_cases();

/// Every pose file of `poses` (NAME-rXXX.csv, XXX: finger radius, mm) on its mesh (`meshes`/NAME.obj, fitted to 80 mm),
/// with creases at 180 and at 45 degrees. All poses are used whatever the number of ticks asked for.
Result<std::vector<BenchCase>> shared_cases(const std::filesystem::path& meshes, const std::filesystem::path& poses);

Result<ScenePtr> build_scene(const BenchCase& bench_case);

}  // namespace tangent::bench

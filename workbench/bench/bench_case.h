// One scene of the benchmark: a mesh, a finger and its way over it, named after what it shows.
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
  std::string what;  ///< one line: what is hard about it, or what it is
  std::function<Result<PolygonMesh>()> mesh;
  ContactMeshOptions options;
  Preset preset;  ///< finger and tolerance; the method is set by whoever runs it
  /// One pose a millisecond, `ticks` of them; the same arguments give the same poses.
  std::function<Result<std::vector<TickInput>>(const ContactScene&, const Finger&, int ticks)> poses;
};

/// The paper's objects, rounded by 1.5 mm and sharp, and the icosphere of 320 triangles; a 20 mm sphere finger pressed
/// about 1 mm deep moves at 0.1 m/s.
std::vector<BenchCase> paper_cases();

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

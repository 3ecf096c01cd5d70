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
  Preset preset;  ///< finger and tolerance; measure_scene sets the method
  /// `ticks` poses, 1 ms apart. Deterministic.
  std::function<Result<std::vector<TickInput>>(const ContactScene&, const Finger&, int ticks)> poses;
};

/// The paper's objects, rounded by 1.5 mm and sharp, and the icosphere of 320 triangles; a 20 mm sphere finger pressed
/// about 1 mm deep moves at 0.1 m/s.
std::vector<BenchCase> paper_cases();

/// Generated hard cases.
std::vector<BenchCase> hard_cases();

/// Every pose file of `poses` (NAME-rXXX.csv, XXX: finger radius, mm) on its mesh (`meshes`/NAME.obj, fitted to 80 mm),
/// with creases at 180 and at 45 degrees. All poses are used whatever the number of ticks asked for.
Result<std::vector<BenchCase>> shared_cases(const std::filesystem::path& meshes, const std::filesystem::path& poses);

Result<ScenePtr> build_scene(const BenchCase& bench_case);

}  // namespace tangent::bench

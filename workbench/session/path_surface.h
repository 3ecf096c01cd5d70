// What an exploration path is shrunk onto: the mesh itself, or of a large one some of its triangles, evenly spread. A
// path needs tens of thousands of queries all over the mesh, which on millions of triangles take seconds and build
// search structures where no finger may ever come.
#pragma once

#include "core/tick/scene.h"

#include <memory>

namespace tangent {

/// One triangle of every cell of a grid, and all that are longer than a cell. A distance to them is that to the mesh
/// but for d^2 / (2 distance), d the size of a cell: on an 80 mm body 10 um with a finger of 20 mm.
/// Local coordinates of `mesh`. The same bits however `run_both` does its work.
PolygonMesh spread_triangles(const ContactMesh& mesh, const RunBoth& run_both = run_in_turn);

class PathSurface {
 public:
  /// `scene` must outlive it.
  explicit PathSurface(const ContactScene& scene);

  /// Of the scene's mesh, local coordinates of that: of its triangles only the point and the distance.
  NearestHit nearest(const Vec3& query) const;
  /// Sum of area vectors over the sum of areas: about zero for a closed mesh, of about 1 for a sheet.
  Vec3 mean_normal() const;

 private:
  const ContactScene& scene_;
  std::unique_ptr<const ContactMesh> few_;  ///< of a large mesh
  std::unique_ptr<const NearestTriangles> of_few_;
};

}  // namespace tangent

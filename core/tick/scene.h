// What a tick works on besides its preset: the surface and the structures that searches read.
#pragma once

#include "core/contact/search/search_structures.h"
#include "core/mesh/contact_mesh.h"
#include "core/planar/curve.h"

#include <memory>

namespace tangent {

/// Mesh and query structures. Immutable; share it freely.
class ContactScene {
 public:
  static Result<std::shared_ptr<const ContactScene>> build(ContactMesh mesh);
  /// A 2D scene. Its mesh is a ribbon along the polygon, for views; contacts are the curve's (planar_step.h).
  static Result<std::shared_ptr<const ContactScene>> build(PlanarCurve curve);
  const PlanarCurve* planar() const { return planar_.get(); }  ///< null: a 3D scene
  const ContactMesh& mesh() const { return mesh_; }
  const NearestTriangles& nearest() const { return *nearest_; }
  const ContactHierarchy& hierarchy() const { return hierarchy_; }
  SearchStructures search() const { return {*nearest_, hierarchy_}; }
  std::size_t memory_bytes() const;

 private:
  explicit ContactScene(ContactMesh mesh) : mesh_(std::move(mesh)) {}
  static Result<std::shared_ptr<const ContactScene>> with_queries(std::shared_ptr<ContactScene> scene);
  ContactMesh mesh_;
  std::unique_ptr<NearestTriangles> nearest_;
  ContactHierarchy hierarchy_;
  std::unique_ptr<const PlanarCurve> planar_;
};

}  // namespace tangent

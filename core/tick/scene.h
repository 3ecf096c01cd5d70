// What a tick works on besides its preset: the surface and the structures that searches read.
#pragma once

#include "core/base/built_once.h"
#include "core/contact/search/search_structures.h"
#include "core/mesh/contact_mesh.h"
#include "core/planar/curve.h"
#include "core/preset/preset.h"

#include <functional>
#include <memory>
#include <optional>

namespace tangent {

/// Which parts of a scene are built with it. A servo needs all that its ticks may read, since a tick builds nothing in
/// time; a run of known presets needs no more than those read.
struct SceneParts {
  bool hierarchy = true;  ///< 3D: read by smooth contacts alone; without, the first of them builds it
  bool ribbon = true;     ///< 2D: the mesh along the polygon, for views and paths over it; ticks never read it
};
/// What ticks under this preset read.
SceneParts parts_for(const Preset& preset);

/// Does both, in any order or at once; returns when both are done.
using RunBoth = std::function<void(const std::function<void()>&, const std::function<void()>&)>;
inline void run_in_turn(const std::function<void()>& a, const std::function<void()>& b) { a(), b(); }

/// Mesh and query structures. Immutable to those who use it; share it freely.
class ContactScene {
 public:
  /// The two structures of a mesh are built by `run_both`, the same bits however it does that.
  static Result<std::shared_ptr<const ContactScene>> build(ContactMesh mesh, const SceneParts& parts = {},
                                                           const RunBoth& run_both = run_in_turn);
  /// A 2D scene. Its mesh is a ribbon along the polygon, for views; contacts are the curve's (planar_contacts.h).
  static Result<std::shared_ptr<const ContactScene>> build(PlanarCurve curve, const SceneParts& parts = {});
  const PlanarCurve* planar() const { return planar_.get(); }  ///< null: a 3D scene
  /// Precondition, here and below: a 3D scene, or one with its ribbon.
  const ContactMesh& mesh() const { return *mesh_; }
  const NearestTriangles& nearest() const { return *nearest_; }
  /// Built now where it isn't yet, by any thread.
  const ContactHierarchy& hierarchy() const {
    return hierarchy_.get([this] { return ContactHierarchy::build(*mesh_); });
  }
  bool has_hierarchy() const { return hierarchy_.if_built() != nullptr; }
  bool has_mesh() const { return mesh_.has_value(); }  ///< false: a 2D scene without its ribbon
  SearchStructures search() const { return {*nearest_, hierarchy()}; }
  std::size_t memory_bytes() const;  ///< of what is built

 private:
  ContactScene() = default;
  std::optional<ContactMesh> mesh_;
  std::unique_ptr<NearestTriangles> nearest_;
  BuiltOnce<ContactHierarchy> hierarchy_;
  std::unique_ptr<const PlanarCurve> planar_;
};

}  // namespace tangent

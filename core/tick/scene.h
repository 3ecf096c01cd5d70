// What a tick works on besides its preset: the surface and the structures that searches read.
#pragma once

#include "core/base/built_once.h"
#include "core/base/run_both.h"
#include "core/contact/search/search_structures.h"
#include "core/mesh/contact_mesh.h"
#include "core/planar/curve.h"
#include "core/preset/preset.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace tangent {

/// Which parts of a scene are built with it. A servo needs all that its ticks may read, since a tick builds nothing in
/// time; a run of known presets needs no more than those read.
struct SceneParts {
  bool hierarchy = true;  ///< 3D: read by smooth contacts alone; without, the first of them builds it
  bool ribbon = true;     ///< 2D: the mesh along the polygon, for views and paths over it; ticks never read it
  /// Of a large mesh the parts of both search structures that no tick has come to: left to those that will.
  bool far_parts = true;
  /// 3D: triangles of the largest mesh whose structures are built as a whole: with Embree, and one hierarchy. Those of
  /// larger ones are built in parts, but for those with flat regions (mesh/flat_regions.h), which are asked for as one.
  std::uint32_t whole_up_to = 1u << 19;
};
/// What ticks under this preset read.
SceneParts parts_for(const Preset& preset);

/// Mesh and query structures. Immutable to those who use it; share it freely.
class ContactScene {
 public:
  /// Whether a mesh is large enough to be searched in parts. Building such a scene can't fail.
  static bool is_in_parts(const ContactMesh& mesh, const SceneParts& parts);
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
  const LateHierarchy& hierarchy() const {
    return hierarchy_.get([this] { return LateHierarchy(*mesh_, clusters_.get()); });
  }
  bool has_hierarchy() const { return hierarchy_.if_built() != nullptr; }
  /// Of a large mesh, those of both structures that are not built yet. Ticks build what they come to, but where their
  /// thread makes nothing (MakesNothing): there they come to nothing.
  std::size_t unbuilt_parts() const;
  /// Builds those that most ticks come to with a finger of this reach there, and up to `ahead_m` further: a search for
  /// a start, or one far ahead, may come to more. Below zero: fewer, for one tick. World frame. Here and below: any
  /// thread, beside ticks if need be.
  void build_near(const Vec3& position, double reach_m, const RunBoth& run_both = run_in_turn,
                  double ahead_m = 0.0) const;
  /// Builds the nearest one; false: there was none left. World frame.
  bool build_next_part(const Vec3& position) const;
  /// Builds them all.
  void build_far_parts(const RunBoth& run_both) const;
  bool has_mesh() const { return mesh_.has_value(); }  ///< false: a 2D scene without its ribbon
  SearchStructures search() const { return {*nearest_, hierarchy()}; }
  std::size_t memory_bytes() const;  ///< of what is built

 private:
  ContactScene() = default;
  Status build_structures(const SceneParts& parts, const RunBoth& run_both);
  bool has_part(std::size_t part) const;
  void build_part(std::size_t part) const;
  void build_parts(std::span<const std::uint32_t> parts, const RunBoth& run_both) const;

  std::optional<ContactMesh> mesh_;
  std::unique_ptr<const TriangleClusters> clusters_;  ///< of a large mesh
  std::unique_ptr<NearestTriangles> nearest_;
  BuiltOnce<LateHierarchy> hierarchy_;
  std::unique_ptr<const PlanarCurve> planar_;
};

}  // namespace tangent

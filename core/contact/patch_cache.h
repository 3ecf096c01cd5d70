// Patches of the triangles the contact lately walked over, built when a triangle is entered, and the edges it was on.
// What is held grows with the contact, not with the mesh. A pure function of (mesh, normal form): a cold cache gives
// the same bits, later.
#pragma once

#include "core/contact/edge_fan.h"
#include "core/contact/face_outline.h"
#include "core/mesh/vertex_ring.h"
#include "core/surface/mesh_patch.h"
#include "core/surface/patch_curvature.h"

#include <array>
#include <memory>
#include <vector>

namespace tangent {

struct CachedPatch {
  bool flat;
  PatchFront front;
  PnPatch patch;
};

/// What a patch was built from.
struct PatchKey {
  std::uint32_t triangle = kNone;
  NormalForm form = NormalForm::bernstein;
  bool operator==(const PatchKey&) const = default;
};

/// How its patch bends: asked for oftener than what else is known of it.
struct CachedBend {
  PatchKey key;
  CurvatureBounds bend;
};

/// A crease or boundary edge, the fan at the place where it was asked for last, and what they were built from.
struct CachedFan {
  std::uint32_t triangle = kNone;
  std::uint32_t side = 0;
  NormalForm form = NormalForm::bernstein;
  double f = 0.0;
  FanEdge edge;
  EdgeFan fan;
};

/// The faces around a vertex, in the order of around_vertex, and the creases and boundaries that meet there, with their
/// samples and fans at it: what decides whether a contact rests on it, and stays the same while it does.
struct VertexSurroundings {
  static constexpr std::size_t kCapacity = 64;
  struct Face {
    std::uint32_t triangle = kNone, corner = 0;
    std::size_t rays_end = 0;  ///< its rays are those before this one and after the last face's
    SurfaceSample sample;
  };
  struct Ray {
    std::uint32_t triangle = kNone, side = 0;
    double f = 0.0;  ///< of the edge at the vertex: 0 where it starts there, 1 where it ends there
    EdgeFan fan;
  };
  std::uint32_t triangle = kNone, corner = 0;  ///< that it was asked for by
  NormalForm form = NormalForm::bernstein;
  bool complete = false;  ///< false: more than kCapacity faces, and nothing is held
  std::size_t face_count = 0;
  std::array<Face, kCapacity> faces;
  std::array<Ray, kCapacity + 1> rays;
};

class PatchCache {
 public:
  explicit PatchCache(const ContactMesh& mesh)
      : mesh_(&mesh),
        held_(kPatches),
        patches_(std::make_unique_for_overwrite<CachedPatch[]>(kPatches)),
        outlined_(kOutlines),
        outlines_(std::make_unique_for_overwrite<FaceOutline[]>(kOutlines)),
        bends_(kBends),
        is_large_(mesh.triangle_count() > kLarge) {}

  const ContactMesh& mesh() const { return *mesh_; }

  /// Patch of triangle `t`. The reference is good until the next call.
  const PnPatch& patch(std::uint32_t t, NormalForm form) { return patch_slot(t, form).patch; }
  /// Its sample at (u, v): most of a polyhedron is flat, where it takes no evaluation.
  void sample(std::uint32_t t, NormalForm form, double u, double v, SurfaceSample& sample) {
    const CachedPatch& slot = patch_slot(t, form);
    if (slot.flat) {
      evaluate_flat(slot.patch, u, v, sample);
    } else {
      evaluate(slot.patch, u, v, sample);
    }
  }
  /// How its patch bends, away from creases and boundaries; unknown beside them.
  const CurvatureBounds& bend(std::uint32_t t, NormalForm form) {
    CachedBend& slot = bends_[t % kBends];
    if (slot.key != PatchKey{t, form}) slot = {{t, form}, bend_of(t, form)};
    return slot.bend;
  }
  /// Whether its patch keeps its front, once that is asked. Good until the next call for another triangle.
  PatchFront& front(std::uint32_t t, NormalForm form) { return patch_slot(t, form).front; }
  /// Good until the next call for another triangle.
  const FaceOutline& outline(std::uint32_t t, NormalForm form) {
    const std::uint32_t slot = t % kOutlines;
    if (outlined_[slot] != PatchKey{t, form}) {
      outlined_[slot] = {t, form};
      outlines_[slot] = face_outline(*mesh_, t, form);
    }
    return outlines_[slot];
  }
  /// Says that the contact is on triangle `t`, once at a tick's beginning and once at its end: on a large mesh the
  /// triangles beside it and those beside them, which it goes to next, come from the processor's slow memory, so they
  /// are asked for before.
  void expect_around(std::uint32_t t) {
    if (is_large_ && t != kNone && (t != around_ || asked_ < 2)) ask_around(t);
  }
  /// Fan at fraction f of edge `side` of triangle `t`, which runs from corner `side` to the next. Precondition: not a
  /// smooth edge. The reference is good until the next call.
  const EdgeFan& fan(std::uint32_t t, std::uint32_t side, double f, NormalForm form) {
    return cached_fan(t, side, f, form).fan;
  }
  /// The same, to be moved along its edge.
  CachedFan& cached_fan(std::uint32_t t, std::uint32_t side, double f, NormalForm form) {
    CachedFan& slot = fans_[(3 * t + side) % kSlots];
    const bool same_edge = slot.triangle == t && slot.side == side && slot.form == form;
    if (!same_edge) fill(slot, t, side, form);
    if (!same_edge || slot.f != f) move(slot, f);
    return slot;
  }
  static void move(CachedFan& slot, double f) {
    move_fan(slot.edge, f, slot.fan);
    slot.f = f;
  }
  /// Visits the faces around the vertex at `corner` of triangle `t`, on_face(triangle, corner, sample), and after each
  /// those creases and boundaries that are its, on_ray(triangle, side, f, fan): every one once. For few enough faces
  /// that is all from what was kept of the last time.
  /// Of a crowded vertex only those that matter to a vector from it, `direction(normal)` (around_vertex_towards).
  template <class Direction, class OnFace, class OnRay>
  void around(std::uint32_t t, std::uint32_t corner, NormalForm form, Direction direction, OnFace on_face,
              OnRay on_ray) {
    if (mesh_->crowded_vertex(mesh_->vertex(t, corner)))
      return compute_around(t, corner, form, direction, on_face, on_ray);
    if (vertex_.triangle != t || vertex_.corner != corner || vertex_.form != form) fill(vertex_, t, corner, form);
    if (!vertex_.complete) return compute_around(t, corner, form, direction, on_face, on_ray);
    std::size_t r = 0;
    for (std::size_t i = 0; i < vertex_.face_count; ++i) {
      const VertexSurroundings::Face& face = vertex_.faces[i];
      on_face(face.triangle, face.corner, face.sample);
      for (; r < face.rays_end; ++r)
        on_ray(vertex_.rays[r].triangle, vertex_.rays[r].side, vertex_.rays[r].f, vertex_.rays[r].fan);
    }
  }

 private:
  /// Direct-mapped. A contact revisits the few triangles around it, a search those of the last one: on rough ground
  /// hundreds.
  static constexpr std::uint32_t kPatches = 512, kOutlines = 1024, kBends = 1024, kSlots = 16;
  CachedPatch& patch_slot(std::uint32_t t, NormalForm form) {
    const std::uint32_t slot = t % kPatches;
    if (held_[slot] != PatchKey{t, form}) fill(slot, t, form);
    return patches_[slot];
  }
  void ask_around(std::uint32_t t);
  void fill(std::uint32_t slot, std::uint32_t t, NormalForm form);
  CurvatureBounds bend_of(std::uint32_t t, NormalForm form);
  void fill(CachedFan& slot, std::uint32_t t, std::uint32_t side, NormalForm form);
  void fill(VertexSurroundings& vertex, std::uint32_t t, std::uint32_t corner, NormalForm form);
  template <class Direction, class OnFace, class OnRay>
  void compute_around(std::uint32_t t, std::uint32_t corner, NormalForm form, Direction direction, OnFace on_face,
                      OnRay on_ray);

  const ContactMesh* mesh_;
  std::vector<PatchKey> held_;
  std::unique_ptr<CachedPatch[]> patches_;  ///< as held_ says
  std::vector<PatchKey> outlined_;
  std::unique_ptr<FaceOutline[]> outlines_;  ///< as outlined_ says
  std::vector<CachedBend> bends_;
  std::array<CachedFan, kSlots> fans_;
  VertexSurroundings vertex_;
  static constexpr std::uint32_t kLarge = 1u << 16;  ///< triangles that no fast memory holds: some 5 MB
  bool is_large_;
  std::uint32_t around_ = kNone;
  /// 1: for the far corners of the triangles beside that one, and the numbers of those beside them; 2: for the far
  /// corners of these, too.
  int asked_ = 0;
};

template <class Direction, class OnFace, class OnRay>
void PatchCache::compute_around(std::uint32_t t, std::uint32_t corner, NormalForm form, Direction direction,
                                OnFace on_face, OnRay on_ray) {
  around_vertex_towards(*mesh_, t, corner, direction, [&](std::uint32_t at, std::uint32_t k) {
    SurfaceSample there;
    sample(at, form, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, there);
    on_face(at, k, there);
    if (mesh_->edge_kind(at, k) != EdgeKind::smooth) on_ray(at, k, 0.0, fan(at, k, 0.0, form));
    const std::uint32_t ending = (k + 2) % 3;  // lies beyond nothing: no other face has it as the one that starts here
    if (mesh_->edge_kind(at, ending) == EdgeKind::boundary) on_ray(at, ending, 1.0, fan(at, ending, 1.0, form));
  });
}

}  // namespace tangent

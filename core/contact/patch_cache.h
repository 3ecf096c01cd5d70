// Patches of the triangles the contact lately walked over, built when a triangle is entered, and the edges it was on. What is held
// grows with the contact, not with the mesh. A pure function of (mesh, normal form): a cold cache gives
// the same bits, later.
#pragma once

#include "core/contact/edge_fan.h"
#include "core/mesh/contact_mesh.h"
#include "core/surface/mesh_patch.h"

#include <array>

namespace tangent {

/// A patch and what it was built from.
struct CachedPatch {
  std::uint32_t triangle = kNone;
  NormalForm form = NormalForm::bernstein;
  PnPatch patch;
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

class PatchCache {
 public:
  explicit PatchCache(const ContactMesh& mesh) : mesh_(&mesh) {}

  const ContactMesh& mesh() const { return *mesh_; }

  /// Patch of triangle `t`. The reference is good until the next call.
  const PnPatch& patch(std::uint32_t t, NormalForm form) {
    CachedPatch& slot = slots_[t % kSlots];
    if (slot.triangle != t || slot.form != form) fill(slot, t, form);
    return slot.patch;
  }
  /// Fan at fraction f of edge `side` of triangle `t`, which runs from corner `side` to the next. Precondition: not a smooth
  /// edge. The reference is good until the next call.
  const EdgeFan& fan(std::uint32_t t, std::uint32_t side, double f, NormalForm form) {
    CachedFan& slot = fans_[(3 * t + side) % kSlots];
    const bool same_edge = slot.triangle == t && slot.side == side && slot.form == form;
    if (!same_edge) fill(slot, t, side, form);
    if (!same_edge || slot.f != f) move(slot, f);
    return slot.fan;
  }

 private:
  /// Direct-mapped. A contact revisits the few triangles around it.
  static constexpr std::uint32_t kSlots = 16;
  void fill(CachedPatch& slot, std::uint32_t t, NormalForm form);
  void fill(CachedFan& slot, std::uint32_t t, std::uint32_t side, NormalForm form);
  static void move(CachedFan& slot, double f);

  const ContactMesh* mesh_;
  std::array<CachedPatch, kSlots> slots_;
  std::array<CachedFan, kSlots> fans_;
};

}  // namespace tangent

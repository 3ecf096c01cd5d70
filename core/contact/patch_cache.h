// Patches of the triangles the contact lately walked over, built when a triangle is entered, and the edge it was on last. What is held
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

/// A fan and what it was built from.
struct CachedFan {
  std::uint32_t triangle = kNone;
  std::uint32_t edge = 0;
  double f = 0.0;
  NormalForm form = NormalForm::bernstein;
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
  CachedFan& last_fan() { return fan_; }

 private:
  /// Direct-mapped. A contact revisits the few triangles around it.
  static constexpr std::uint32_t kSlots = 16;
  void fill(CachedPatch& slot, std::uint32_t t, NormalForm form);

  const ContactMesh* mesh_;
  std::array<CachedPatch, kSlots> slots_;
  CachedFan fan_;
};

}  // namespace tangent

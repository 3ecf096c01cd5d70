// Patches of the triangles the contact lately walked over, built when a triangle is entered. What is held
// grows with the contact, not with the mesh. A pure function of (mesh, normal form): a cold cache gives
// the same bits, later.
#pragma once

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

 private:
  /// Direct-mapped. A contact revisits the few triangles around it.
  static constexpr std::uint32_t kSlots = 16;
  void fill(CachedPatch& slot, std::uint32_t t, NormalForm form);

  const ContactMesh* mesh_;
  std::array<CachedPatch, kSlots> slots_;
};

}  // namespace tangent

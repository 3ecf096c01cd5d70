#include "core/contact/patch_cache.h"

#include "core/base/tolerances.h"

namespace tangent {

void PatchCache::fill(std::uint32_t slot, std::uint32_t t, NormalForm form) {
  CachedPatch& cached = patches_[slot];
  cached.patch = make_patch(*mesh_, t, form);
  cached.flat = is_flat(cached.patch, kStraightEdge);
  cached.front = PatchFront{};
  held_[slot] = {t, form};
}

void PatchCache::ask_around(std::uint32_t t) {
  asked_ = t == around_ ? asked_ + 1 : 1;
  around_ = t;
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    const EdgeLink beside = mesh_->across(t, edge);
    if (beside.triangle == kNone) continue;
    if (asked_ == 1) mesh_->prefetch(beside.triangle, (beside.edge + 2) % 3);
    for (std::uint32_t on = 1; on < 3; ++on) {
      const EdgeLink next = mesh_->across(beside.triangle, (beside.edge + on) % 3);
      if (next.triangle == kNone) continue;
      if (asked_ == 1) {
        mesh_->prefetch(next.triangle);
      } else {
        mesh_->prefetch(next.triangle, (next.edge + 2) % 3);
      }
    }
  }
}

CurvatureBounds PatchCache::bend_of(std::uint32_t t, NormalForm form) {
  return mesh_->interior(t) ? curvature_bounds(patch(t, form)) : CurvatureBounds{};
}

void PatchCache::fill(CachedFan& slot, std::uint32_t t, std::uint32_t side, NormalForm form) {
  FanEdge& edge = slot.edge;
  const PnPatch& near = patch(t, form);
  edge.curve = edge_curve(near, side);
  edge.near = edge_normals(near, side);
  edge.chord = mesh_->position(t, (side + 1) % 3) - mesh_->position(t, side);
  edge.inwards = mesh_->position(t, (side + 2) % 3) - mesh_->position(t, side);
  const EdgeLink other = mesh_->across(t, side);
  edge.boundary = other.triangle == kNone;
  if (!edge.boundary) edge.far = reversed(edge_normals(patch(other.triangle, form), other.edge));
  prepare_fan(edge, slot.fan);
  slot.triangle = t;
  slot.side = side;
  slot.form = form;
}

void PatchCache::fill(VertexSurroundings& vertex, std::uint32_t t, std::uint32_t corner, NormalForm form) {
  vertex.triangle = t;
  vertex.corner = corner;
  vertex.form = form;
  vertex.complete = true;
  vertex.face_count = 0;
  std::size_t rays = 0;
  compute_around(
      t, corner, form, [](const Vec3&) { return Vec3(0.0); },
      [&](std::uint32_t at, std::uint32_t k, const SurfaceSample& sample) {
        if (vertex.face_count == VertexSurroundings::kCapacity) vertex.complete = false;
        if (vertex.complete) vertex.faces[vertex.face_count++] = {at, k, rays, sample};
      },
      [&](std::uint32_t at, std::uint32_t side, double f, const EdgeFan& fan) {
        if (rays == vertex.rays.size()) vertex.complete = false;
        if (!vertex.complete) return;
        vertex.rays[rays++] = {at, side, f, fan};
        vertex.faces[vertex.face_count - 1].rays_end = rays;
      });
}

}  // namespace tangent

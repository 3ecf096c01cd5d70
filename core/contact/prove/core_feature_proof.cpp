#include "core/contact/prove/core_feature_proof.h"

#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tangent {
namespace {

constexpr std::size_t kMostNormals = 24;  // around a vertex

struct Normals {
  std::array<Vec3, kMostNormals> all;
  std::size_t count = 0;
  bool complete = true;

  void add(const Vec3& n) {
    if (count == all.size()) complete = false;
    if (complete) all[count++] = n;
  }
  NormalCone cone() const {
    Vec3 sum(0.0);
    for (const Vec3& n : std::span(all).first(count)) sum += n;
    const double length2 = glm::dot(sum, sum);
    if (!complete || length2 < 1e-6) return {};
    NormalCone cone{sum / std::sqrt(length2), 1.0};
    for (const Vec3& n : std::span(all).first(count))
      cone.cos_half = std::min(cone.cos_half, glm::dot(n, cone.axis) / std::sqrt(glm::dot(n, n)));
    return cone;
  }
};

/// The three control normals along an edge, which runs from corner `edge` to the next.
void add_along(const PnPatch& patch, std::uint32_t edge, Normals& normals) {
  static constexpr ControlNormal kMiddle[3] = {n110, n011, n101};
  normals.add(patch.normals[edge]);
  normals.add(patch.normals[kMiddle[edge]]);
  normals.add(patch.normals[(edge + 1) % 3]);
}

/// By how far the part is outside the core: a contact there has p(N) - S = lambda N with |lambda| above that. Nor can
/// it be below -that where every plane of the part lies less deep in the finger; so the contact ranks behind it.
double margin_by_distance(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound) {
  const double cosine = part.normals.cos_half;
  const Vec3 to_part = part.middle - core.centre();
  const double distance2 = glm::dot(to_part, to_part);
  if (!(cosine > 0.1) || !(distance2 > 0.0)) return 0.0;
  const auto outside = [&](const Vec3& direction) {
    return glm::dot(to_part, direction) - glm::dot(part.half, glm::abs(direction)) - core.half_width(direction);
  };
  const Vec3 axis = part.normals.axis;
  const Vec3 sideways = to_part - glm::dot(to_part, axis) * axis;
  double apart = outside(to_part / std::sqrt(distance2));
  if (glm::dot(sideways, sideways) > 1e-6 * distance2) apart = std::max(apart, outside(unit(sideways)));
  if (!(apart > 0.0)) return 0.0;
  const double over = glm::dot(core.support(axis).point - part.middle, axis) - glm::dot(part.half, glm::abs(axis));
  const double clear = (apart + std::min(0.0, over) / cosine) / (1.0 + 1.0 / cosine);
  return std::max(0.0, std::min(clear, bound.way_to(core.reach_m() - core.ball_m() + apart)));
}

/// Once it is `enough_m`, no more is asked for.
double margin_of(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound, double enough_m) {
  const double apart = core.apart_m(part.middle, part.half);
  const double outside = core.rank_outside(apart);  // as far as it is over the reach the finger may go
  double margin = std::min(outside - core.reach_m(), bound.way_to(outside));
  const auto is_enough = [&] { return margin > 0.0 && margin >= enough_m; };
  if (!is_enough()) margin = std::max(margin, touch_margin(core, part, enough_m));
  if (!is_enough()) margin = std::max(margin, margin_by_distance(core, part, bound));
  return margin;
}

/// A crease by control points of its curve, then control normals of its near and of its far side.
struct Crease {
  std::array<Vec3, 4> curve;
  Normals normals;
};

Crease crease_of(PatchCache& cache, NormalForm form, std::uint32_t t, std::uint32_t k) {
  static constexpr ControlPoint kNear[3][2] = {{b210, b120}, {b021, b012}, {b102, b201}};
  const EdgeLink other = cache.mesh().across(t, k);
  Crease crease;
  const PnPatch& near = cache.patch(t, form);
  crease.curve = {near.control_point(k), near.control_point(kNear[k][0]), near.control_point(kNear[k][1]),
                  near.control_point((k + 1) % 3)};
  add_along(near, k, crease.normals);
  add_along(cache.patch(other.triangle, form), other.edge, crease.normals);
  return crease;
}

/// Whether the normals of its two sides part nowhere along it: no plane touches it from outside. Along the edge,
/// counterclockwise about its near side, the far normal leans to that side: (T x n).m is negative, a product of Bezier
/// forms.
bool is_hollow(const Crease& crease) {
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3 along = crease.curve[j + 1] - crease.curve[j];
    for (std::size_t near = 0; near < 3; ++near) {
      const Vec3 away = glm::cross(along, crease.normals.all[near]);
      for (std::size_t far = 3; far < 6; ++far)
        if (!(glm::dot(away, crease.normals.all[far]) < 0.0)) return false;
    }
  }
  return true;
}

double edge_margin(const Crease& crease, const FingerCore& core, const RankBound& bound, double enough_m) {
  Box box;
  for (const Vec3& p : crease.curve) box.include(p);
  return margin_of(core, {box.centre(), 0.5 * box.size(), crease.normals.cone()}, bound, enough_m);
}

/// Whether all creases that meet at a vertex are hollow: none can rest on it.
bool is_hollow_vertex(ContactContext& context, std::uint32_t t, std::uint32_t corner) {
  const ContactMesh& mesh = context.cache.mesh();
  bool hollow = true;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    const EdgeKind kind = mesh.edge_kind(at, k);
    hollow = hollow && mesh.edge_kind(at, (k + 2) % 3) != EdgeKind::boundary &&
             (kind == EdgeKind::smooth ||
              (kind == EdgeKind::crease && is_hollow(crease_of(context.cache, context.settings.normal_form, at, k))));
  });
  return hollow;
}

/// Boundaries there have none.
double vertex_margin(ContactContext& context, const FingerCore& core, std::uint32_t t, std::uint32_t corner,
                     const RankBound& bound, double enough_m) {
  const ContactMesh& mesh = context.cache.mesh();
  if (mesh.crowded_vertex(mesh.vertex(t, corner))) return 0.0;
  Normals normals;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    normals.add(mesh.normal(at, k));
    if (mesh.edge_kind(at, k) == EdgeKind::boundary || mesh.edge_kind(at, (k + 2) % 3) == EdgeKind::boundary)
      normals.complete = false;
  });
  const double margin = margin_of(core, {mesh.position(t, corner), Vec3(0.0), normals.cone()}, bound, enough_m);
  if (margin > 0.0 || !normals.complete || !is_hollow_vertex(context, t, corner)) return margin;
  return std::numeric_limits<double>::max();
}

}  // namespace

FeatureExclusion exclude_features_by_core(ContactContext& context, const FingerCore& core,
                                          const TriangleFeatures& features, const RankBound& bound, double enough_m,
                                          const FeatureMemory* memory) {
  const ContactMesh& mesh = context.cache.mesh();
  const std::uint32_t t = features.triangle;
  FeatureExclusion result;
  result.margin_m = std::numeric_limits<double>::max();
  const auto ask = [&](std::uint64_t key, auto margin) {
    if (memory && memory->knows(key)) return;
    result.asked[result.asked_count++] = key;
    result.margin_m = std::min(result.margin_m, margin());
    if (!(result.margin_m > 0.0)) result.unproved = key;
  };
  for (std::uint32_t k = 0; k < 3 && result.margin_m > 0.0; ++k) {
    if (!features.has_side(k) || mesh.edge_kind(t, k) == EdgeKind::smooth) continue;
    ask(edge_key(mesh, t, k), [&] {
      if (mesh.edge_kind(t, k) == EdgeKind::boundary) return 0.0;
      const Crease crease = crease_of(context.cache, context.settings.normal_form, t, k);
      return is_hollow(crease) ? std::numeric_limits<double>::max() : edge_margin(crease, core, bound, enough_m);
    });
  }
  for (std::uint32_t k = 0; k < 3 && result.margin_m > 0.0; ++k)
    if (features.has_corner(k) && mesh.feature_corner(t, k))
      ask(vertex_key(mesh, t, k), [&] { return vertex_margin(context, core, t, k, bound, enough_m); });
  return result;
}

}  // namespace tangent

// The creases, boundaries and corners of a triangle, one by one.
#pragma once

#include "core/contact/prove/feature_proof.h"
#include "core/contact/prove/triangle_proof.h"

#include <algorithm>
#include <limits>

namespace tangent::test {

template <class Visit>
void each_feature(const ContactMesh& mesh, std::uint32_t t, Visit visit) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (mesh.edge_kind(t, k) != EdgeKind::smooth) visit(TriangleFeature{t, k});
    if (mesh.feature_corner(t, k)) visit(TriangleFeature{t, k, true});
  }
}

/// The least margin that `ask` tells of one of them.
template <class Ask>
double least_margin(const ContactMesh& mesh, std::uint32_t t, Ask ask) {
  double least = std::numeric_limits<double>::max();
  each_feature(mesh, t, [&](const TriangleFeature& feature) { least = std::min(least, ask(feature).margin_m); });
  return least;
}

/// Whether each part of the triangle is excluded.
inline bool excludes_triangle(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m = 0.0) {
  const auto excludes = [&](SearchPart part) {
    PartOfTriangle of{t, part};
    return exclude_part(context, of, bound, enough_m).margin_m > 0.0;
  };
  bool excluded = excludes(SearchPart::face);
  each_feature(context.cache.mesh(), t, [&](const TriangleFeature& feature) {
    excluded = excluded && excludes(feature.is_corner ? corner_part(feature.number) : side_part(feature.number));
  });
  return excluded;
}

}  // namespace tangent::test

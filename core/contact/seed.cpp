#include "core/contact/seed.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

TrackedPlane face_at(std::uint32_t triangle, double u, double v) {
  TrackedPlane place;
  place.feature = Feature::face;
  place.triangle = triangle;
  place.u = u;
  place.v = v;
  return place;
}

/// Smaller is better: the stable contact the finger's centre is nearest to. Converged contacts go before
/// unconverged ones, stable before unstable.
struct Rank {
  int group;
  double value;
  bool operator<(const Rank& o) const { return group != o.group ? group < o.group : value < o.value; }
};

Rank rank(const IterationResult& r) {
  if (r.converged()) return {0, std::abs(r.contact.height_m)};
  if (r.stop == StopReason::unstable) return {1, std::abs(r.contact.height_m)};
  return {2, r.contact.error_m};
}

/// Keeps `r` if it is the best so far. True if it converged.
bool offer(const IterationResult& r, Rank& best, SeedResult& result) {
  result.evaluations += r.evaluations;
  const Rank here = rank(r);
  if (here < best) {
    best = here;
    result.best = r;
  }
  return r.converged();
}

}  // namespace

SeedResult seed_contact(IterationContext& context, const NearestTriangles& nearest) {
  const bool robust = context.settings.method == Method::robust;
  std::array<NearestHit, kSeeds> hits;
  const std::size_t wanted = robust ? hits.size() : 1;
  const std::size_t count = nearest.nearest_several(context.pose.position, std::numeric_limits<double>::infinity(),
                                                    std::span(hits).first(wanted));
  const bool centred = context.finger.shape == FingerShape::point || context.finger.shape == FingerShape::sphere;
  SeedResult result;
  Rank best{3, 0.0};
  for (std::size_t i = 0; i < count; ++i) {
    if (best.group == 0 && centred) {
      // No point of a patch is further from its flat triangle than its bulge.
      const double bulge = patch_bulge(context.cache.patch(hits[i].triangle, context.settings.normal_form));
      if (hits[i].distance_m - bulge > best.value) continue;
    }
    context.seed = static_cast<std::uint8_t>(i + 1);
    ++result.seeds;
    const int budget = robust ? kSeedBudget : context.settings.max_iterations;
    const double u = hits[i].u, v = std::min(hits[i].v, 1.0 - hits[i].u);
    if (offer(iterate(context, face_at(hits[i].triangle, u, v), false, nullptr, budget), best, result) || !robust) continue;
    // A folded patch can hide its contact from its closest point; its middle is a second chance.
    offer(iterate(context, face_at(hits[i].triangle, 1.0 / 3.0, 1.0 / 3.0), false, nullptr, budget), best, result);
  }
  context.seed = 0;
  result.found = best.group == 0;
  return result;
}

}  // namespace tangent

#include "core/contact/seed.h"

#include "core/base/tolerances.h"

#include <array>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

TrackedPlane seed_place(const NearestHit& hit) {
  TrackedPlane place;
  place.feature = Feature::face;
  place.triangle = hit.triangle;
  place.u = hit.u;
  place.v = std::min(hit.v, 1.0 - hit.u);
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
    const IterationResult r = iterate(context, seed_place(hits[i]), false, nullptr,
                                      robust ? kSeedBudget : context.settings.max_iterations);
    result.evaluations += r.evaluations;
    const Rank rank_here = rank(r);
    if (rank_here < best) {
      best = rank_here;
      result.best = r;
    }
  }
  context.seed = 0;
  result.found = best.group == 0;
  return result;
}

}  // namespace tangent

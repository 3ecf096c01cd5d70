#include "workbench/bench/evaluation_time.h"

#include "core/lab/measure/distribution.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <vector>

namespace tangent::bench {
namespace {

struct Place {
  PnPatch patch;
  double u = 0.0, v = 0.0;
};

std::vector<Place> places_of(const ContactMesh& mesh, std::span<const TickOutput> ticks, NormalForm form) {
  constexpr std::size_t kPlaces = 16;
  std::vector<Place> places;
  for (std::size_t i = 0; i < kPlaces && !ticks.empty(); ++i) {
    const TickOutput& tick = ticks[i * ticks.size() / kPlaces];
    if (tick.triangle != kNone && mesh.usable(tick.triangle))
      places.push_back({make_patch(mesh, tick.triangle, form), tick.u, tick.v});
  }
  for (std::uint32_t t = 0; places.empty() && t < mesh.triangle_count(); ++t) {
    if (mesh.usable(t)) places.push_back({make_patch(mesh, t, form), 0.3, 0.3});
  }
  return places;
}

/// `chain`: 0 for independent evaluations; or so small that it changes no parameter, but each evaluation depends on the
/// previous one.
double round_ns(const std::vector<Place>& places, double chain, double& sink) {
  constexpr int kEvaluations = 4096;
  double last = 0.0;
  std::size_t p = 0;
  const std::int64_t from = TickClock::now();
  for (int i = 0; i < kEvaluations; ++i) {
    const Place& place = places[p];
    if (++p == places.size()) p = 0;
    const SurfaceSample s = evaluate(place.patch, chain != 0.0 ? place.u + chain * last : place.u, place.v);
    last = s.normal_v.z + s.normal_u.x;
    sink += last;
  }
  return static_cast<double>(TickClock::now() - from) / kEvaluations;
}

/// Middle mean of evaluations timed one by one, as ticks are.
double alone_ns(const std::vector<Place>& places, const TickClock& clock, double& sink) {
  constexpr std::size_t kEvaluations = 16384;
  std::vector<double> ns;
  ns.reserve(kEvaluations);
  SurfaceSample s;
  for (std::size_t i = 0; i < kEvaluations; ++i) {
    const Place& place = places[i % places.size()];
    const std::int64_t from = clock.mark();
    evaluate(place.patch, place.u, place.v, s);
    const std::int64_t to = clock.mark();
    sink += s.normal_v.z;
    ns.push_back(clock.elapsed_ns(from, to));
  }
  return middle_mean(std::move(ns));
}

}  // namespace

EvaluationTime evaluation_time(const ContactMesh& mesh, std::span<const TickOutput> ticks, NormalForm form,
                               const TickClock& clock) {
  constexpr int kRounds = 24;
  const std::vector<Place> places = places_of(mesh, ticks, form);
  EvaluationTime best{1e300, 1e300, 0.0};
  double sink = 0.0;
  for (int i = 0; i < kRounds; ++i) {
    best.throughput_ns = std::min(best.throughput_ns, round_ns(places, 0.0, sink));
    best.latency_ns = std::min(best.latency_ns, round_ns(places, 1e-280, sink));
  }
  best.alone_ns = alone_ns(places, clock, sink);
  // Never true; keeps the evaluations from being optimised away.
  if (sink == 1e300) best.latency_ns = 0.0;
  return best;
}

}  // namespace tangent::bench

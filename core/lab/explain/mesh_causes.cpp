#include "core/lab/explain/causes.h"

#include "core/lab/explain/mended_mesh.h"
#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tangent {
namespace {

/// Triangles that the run, or the looking at other places, came to.
std::vector<std::uint32_t> visited(const TickStudy& study) {
  std::vector<std::uint32_t> triangles;
  const auto add = [&](std::uint32_t t) {
    if (t < study.mesh().triangle_count() && triangles.size() < 64 &&
        std::find(triangles.begin(), triangles.end(), t) == triangles.end())
      triangles.push_back(t);
  };
  for (const IterationRecord& r : others_were_the_trouble(study) ? study.trace->view() : study.run) add(r.triangle);
  add(study.tick().triangle);
  return triangles;
}

/// Those that share a vertex with one of them as well.
std::vector<std::uint32_t> with_neighbours(const TickStudy& study, std::vector<std::uint32_t> triangles) {
  constexpr std::size_t kMost = 512;
  const std::size_t own = triangles.size();
  for (std::size_t i = 0; i < own && triangles.size() < kMost; ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (!study.mesh().crowded_vertex(study.mesh().vertex(triangles[i], k)))
        around_vertex(study.mesh(), triangles[i], k, [&](std::uint32_t t, std::uint32_t) { triangles.push_back(t); });
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

bool all_others_in(const TickStudy& study, const MendedScene& copy) {
  const auto others = study.trace->view().subspan(study.run.size());
  return std::all_of(others.begin(), others.end(), [&](const IterationRecord& r) {
    return std::find(copy.triangle_of.begin(), copy.triangle_of.end(), r.triangle) != copy.triangle_of.end();
  });
}

/// The tick is plain on a copy of the surroundings without the defect, and is not on a plain copy.
bool cured_by_mending(TickStudy& study, std::span<const std::uint32_t> around, Mend mend) {
  const auto plain = [&](const std::optional<TickOutput>& out) {
    return out && study.trials.plain(*out, study.trials.is_first());
  };
  const bool search = others_were_the_trouble(study);
  const MendedScene as_it_is = mend_around(study.mesh(), around, Mend::none);
  // What was known of other places the copy does not know, so it can't show what the search for them cost.
  const bool cost_of_search = search && study.tick().event == TickEvent::none && all_others_in(study, as_it_is);
  if (!cost_of_search && plain(solve_on_copy(study.trials, as_it_is, {false, search}))) return false;
  const auto out = solve_on_copy(study.trials, mend_around(study.mesh(), around, mend), {true, search});
  if (!plain(out)) return false;
  study.result.mesh.mended = true;
  study.result.mesh.proof = *out;
  return true;
}

/// The first crease on the shortest way over edges between two triangles near each other; triangle kNone: none.
EdgeLink crease_between(const ContactMesh& mesh, std::uint32_t from, std::uint32_t to) {
  constexpr std::size_t kMostLooked = 256;
  struct Reached {
    std::uint32_t triangle;
    EdgeLink crease;  ///< on the way there
  };
  std::vector<Reached> reached{{from, {}}};
  for (std::size_t i = 0; i < reached.size() && reached.size() < kMostLooked; ++i) {
    const Reached at = reached[i];
    if (at.triangle == to) return at.crease;
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t next = mesh.across(at.triangle, e).triangle;
      const auto known = [&](const Reached& r) { return r.triangle == next; };
      if (next == kNone || std::any_of(reached.begin(), reached.end(), known)) continue;
      const bool crease = at.crease.triangle == kNone && mesh.edge_kind(at.triangle, e) == EdgeKind::crease;
      reached.push_back({next, crease ? EdgeLink{at.triangle, e} : at.crease});
    }
  }
  return {};
}

bool is_on_edge(const IterationRecord& r, std::uint32_t e) {
  const double weight[3] = {r.v, 1.0 - r.u - r.v, r.u};  // 0 on edge 0, 1, 2
  return std::abs(weight[e]) < 1e-9;
}

TickCause feature_at(TickStudy& study, std::uint32_t triangle, std::uint32_t edge, const IterationRecord& r) {
  const ContactMesh& mesh = study.mesh();
  const EdgeLink other = mesh.across(triangle, edge);
  const double jump = kJumpDeg;
  study.place_at(triangle, edge, r.point);
  if (other.triangle != kNone) {
    const Vec3 there = mesh.normal(other.triangle, (other.edge + 1) % 3);
    study.result.decided = {"turn of the normal across the crease", "what counts as a jump", "deg",
                            angle_between_deg(mesh.normal(triangle, edge), there), jump};
    return TickCause::crease;
  }
  if (is_converged(study.tick().status) && !study.trials.is_first())
    study.result.decided = {"turn of the normal in one tick", "what counts as a jump", "deg",
                            angle_between_deg(study.before().plane.normal, study.tick().normal), jump};
  else
    study.result.decided = {"error where the mesh ends", "tolerance", "m", r.error_m,
                            study.preset().solver.tolerance_m};
  return TickCause::boundary;
}

}  // namespace

bool find_wild_normal(TickStudy& study) {
  const std::vector<std::uint32_t> around = visited(study);
  double worst = kWildNormalDeg;
  std::uint32_t at = kNone, corner = 0;
  for (const std::uint32_t t : around) {
    if (triangle_aspect(study.mesh(), t) * kSliverAspect > 1.0) continue;  // its own normal is worth little
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double deg = corner_to_face_deg(study.mesh(), t, k);
      if (deg <= worst) continue;
      worst = deg;
      at = t;
      corner = k;
    }
  }
  if (at == kNone || !cured_by_mending(study, around, Mend::wild_normals)) return false;
  study.result.decided = {"angle of a corner normal to its face's", "what counts as wild", "deg", worst,
                          kWildNormalDeg};
  study.place_at(at, corner, study.mesh().origin() + study.mesh().position(at, corner));
  return true;
}

// A sliver turns the normals of its corners, so that the faces beside it suffer as well.
bool find_sliver(TickStudy& study) {
  const std::vector<std::uint32_t> around = with_neighbours(study, visited(study));
  double worst = 1.0 / kSliverAspect;
  std::uint32_t at = kNone;
  for (const std::uint32_t t : around) {
    const double aspect = triangle_aspect(study.mesh(), t);
    if (aspect <= worst) continue;
    worst = aspect;
    at = t;
  }
  if (at == kNone || !cured_by_mending(study, around, Mend::slivers)) return false;
  const auto [a, b, c] = study.mesh().positions(at);
  study.result.decided = {"longest side over smallest height", "what counts as a sliver", "1", worst,
                          1.0 / kSliverAspect};
  study.place_at(at, 0, study.mesh().origin() + (a + b + c) / 3.0);
  return true;
}

std::optional<TickCause> find_feature(TickStudy& study) {
  for (std::size_t i = study.near.size(); i-- > 0;) {
    const IterationRecord& r = study.near[i];
    for (std::uint32_t e = 0; e < 3; ++e)
      if (r.feature != Feature::face && is_on_edge(r, e) && study.mesh().edge_kind(r.triangle, e) != EdgeKind::smooth)
        return feature_at(study, r.triangle, e, r);
    if (i + 1 == study.run.size()) continue;
    const EdgeLink crossed = crease_between(study.mesh(), r.triangle, study.run[i + 1].triangle);
    if (crossed.triangle != kNone) return feature_at(study, crossed.triangle, crossed.edge, r);
  }
  return std::nullopt;
}

std::optional<TickCause> find_feature_to_end(TickStudy& study) {
  if (study.trials.is_first()) return std::nullopt;
  const EdgeLink crossed = crease_between(study.mesh(), study.before().plane.triangle, study.tick().triangle);
  if (crossed.triangle == kNone) return std::nullopt;
  return feature_at(study, crossed.triangle, crossed.edge, study.run.back());
}

bool find_other_facet(TickStudy& study) {
  if (study.tick().event == TickEvent::none || study.trials.is_first()) return false;
  const double turn = angle_between_deg(study.before().plane.normal, study.tick().normal), limit = kJumpDeg;
  if (study.tick().triangle == study.before().plane.triangle || !(turn > limit)) return false;
  study.result.decided = {"turn of the normal in one tick", "what counts as a jump", "deg", turn, limit};
  study.place_at(study.tick().triangle, 0, study.tick().contact);
  return true;
}

}  // namespace tangent

#include "core/contact/prove/feature_proof.h"

#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/feature_nets.h"
#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr int kEdgeHalvings = 3;                   // more: dearer; fewer: solves in vain
constexpr int kTestsOfEdge = 4, kFacesOfTest = 2;  // what a close look at an edge costs, and at the faces of a vertex

/// An edge of a triangle, local coordinates.
struct EdgeEnds {
  std::array<Vec3, 4> curve;    ///< control points
  std::array<Vec3, 3> normals;  ///< of the triangle along it, control normals: the corners' at the ends
  Vec3 inside;                  ///< the opposite corner

  /// Control points of the curve's derivative.
  std::array<Vec3, 3> speed() const {
    return {3.0 * (curve[1] - curve[0]), 3.0 * (curve[2] - curve[1]), 3.0 * (curve[3] - curve[2])};
  }
};

std::array<Vec3, 4> edge_curve(const ContactMesh& mesh, const PnPatch& patch, std::uint32_t t, std::uint32_t edge) {
  static constexpr ControlPoint kNearFirst[3] = {b210, b021, b102}, kNearSecond[3] = {b120, b012, b201};
  return {mesh.position(t, edge), patch.control_point(kNearFirst[edge]), patch.control_point(kNearSecond[edge]),
          mesh.position(t, (edge + 1) % 3)};
}

EdgeEnds edge_ends(const ContactMesh& mesh, const PnPatch& patch, std::uint32_t t, std::uint32_t edge) {
  static constexpr ControlNormal kMiddle[3] = {n110, n011, n101};
  return {
      edge_curve(mesh, patch, t, edge),
      {mesh.normal(t, edge), 0.5 * patch.mixed_weight * patch.normals[kMiddle[edge]], mesh.normal(t, (edge + 1) % 3)},
      mesh.position(t, (edge + 2) % 3)};
}

/// Greatest |N.S'| along the edge, of unit normals: how much they lean along it.
double lean_along(const std::array<Vec3, 3>& n, const std::array<Vec3, 3>& speed) {
  const double most = greatest_product(n, speed);
  double shortest = 1.0;
  const Vec3 axis = unit(n[0] + n[2]);
  for (const Vec3& x : n) shortest = std::min(shortest, glm::dot(x, axis));
  return shortest > 0.1 ? most / shortest : std::numeric_limits<double>::max();
}

/// How far c lies beyond an end of the edge, seen along the curve from every place of it: (c - S).S' is a quintic whose
/// Bezier coefficients have one sign then. On a contact it is h N.S', which is no more than the normals lean. Not over
/// 0: nothing is known; most of these are told by the coefficients of the ends.
double beyond_ends(const EdgeEnds& e, const std::array<Vec3, 3>& speed, const Vec3& centre) {
  const Vec3 first = centre - e.curve[0], last = centre - e.curve[3];
  const double start = glm::dot(first, speed[0]), end = glm::dot(last, speed[2]);
  if (!(start * end > 0.0)) return 0.0;
  const std::array<Vec3, 4> d{first, centre - e.curve[1], centre - e.curve[2], last};
  const auto at = [&](std::size_t i, std::size_t j) { return glm::dot(d[i], speed[j]); };
  const std::array<double, 6> g{start,
                                (3.0 * at(1, 0) + 2.0 * at(0, 1)) / 5.0,
                                (3.0 * at(2, 0) + 6.0 * at(1, 1) + at(0, 2)) / 10.0,
                                (at(3, 0) + 6.0 * at(2, 1) + 3.0 * at(1, 2)) / 10.0,
                                (2.0 * at(3, 1) + 3.0 * at(2, 2)) / 5.0,
                                end};
  const auto [low, high] = std::minmax_element(g.begin(), g.end());
  const double clear = std::max(*low, -*high);
  if (clear <= 0.0) return 0.0;
  double farthest2 = 0.0, fastest2 = 0.0;
  for (const Vec3& x : d) farthest2 = std::max(farthest2, glm::dot(x, x));
  for (const Vec3& x : speed) fastest2 = std::max(fastest2, glm::dot(x, x));
  const double lean = lean_along(e.normals, speed);
  return (clear - lean * std::sqrt(farthest2)) / (std::sqrt(fastest2) + lean);
}

/// Lower bound of the distance from c to a cubic with these control points: the nearest of them, seen from c towards
/// its chord.
double curve_distance(const std::array<Vec3, 4>& b, const Vec3& c) {
  const Vec3 chord = b[3] - b[0], d = c - b[0];
  const double length2 = glm::dot(chord, chord);
  const double along = length2 > 0.0 ? std::clamp(glm::dot(d, chord) / length2, 0.0, 1.0) : 0.0;
  const Vec3 away = d - along * chord;
  const double off = std::sqrt(glm::dot(away, away));
  if (!(off > 0.0)) return 0.0;
  const double nearest = std::min(std::min(glm::dot(d, away), glm::dot(c - b[1], away)),
                                  std::min(glm::dot(c - b[2], away), glm::dot(c - b[3], away)));
  return nearest / off;
}

/// Lower bound of the distance from c to an edge's curve by its corners: its control points are those of the chord less
/// a part of a third of it along normals.
double edge_distance(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge, const Vec3& c) {
  const Vec3 &p = mesh.position(t, edge), chord = mesh.position(t, (edge + 1) % 3) - p, d = c - p;
  const double length2 = glm::dot(chord, chord);
  const double along = length2 > 0.0 ? std::clamp(glm::dot(d, chord) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(d, along * chord) - std::sqrt(length2) / 3.0;
}

/// How far c lies over the triangle rather than over the edge's fan, seen from every place of the edge: with T = S' and
/// n the triangle's normal there (c - S).(T x n) has the sign of the triangle's side, a polynomial of degree 7 whose
/// Bezier coefficients have it then. On a contact of a convex fan it has the other one, or is 0. Not over 0: nothing is
/// known, as above.
double over_face(const EdgeEnds& e, const std::array<Vec3, 3>& t, const Vec3& centre) {
  constexpr double kFour[5] = {1.0, 4.0, 6.0, 4.0, 1.0}, kThree[4] = {1.0, 3.0, 3.0, 1.0};
  constexpr double kSeven[8] = {1.0, 7.0, 21.0, 35.0, 35.0, 21.0, 7.0, 1.0};
  const auto& n = e.normals;
  const Vec3 first = glm::cross(t[0], n[0]), last = glm::cross(t[2], n[2]);
  const double inside = glm::dot(first, e.inside - e.curve[0]);
  if (!(inside * glm::dot(last, e.inside - e.curve[3]) > 0.0)) return 0.0;
  const std::array<Vec3, 4> d{centre - e.curve[0], centre - e.curve[1], centre - e.curve[2], centre - e.curve[3]};
  const double side = inside > 0.0 ? 1.0 : -1.0, start = side * glm::dot(first, d[0]),
               end = side * glm::dot(last, d[3]);
  if (!(start > 0.0 && end > 0.0)) return 0.0;
  const std::array<Vec3, 5> across{
      first, 0.5 * (glm::cross(t[0], n[1]) + glm::cross(t[1], n[0])),
      (glm::cross(t[0], n[2]) + 4.0 * glm::cross(t[1], n[1]) + glm::cross(t[2], n[0])) / 6.0,
      0.5 * (glm::cross(t[1], n[2]) + glm::cross(t[2], n[1])), last};
  std::array<double, 8> g{};
  double most2 = 0.0;
  for (std::size_t i = 0; i < across.size(); ++i) {
    most2 = std::max(most2, glm::dot(across[i], across[i]));
    for (std::size_t j = 0; j < d.size(); ++j) g[i + j] += kFour[i] * kThree[j] * glm::dot(across[i], d[j]);
  }
  double least = std::min(start, end);
  for (std::size_t k = 1; k + 1 < g.size(); ++k) least = std::min(least, side * g[k] / kSeven[k]);
  return least / std::sqrt(most2);
}

}  // namespace

/// Strongest pull of the edges around a vertex on a contact that rests on it, as a distance: positive where the
/// contact leaves it along one of them. Once one pulls by `enough`, no more are asked.
static double vertex_pull(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner, const Vec3& centre,
                          double enough, int& faces) {
  const Vec3 d = centre - mesh.position(t, corner);
  double strongest = -std::numeric_limits<double>::max();
  const auto pull = [&](const Vec3& offset) {
    const double length2 = glm::dot(offset, offset);
    if (length2 > 0.0) strongest = std::max(strongest, glm::dot(d, offset) / std::sqrt(length2));
  };
  around_vertex_towards(
      mesh, t, corner, [&](const Vec3&) { return d; },
      [&](std::uint32_t at, std::uint32_t k) {
        if (strongest > 0.0 && strongest >= enough) return;
        ++faces;
        const Vec3 starting = mesh.position(at, (k + 1) % 3) - mesh.position(at, k);
        if (mesh.edge_kind(at, k) == EdgeKind::crease) {
          const EdgeLink other = mesh.across(at, k);
          pull(crease_control_offset(starting, mesh.normal(at, k), mesh.normal(other.triangle, (other.edge + 1) % 3)));
        } else {
          pull(edge_control_offset(starting, mesh.normal(at, k)));
        }
        if (mesh.edge_kind(at, (k + 2) % 3) == EdgeKind::boundary)
          pull(edge_control_offset(mesh.position(at, (k + 2) % 3) - mesh.position(at, k), mesh.normal(at, k)));
      });
  return strongest;
}

namespace {

/// What exclude_feature_contacts is asked for.
struct Question {
  PatchCache& cache;
  const ContactMesh& mesh;
  std::uint32_t t;
  NormalForm form;
  const Vec3& centre;
  const RankBound& bound;
  double enough_m, rounding_m;
  bool glance;  ///< a margin under enough_m is worth nothing
};

/// An edge, or a part of it, by the triangles on both sides; the far one counts it the other way round.
struct EdgeSides {
  EdgeEnds near, far;
  bool has_far = false;
};

/// The halves of an edge's ends, whose new end is its place on the curve.
std::array<EdgeEnds, 2> halves_of(const EdgeEnds& e) {
  const auto& b = e.curve;
  const Vec3 ab = 0.5 * (b[0] + b[1]), bc = 0.5 * (b[1] + b[2]), cd = 0.5 * (b[2] + b[3]);
  const Vec3 abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), middle = 0.5 * (abc + bcd);
  const Vec3 first = 0.5 * (e.normals[0] + e.normals[1]), second = 0.5 * (e.normals[1] + e.normals[2]);
  const Vec3 normal = 0.5 * (first + second);
  return {EdgeEnds{{b[0], ab, abc, middle}, {e.normals[0], first, normal}, e.inside},
          EdgeEnds{{middle, bcd, cd, b[3]}, {normal, second, e.normals[2]}, e.inside}};
}
std::array<EdgeSides, 2> halves_of(const EdgeSides& edge) {
  const std::array<EdgeEnds, 2> near = halves_of(edge.near);
  if (!edge.has_far) return {EdgeSides{near[0], {}, false}, EdgeSides{near[1], {}, false}};
  const std::array<EdgeEnds, 2> far = halves_of(edge.far);
  return {EdgeSides{near[0], far[1], true}, EdgeSides{near[1], far[0], true}};
}

/// Of an edge that is not excluded as a whole by as much as is wanted: the least of its parts' margins, each by what
/// tells most of it. Parts that tell less are halved.
double parts_margin(const Question& q, const EdgeSides& edge, double wanted, int halvings, FeatureExclusion& result) {
  double least = std::numeric_limits<double>::max();
  for (const EdgeSides& part : halves_of(edge)) {
    ++result.tests;
    const double behind = q.bound.way_to(curve_distance(part.near.curve, q.centre));
    const auto speed = part.near.speed();
    double safe = std::max(behind, beyond_ends(part.near, speed, q.centre));
    if (safe < wanted) safe = std::max(safe, over_face(part.near, speed, q.centre));
    if (safe < wanted && part.has_far) safe = std::max(safe, over_face(part.far, part.far.speed(), q.centre));
    result.by_rank = result.by_rank || behind >= safe;
    if (safe < wanted && halvings > 1) safe = parts_margin(q, part, wanted, halvings - 1, result);
    least = std::min(least, safe);
    if (least < wanted) break;
  }
  return least;
}

FeatureExclusion edge_margin(const Question& q, std::uint32_t k) {
  double safe = q.bound.way_to(edge_distance(q.mesh, q.t, k, q.centre));
  const double share = q.glance ? 1.0 : kAtOnceShare;
  if (safe > 0.0 && safe >= share * q.enough_m) return {safe, true, 0};
  const PnPatch& patch = q.cache.patch(q.t, q.form);
  const std::array<Vec3, 4> curve = edge_curve(q.mesh, patch, q.t, k);
  const double wanted = q.enough_m + q.rounding_m;
  safe = q.bound.way_to(curve_distance(curve, q.centre));
  if (safe > q.rounding_m && safe >= share * wanted) return {safe - q.rounding_m, true, kTestsOfEdge};
  const double behind = safe;
  EdgeSides edge{edge_ends(q.mesh, patch, q.t, k), {}, false};
  const auto speed = edge.near.speed();
  safe = std::max(safe, beyond_ends(edge.near, speed, q.centre));
  if (safe < wanted) safe = std::max(safe, over_face(edge.near, speed, q.centre));
  const EdgeLink other = q.mesh.across(q.t, k);
  if (safe < wanted && other.triangle != kNone) {
    const PnPatch& beside = q.cache.patch(other.triangle, q.form);
    edge.far = edge_ends(q.mesh, beside, other.triangle, other.edge);
    edge.has_far = true;
    safe = std::max(safe, over_face(edge.far, edge.far.speed(), q.centre));
  }
  FeatureExclusion result{certain_margin(safe, q.rounding_m), behind >= safe, kTestsOfEdge};
  if (q.glance || result.margin_m > 0.0) return result;
  result.by_rank = false;
  const double least = parts_margin(q, edge, 2.0 * q.rounding_m, kEdgeHalvings, result);
  result.margin_m = certain_margin(least, q.rounding_m);
  return result;
}

FeatureExclusion vertex_margin(const Question& q, std::uint32_t k) {
  const Vec3 d = q.centre - q.mesh.position(q.t, k);
  const double behind = q.bound.way_to(std::sqrt(glm::dot(d, d)));
  double safe = behind;
  int faces = 0;
  if (safe < q.enough_m || !(safe > 0.0))
    safe = std::max(safe, vertex_pull(q.mesh, q.t, k, q.centre, q.enough_m + q.rounding_m, faces));
  return {certain_margin(safe, q.rounding_m), behind >= safe, faces / kFacesOfTest};
}

}  // namespace

FeatureExclusion exclude_feature_contacts(PatchCache& cache, const TriangleFeature& feature, NormalForm form,
                                          const Vec3& centre, const RankBound& bound, double enough_m, bool glance) {
  const ContactMesh& mesh = cache.mesh();
  const std::uint32_t t = feature.triangle;
  const Question question{
      cache, mesh, t, form, centre, bound, enough_m, rounding_of_margin(centre, mesh.position(t, 0)), glance};
  return feature.is_corner ? vertex_margin(question, feature.number) : edge_margin(question, feature.number);
}

}  // namespace tangent

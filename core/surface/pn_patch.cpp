#include "core/surface/pn_patch.h"

#include <algorithm>

namespace tangent {
namespace {

/// n110 of Vlachos et al.: the mean of the end normals reflected in the plane across the edge's middle.
/// Exchanging the ends gives the same bits, so two triangles agree along their edge.
Vec3 middle_normal(const Vec3& p, const Vec3& q, const Vec3& np, const Vec3& nq, const Vec3& flat) {
  const Vec3 edge = q - p;
  const Vec3 sum = np + nq;
  return unit_or(sum - (2.0 * glm::dot(edge, sum) / glm::dot(edge, edge)) * edge, unit_or(sum, flat));
}

/// One level of de Casteljau: the barycentric combination of three control points.
inline Vec3 mix(double w, double u, double v, const Vec3& a, const Vec3& b, const Vec3& c) {
  return w * a + u * b + v * c;
}

struct NormalPolynomial {
  Vec3 value, by_u, by_v;  ///< not normalised
};

NormalPolynomial evaluate_normal_polynomial(const PnPatch& p, double u, double v) {
  const double w = 1.0 - u - v;
  const double half = 0.5 * p.mixed_weight;  // the quadratic's mixed terms carry mixed_weight, de Casteljau gives 2
  const Vec3 a = half * p.normals[n110], b = half * p.normals[n011], c = half * p.normals[n101];
  const Vec3 lw = mix(w, u, v, p.normals[n200], a, c);
  const Vec3 lu = mix(w, u, v, a, p.normals[n020], b);
  const Vec3 lv = mix(w, u, v, c, b, p.normals[n002]);
  return {mix(w, u, v, lw, lu, lv), 2.0 * (lu - lw), 2.0 * (lv - lw)};
}

}  // namespace

Vec3 flat_normal(const PnPatch& p) {
  return unit_or(glm::cross(p.offsets[b030], p.offsets[b003]), Vec3(0.0, 0.0, 1.0));
}

Vec3 edge_control_offset(const Vec3& edge, const Vec3& corner_normal) {
  return (edge - glm::dot(edge, corner_normal) * corner_normal) / 3.0;
}

Vec3 crease_control_offset(const Vec3& edge, const Vec3& n0, const Vec3& n1) {
  const Vec3 sum = n0 + n1;
  const Vec3 difference = n0 - n1;  // its sign doesn't matter below, so the two sides agree in every bit
  const double sum2 = glm::dot(sum, sum), difference2 = glm::dot(difference, difference);
  const double cosine = glm::dot(n0, n1);
  const double weight = cosine <= 0.0 ? 1.0 : std::max(0.0, 1.0 - cosine * cosine);
  Vec3 tangent = edge;
  if (sum2 > 1e-24) tangent -= (glm::dot(edge, sum) / sum2) * sum;
  if (difference2 > 1e-24) tangent -= (weight * glm::dot(edge, difference) / difference2) * difference;
  return tangent / 3.0;
}

PnPatch make_pn_patch(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n, NormalForm form) {
  PnPatch patch;
  patch.mixed_weight = form == NormalForm::bernstein ? 2.0 : 1.0;
  patch.origin = p[0];
  patch.offsets[b300] = Vec3(0.0);
  patch.offsets[b030] = p[1] - p[0];
  patch.offsets[b003] = p[2] - p[0];
  for (int edge = 0; edge < 3; ++edge) {
    const int i = edge, j = (edge + 1) % 3;
    set_edge_points(patch, edge, edge_control_offset(p[j] - p[i], n[i]), edge_control_offset(p[i] - p[j], n[j]));
  }
  set_centre_point(patch);

  const Vec3 flat = flat_normal(patch);
  patch.normals[n200] = n[0];
  patch.normals[n020] = n[1];
  patch.normals[n002] = n[2];
  patch.normals[n110] = middle_normal(p[0], p[1], n[0], n[1], flat);
  patch.normals[n011] = middle_normal(p[1], p[2], n[1], n[2], flat);
  patch.normals[n101] = middle_normal(p[2], p[0], n[2], n[0], flat);
  return patch;
}

void set_edge_points(PnPatch& patch, int edge, const Vec3& from_first, const Vec3& from_second) {
  static constexpr ControlPoint kCorners[3] = {b300, b030, b003};
  static constexpr ControlPoint kEdgePoints[3][2] = {{b210, b120}, {b021, b012}, {b102, b201}};
  patch.offsets[kEdgePoints[edge][0]] = patch.offsets[kCorners[edge]] + from_first;
  patch.offsets[kEdgePoints[edge][1]] = patch.offsets[kCorners[(edge + 1) % 3]] + from_second;
}

void set_centre_point(PnPatch& patch) {
  auto& b = patch.offsets;
  const Vec3 e = (b[b210] + b[b120] + b[b021] + b[b012] + b[b102] + b[b201]) / 6.0;
  const Vec3 v = (b[b300] + b[b030] + b[b003]) / 3.0;
  b[b111] = e + (e - v) / 2.0;
}

void evaluate(const PnPatch& patch, double u, double v, SurfaceSample& s) {
  // First what takes longest: root and division go on while the point is computed.
  const NormalPolynomial n = evaluate_normal_polynomial(patch, u, v);
  const double length = std::sqrt(glm::dot(n.value, n.value));
  const double per_length = 1.0 / length;

  const double w = 1.0 - u - v;
  const auto& b = patch.offsets;
  // de Casteljau: cubic -> quadratic -> linear -> point; the linear level gives the first derivatives.
  const Vec3 q200 = mix(w, u, v, b[b300], b[b210], b[b201]);
  const Vec3 q020 = mix(w, u, v, b[b120], b[b030], b[b021]);
  const Vec3 q002 = mix(w, u, v, b[b102], b[b012], b[b003]);
  const Vec3 q110 = mix(w, u, v, b[b210], b[b120], b[b111]);
  const Vec3 q011 = mix(w, u, v, b[b111], b[b021], b[b012]);
  const Vec3 q101 = mix(w, u, v, b[b201], b[b111], b[b102]);
  const Vec3 lw = mix(w, u, v, q200, q110, q101);
  const Vec3 lu = mix(w, u, v, q110, q020, q011);
  const Vec3 lv = mix(w, u, v, q101, q011, q002);
  s.point = patch.origin + mix(w, u, v, lw, lu, lv);
  s.point_u = 3.0 * (lu - lw);
  s.point_v = 3.0 * (lv - lw);
  if (length < kVanishingNormal) {
    s.normal = flat_normal(patch);
    s.normal_u = s.normal_v = Vec3(0.0);
    return;
  }
  const Vec3 normal = per_length * n.value;
  s.normal = normal;
  s.normal_u = per_length * (n.by_u - glm::dot(normal, n.by_u) * normal);
  s.normal_v = per_length * (n.by_v - glm::dot(normal, n.by_v) * normal);
}

bool is_flat(const PnPatch& patch, double room) {
  const auto& b = patch.offsets;
  const Vec3 &p = b[b030], &q = b[b003];
  const double size2 = std::max({glm::dot(p, p), glm::dot(q, q), glm::dot(q - p, q - p)});
  const auto at = [&](ControlPoint i, double u, double v) {  // thirds: where an affine patch has it
    const Vec3 off = b[i] - (u * p + v * q) / 3.0;
    return glm::dot(off, off) <= room * room * size2;
  };
  if (!(at(b210, 1, 0) && at(b120, 2, 0) && at(b021, 2, 1) && at(b012, 1, 2) && at(b102, 0, 2) && at(b201, 0, 1) &&
        at(b111, 1, 1)))
    return false;
  return patch.mixed_weight == 2.0 && std::all_of(patch.normals.begin(), patch.normals.end(), [&](const Vec3& n) {
           const Vec3 off = n - patch.normals[n200];
           return glm::dot(off, off) <= room * room;
         });
}

SurfaceSample evaluate(const PnPatch& patch, double u, double v) {
  SurfaceSample s;
  evaluate(patch, u, v, s);
  return s;
}

Vec3 evaluate_point(const PnPatch& patch, double u, double v) { return evaluate(patch, u, v).point; }
Vec3 evaluate_normal(const PnPatch& patch, double u, double v) { return evaluate(patch, u, v).normal; }

SecondDerivatives evaluate_second(const PnPatch& patch, double u, double v) {
  const double w = 1.0 - u - v;
  const auto& b = patch.offsets;
  // Second differences of the control net along u (w -> u) and v (w -> v), one linear level left.
  const auto second = [&](const Vec3& at_w, const Vec3& at_u, const Vec3& at_v) {
    return 6.0 * mix(w, u, v, at_w, at_u, at_v);
  };
  SecondDerivatives d;
  d.point_uu =
      second(b[b120] - 2.0 * b[b210] + b[b300], b[b030] - 2.0 * b[b120] + b[b210], b[b021] - 2.0 * b[b111] + b[b201]);
  d.point_vv =
      second(b[b102] - 2.0 * b[b201] + b[b300], b[b012] - 2.0 * b[b111] + b[b210], b[b003] - 2.0 * b[b102] + b[b201]);
  d.point_uv = second(b[b111] - b[b210] - b[b201] + b[b300], b[b021] - b[b120] - b[b111] + b[b210],
                      b[b012] - b[b111] - b[b102] + b[b201]);
  return d;
}

double directional_curvature(const SurfaceSample& s, double du, double dv) {
  const Vec3 ds = du * s.point_u + dv * s.point_v;
  const Vec3 dn = du * s.normal_u + dv * s.normal_v;
  const double ds2 = glm::dot(ds, ds);
  return ds2 > 0.0 ? std::sqrt(glm::dot(dn, dn) / ds2) : 0.0;
}

double normal_curvature(const SurfaceSample& s, double du, double dv) {
  const Vec3 ds = du * s.point_u + dv * s.point_v;
  const Vec3 dn = du * s.normal_u + dv * s.normal_v;
  const double ds2 = glm::dot(ds, ds);
  return ds2 > 0.0 ? glm::dot(dn, ds) / ds2 : 0.0;
}

PrincipalCurvatures principal_curvatures(const SurfaceSample& s, const SecondDerivatives& d) {
  PrincipalCurvatures result;
  Vec3 n = glm::cross(s.point_u, s.point_v);
  const double area = std::sqrt(glm::dot(n, n));
  const double scale = glm::dot(s.point_u, s.point_u) + glm::dot(s.point_v, s.point_v);
  if (!(area > 1e-14 * scale)) return result;
  n /= glm::dot(n, s.normal) < 0.0 ? -area : area;

  // In an orthonormal tangent frame (t1, t2) with S_u = a t1, S_v = b t1 + c t2 the shape operator is
  // symmetric: W = J^-T II J^-1 with J = [a b; 0 c]; convex positive turns its sign.
  const double a = std::sqrt(glm::dot(s.point_u, s.point_u));
  const Vec3 t1 = s.point_u / a;
  const double b = glm::dot(s.point_v, t1);
  const Vec3 rest = s.point_v - b * t1;
  const double c = std::sqrt(glm::dot(rest, rest));
  const Vec3 t2 = rest / c;
  const double l = -glm::dot(d.point_uu, n), m = -glm::dot(d.point_uv, n), k = -glm::dot(d.point_vv, n);
  const double w11 = l / (a * a);
  const double w12 = (m - b * l / a) / (a * c);
  const double w22 = (k - 2.0 * b * m / a + b * b * l / (a * a)) / (c * c);

  const double mean = 0.5 * (w11 + w22), half = 0.5 * (w11 - w22);
  const double radius = std::hypot(half, w12);
  result.k1 = mean + radius;
  result.k2 = mean - radius;
  const double angle = 0.5 * std::atan2(w12, half);
  result.direction1 = std::cos(angle) * t1 + std::sin(angle) * t2;
  result.direction2 = -std::sin(angle) * t1 + std::cos(angle) * t2;
  return result;
}

}  // namespace tangent

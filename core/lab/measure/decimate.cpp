#include "core/lab/measure/decimate.h"

#include "core/base/units.h"
#include "core/mesh/triangle_shape.h"
#include "core/surface/mesh_patch.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace tangent {
namespace {

struct Traits : OpenMesh::DefaultTraitsDouble {
  VertexAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
};
using Working = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Vertex = Working::VertexHandle;
using HalfEdge = Working::HalfedgeHandle;
using Face = Working::FaceHandle;

constexpr int kMostPasses = 60;
/// A corner normal further than this from its new triangle's makes a patch that bulges wildly (cosine of 60 degrees).
constexpr double kLeastNormalCosine = 0.5;

Vec3 from_open_mesh(const OpenMesh::Vec3d& v) { return {v[0], v[1], v[2]}; }
OpenMesh::Vec3d to_open_mesh(const Vec3& v) { return {v.x, v.y, v.z}; }
std::uint64_t pair_key(Vertex a, Vertex b) {
  const int low = std::min(a.idx(), b.idx()), high = std::max(a.idx(), b.idx());
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

/// Normals of a triangle's corners by vertex, since a collapse keeps the triangle but changes its half-edges.
struct CornerNormals3 {
  std::array<int, 3> vertex;
  std::array<Vec3, 3> normal;
  const Vec3& at(Vertex v) const { return normal[vertex[0] == v.idx() ? 0 : vertex[1] == v.idx() ? 1 : 2]; }
  void move(Vertex from, Vertex to, const Vec3& n) {
    for (std::size_t k = 0; k < 3; ++k)
      if (vertex[k] == from.idx()) vertex[k] = to.idx(), normal[k] = n;
  }
};

/// Data for all checks of a collapse.
struct Constraints {
  const ContactScene& original;
  DecimateLimits limits;
  std::vector<bool> fixed;                    ///< vertices on creases and boundaries
  std::unordered_set<std::uint64_t> creases;  ///< edges by their end vertices, which are fixed
  std::vector<CornerNormals3> corners;        ///< by face
  CornerNormals3& of(Face face) { return corners[static_cast<std::size_t>(face.idx())]; }
};

/// Rejects collapses that a finger would feel.
template <class MeshT>
class FeelModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(FeelModule, MeshT, Feel);
  explicit FeelModule(Mesh& mesh) : Base(mesh, true) {}
  void set_constraints(Constraints* constraints) { c_ = constraints; }

  float collapse_priority(const CollapseInfo& ci) override {
    return allowed(ci) ? float(Base::LEGAL_COLLAPSE) : float(Base::ILLEGAL_COLLAPSE);
  }

  /// The corners that move to v1 take its normal on this side of any crease.
  void preprocess_collapse(const CollapseInfo& ci) override {
    Mesh& mesh = Base::mesh();
    const Vec3 normal = c_->of(ci.fl).at(ci.v1);
    for (auto it = mesh.vf_iter(ci.v0); it.is_valid(); ++it)
      if (*it != ci.fl && *it != ci.fr) c_->of(*it).move(ci.v0, ci.v1, normal);
    ring_.clear();
    for (auto it = mesh.vv_iter(ci.v0); it.is_valid(); ++it) ring_.push_back(*it);
  }

  /// The decimater re-evaluates the neighbours of the removed vertex. Vertices across the edges of the changed
  /// triangles were evaluated with the old triangles, so they are locked until the next pass.
  void postprocess_collapse(const CollapseInfo& ci) override {
    Mesh& mesh = Base::mesh();
    for (auto it = mesh.vf_iter(ci.v1); it.is_valid(); ++it) {
      for (auto h = mesh.fh_iter(*it); h.is_valid(); ++h) {
        const HalfEdge across = mesh.opposite_halfedge_handle(*h);
        if (!mesh.face_handle(across).is_valid()) continue;
        const Vertex far = mesh.to_vertex_handle(mesh.next_halfedge_handle(across));
        if (std::find(ring_.begin(), ring_.end(), far) == ring_.end()) mesh.status(far).set_locked(true);
      }
    }
  }

 private:
  bool allowed(const CollapseInfo& ci) {
    Mesh& mesh = Base::mesh();
    if (c_->fixed[static_cast<std::size_t>(ci.v0.idx())]) return false;
    const Vec3 p1 = from_open_mesh(ci.p1);
    const Vec3 normal1 = c_->of(ci.fl).at(ci.v1);
    const double least_cosine = std::cos(c_->limits.angle_deg * kDegree);

    // Angles first: a cheap check that rejects most collapses.
    double old_aspect = 0.0;
    fan_.clear();
    for (auto it = mesh.voh_ccwiter(ci.v0); it.is_valid(); ++it) {
      // The triangle v0, x, y to the left of the half-edge v0 x.
      const HalfEdge out = *it, link = mesh.next_halfedge_handle(out);
      const Vertex x = mesh.to_vertex_handle(out), y = mesh.to_vertex_handle(link);
      const Vec3 a = from_open_mesh(mesh.point(x)), b = from_open_mesh(mesh.point(y));
      old_aspect = std::max(old_aspect, aspect(from_open_mesh(ci.p0), a, b));
      if (x == ci.v1 || y == ci.v1) continue;
      const Vec3 area = area_vector(p1, a, b);
      if (!(glm::dot(area, area) > 0.0)) return false;
      const CornerNormals3& corners = c_->of(mesh.face_handle(out));
      fan_.push_back({a, b, unit(area), corners.at(x), corners.at(y), x, y, mesh.opposite_halfedge_handle(link)});
    }
    if (fan_.empty()) return false;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      const NewTriangle& t = fan_[i];
      if (!smooth_enough(t.x, t.y, t.normal, t.across, least_cosine)) return false;
      // Its neighbour in the new fan, or at the fan's ends the triangle beyond the collapsed ones.
      const bool last = i + 1 == fan_.size();
      const NewTriangle& next = fan_[last ? 0 : i + 1];
      if (t.y == next.x) {
        if (glm::dot(t.normal, next.normal) < least_cosine) return false;
      }
    }
    // Voh runs from an arbitrary start: the two gaps of the fan are at vl and vr.
    for (const NewTriangle& t : fan_) {
      if (t.x == ci.vl && !smooth_enough(ci.v1, t.x, t.normal, ci.vlv1, least_cosine)) return false;
      if (t.y == ci.vr && !smooth_enough(ci.v1, t.y, t.normal, ci.v1vr, least_cosine)) return false;
    }
    const double aspect_limit = std::max(c_->limits.aspect, old_aspect);
    for (const NewTriangle& t : fan_) {
      if (aspect(p1, t.a, t.b) > aspect_limit) return false;
      if (glm::dot(t.normal, normal1) < kLeastNormalCosine || glm::dot(t.normal, t.normal_a) < kLeastNormalCosine ||
          glm::dot(t.normal, t.normal_b) < kLeastNormalCosine)
        return false;
    }
    for (const NewTriangle& t : fan_)
      if (!near_original(make_pn_patch({p1, t.a, t.b}, {normal1, t.normal_a, t.normal_b}))) return false;
    return true;
  }

  static double aspect(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 area = area_vector(a, b, c);
    return longest_side2(a, b, c) / std::max(std::sqrt(glm::dot(area, area)), 1e-300);
  }

  /// `across`: a half-edge between a and b; the face on one side stays, the one on the other is replaced.
  bool smooth_enough(Vertex a, Vertex b, const Vec3& normal, HalfEdge across, double least_cosine) {
    if (c_->creases.contains(pair_key(a, b))) return true;
    const Mesh& mesh = Base::mesh();
    const Face face = mesh.face_handle(across);
    if (!face.is_valid()) return true;
    std::array<Vec3, 3> p;
    std::size_t k = 0;
    for (auto it = mesh.cfv_iter(face); it.is_valid(); ++it) p[k++] = from_open_mesh(mesh.point(*it));
    return glm::dot(normal, face_normal(p[0], p[1], p[2])) >= least_cosine;
  }

  bool near_original(const PnPatch& patch) {
    constexpr std::array<std::array<double, 2>, 7> kSamples{
        {{1.0 / 3, 1.0 / 3}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}, {0.6, 0.2}, {0.2, 0.6}, {0.2, 0.2}}};
    for (const auto& [u, v] : kSamples) {
      const Vec3 point = evaluate_point(patch, u, v);
      const NearestHit hit = c_->original.nearest().nearest(point, std::numeric_limits<double>::infinity());
      // From the flat triangle's nearest point to the tangent plane of the smooth surface there.
      const SurfaceSample s = evaluate(make_patch(c_->original.mesh(), hit.triangle), hit.u, hit.v);
      if (!(std::abs(glm::dot(point - s.point, s.normal)) <= c_->limits.deviation_m)) return false;
    }
    return true;
  }

  struct NewTriangle {
    Vec3 a, b, normal, normal_a, normal_b;
    Vertex x, y;
    HalfEdge across;
  };
  Constraints* c_ = nullptr;
  std::vector<NewTriangle> fan_;
  std::vector<Vertex> ring_;
};

Working to_working(const ContactMesh& mesh, Constraints& constraints) {
  Working out;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) out.add_vertex(to_open_mesh(mesh.vertex_position(v)));
  constraints.fixed.assign(mesh.vertex_count(), false);
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto handle = [&](std::uint32_t k) { return Vertex(static_cast<int>(mesh.vertex(t, k))); };
    const Face face = out.add_face(handle(0), handle(1), handle(2));
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (mesh.feature_corner(t, k)) constraints.fixed[mesh.vertex(t, k)] = true;
      if (mesh.edge_kind(t, k) == EdgeKind::crease)
        constraints.creases.insert(pair_key(handle(k), handle((k + 1) % 3)));
    }
    if (!face.is_valid()) {
      for (std::uint32_t k = 0; k < 3; ++k) constraints.fixed[mesh.vertex(t, k)] = true;
      continue;
    }
    CornerNormals3 corners;
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners.vertex[k] = handle(k).idx();
      corners.normal[k] = mesh.normal(t, k);
    }
    constraints.corners.push_back(corners);
  }
  return out;
}

/// The mesh without deleted elements, with the constraints renumbered: the decimater needs a mesh without gaps.
Working compacted(const Working& mesh, Constraints& constraints) {
  Working out;
  std::vector<Vertex> moved(mesh.n_vertices());
  std::vector<bool> fixed;
  for (const Vertex v : mesh.vertices()) {
    if (mesh.status(v).deleted()) continue;
    moved[static_cast<std::size_t>(v.idx())] = out.add_vertex(mesh.point(v));
    fixed.push_back(constraints.fixed[static_cast<std::size_t>(v.idx())]);
  }
  const auto at = [&](int v) { return moved[static_cast<std::size_t>(v)]; };
  std::vector<CornerNormals3> all_corners;
  for (const Face face : mesh.faces()) {
    if (mesh.status(face).deleted()) continue;
    std::array<Vertex, 3> v;
    std::size_t k = 0;
    for (auto it = mesh.cfv_iter(face); it.is_valid(); ++it) v[k++] = at((*it).idx());
    out.add_face(v[0], v[1], v[2]);
    CornerNormals3 corners = constraints.of(face);
    for (int& vertex : corners.vertex) vertex = at(vertex).idx();
    all_corners.push_back(corners);
  }
  std::unordered_set<std::uint64_t> creases;
  for (const std::uint64_t key : constraints.creases)
    creases.insert(pair_key(at(static_cast<int>(key >> 32)), at(static_cast<int>(key & 0xffffffffu))));
  constraints.fixed = std::move(fixed);
  constraints.corners = std::move(all_corners);
  constraints.creases = std::move(creases);
  return out;
}

PolygonMesh from_working(const Working& mesh, Constraints& constraints, const ContactMesh& original) {
  PolygonMesh out;
  out.name = original.name();
  std::vector<std::uint32_t> index(mesh.n_vertices(), kNone);
  for (const Face face : mesh.faces()) {
    if (mesh.status(face).deleted()) continue;
    for (auto h = mesh.cfh_iter(face); h.is_valid(); ++h) {
      const Vertex v = mesh.to_vertex_handle(*h);
      std::uint32_t& i = index[static_cast<std::size_t>(v.idx())];
      if (i == kNone) {
        i = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(original.origin() + from_open_mesh(mesh.point(v)));
      }
      out.corner_position.push_back(i);
      out.corner_normal.push_back(static_cast<std::uint32_t>(out.normals.size()));
      out.normals.push_back(constraints.of(face).at(v));
    }
    out.face_offsets.push_back(static_cast<std::uint32_t>(out.corner_position.size()));
  }
  return out;
}

/// Collapses until none is allowed among the vertices that are not locked. Returns the number of collapses.
std::size_t one_pass(Working& mesh, Constraints& constraints) {
  for (const Vertex v : mesh.vertices())
    mesh.status(v).set_locked(constraints.fixed[static_cast<std::size_t>(v.idx())]);
  OpenMesh::Decimater::DecimaterT<Working> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Working>::Handle quadric;
  FeelModule<Working>::Handle feel;
  decimater.add(quadric);
  decimater.add(feel);
  decimater.module(quadric).unset_max_err();
  decimater.module(feel).set_constraints(&constraints);
  if (!decimater.initialize()) return 0;
  return decimater.decimate();
}

}  // namespace

DecimateResult decimate(const ContactScene& original, const DecimateLimits& limits,
                        const std::function<bool()>& keep_going) {
  DecimateResult result;
  result.before = original.mesh().usable_triangle_count();
  Constraints constraints{original, limits, {}, {}, {}};
  Working mesh = to_working(original.mesh(), constraints);
  for (; result.passes < kMostPasses; ++result.passes) {
    if (keep_going && !keep_going()) {
      result.stopped = true;
      break;
    }
    if (one_pass(mesh, constraints) == 0) break;
    mesh = compacted(mesh, constraints);
  }
  result.mesh = from_working(mesh, constraints, original.mesh());
  result.after = result.mesh.face_count();
  return result;
}

SurfaceDeviation surface_deviation(const ContactScene& from, const ContactScene& to, std::uint64_t most) {
  constexpr std::array<std::array<double, 2>, 4> kSamples{{{1.0 / 3, 1.0 / 3}, {0.6, 0.2}, {0.2, 0.6}, {0.2, 0.2}}};
  const ContactMesh& mesh = from.mesh();
  const std::uint64_t wanted = std::max<std::uint64_t>(1, most / kSamples.size());
  const std::uint64_t stride = std::max<std::uint64_t>(1, (mesh.usable_triangle_count() + wanted - 1) / wanted);
  SurfaceDeviation out;
  Preset preset;
  preset.finger.shape = FingerShape::point;
  double sum = 0.0, squares = 0.0;
  std::uint64_t count = 0;
  // The solver holds only a reference to what it is made for.
  Stepper stepper(std::shared_ptr<const ContactScene>(std::shared_ptr<void>(), &to));
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t) || count++ % stride != 0) continue;
    const PnPatch patch = make_patch(mesh, t);
    for (const auto& [u, v] : kSamples) {
      TickState state;
      TickInput input{0.0, {mesh.origin() + evaluate_point(patch, u, v), Quat(1.0, 0.0, 0.0, 0.0)}};
      input.all_at_once = true;
      const TickOutput contact = stepper.step(preset, input, state);
      if (contact.status == TickStatus::unconverged) {  // the nearest place will do
        ++out.unresolved;
        continue;
      }
      const double distance = glm::length(input.finger.position - contact.contact);
      ++out.samples;
      sum += distance;
      squares += distance * distance;
      out.largest_m = std::max(out.largest_m, distance);
    }
  }
  if (out.samples > 0) {
    out.mean_m = sum / static_cast<double>(out.samples);
    out.rms_m = std::sqrt(squares / static_cast<double>(out.samples));
  }
  return out;
}

}  // namespace tangent
